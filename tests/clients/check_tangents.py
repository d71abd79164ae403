# blender -b --factory-startup --python-exit-code 3 -P check_tangents.py -- PELAGE FOLDER: the tangents of a baked GLB, on
# a torus half of whose uv is mirrored, against those that Blender makes of the same mesh: both are MikkTSpace.
import json
import math
import os
import struct
import subprocess
import sys

import bpy
import numpy

for name, kind in (("bool", bool), ("int", int), ("float", float), ("object", object)):
    if name not in numpy.__dict__:  # the glTF importer of Blender 3.4 uses names that numpy 1.24 dropped
        setattr(numpy, name, kind)

pelage, folder = sys.argv[sys.argv.index("--") + 1:]
os.makedirs(folder, exist_ok=True)
shape, baked = os.path.join(folder, "torus.obj"), os.path.join(folder, "torus.glb")


def empty():
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)


empty()
bpy.ops.mesh.primitive_torus_add(major_segments=24, minor_segments=12)
mesh = bpy.context.object.data
for polygon in mesh.polygons:
    polygon.use_smooth = True
    if polygon.center.x > 0:
        for loop in polygon.loop_indices:
            mesh.uv_layers[0].data[loop].uv.x = 1 - mesh.uv_layers[0].data[loop].uv.x
bpy.ops.wm.obj_export(filepath=shape, export_materials=False)
subprocess.run([pelage, "grow", shape, "--model", "turing", "--quality", "draft", "--steps", "5", "--material",
                "height=0.1*b", "--bake", "64", "-q", "-o", baked], check=True)

with open(baked, "rb") as file:
    data = file.read()
length = struct.unpack("<I", data[12:16])[0]
document, binary = json.loads(data[20:20 + length]), data[28 + length:]


def array(accessor):
    a = document["accessors"][accessor]
    begin = document["bufferViews"][a["bufferView"]]["byteOffset"]
    width = {"VEC3": 3, "VEC4": 4}[a["type"]]
    return numpy.frombuffer(binary, "<f4", a["count"] * width, begin).reshape(-1, width)


ours = array(document["meshes"][0]["primitives"][0]["attributes"]["TANGENT"])
empty()
bpy.ops.import_scene.gltf(filepath=baked)
mesh = next(o.data for o in bpy.data.objects if o.type == "MESH")
mesh.calc_normals_split()
mesh.calc_tangents()
worst, mirrored = 0, 0
for loop in mesh.loops:
    x, y, z, side = ours[loop.vertex_index]
    along = loop.tangent.dot((x, -z, y))  # Blender's z is up
    worst = max(worst, math.degrees(math.acos(max(-1, min(1, along)))))
    assert loop.bitangent_sign == side, "a tangent has another side"
    mirrored += side < 0
assert worst < 0.5, "tangents are up to %g degrees off" % worst
assert 0 < mirrored < len(mesh.loops), "nothing is mirrored"
print("ok %d tangents, %d of them mirrored, within %.2g degrees of MikkTSpace" % (len(mesh.loops), mirrored, worst))

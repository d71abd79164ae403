# blender -b --factory-startup --python-exit-code 3 -P check_blender.py -- FILE: imports it and looks at what arrived.
import sys

import bpy
import numpy

for name, kind in (("bool", bool), ("int", int), ("float", float), ("object", object)):
    if name not in numpy.__dict__:  # the glTF importer of Blender 3.4 uses names that numpy 1.24 dropped
        setattr(numpy, name, kind)

path = sys.argv[sys.argv.index("--") + 1]
for old in list(bpy.data.objects):
    bpy.data.objects.remove(old)
importers = {"glb": bpy.ops.import_scene.gltf, "ply": bpy.ops.import_mesh.ply, "obj": bpy.ops.wm.obj_import}
importers[path.rsplit(".", 1)[-1]](filepath=path)
meshes = [o.data for o in bpy.data.objects if o.type == "MESH"]
assert len(meshes) == 1, "one mesh expected, %d arrived" % len(meshes)
mesh = meshes[0]
colors = [c for c in mesh.color_attributes]
images = [n.image for m in mesh.materials if m and m.node_tree for n in m.node_tree.nodes if n.type == "TEX_IMAGE"]
shown = [tuple(c.color) for c in colors[0].data] if colors else []
if images and len(mesh.uv_layers) > 0:
    shown = numpy.array(images[0].pixels[:]).reshape(-1, 4)[::97].tolist()
values = {tuple(round(x, 3) for x in c) for c in shown}
assert len(values) > 8, "only %d different colours" % len(values)
assert not mesh.copy().validate(), "Blender had to repair the mesh"
print("ok %d vertices %d triangles, %d colours as %s, uv %s" % (
    len(mesh.vertices), len(mesh.polygons), len(values), colors[0].data_type if colors else "an image",
    len(mesh.uv_layers) > 0))

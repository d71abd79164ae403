#!/usr/bin/env python3
"""make_gltf.py FOLDER: small scenes, one for every way in which glTF says where a vertex is, and five with all of them
together and random figures."""
import math
import os
import random
import struct
import sys

from gltf_file import File

def vector(size, n=3):
    return [random.uniform(-size, size) for _ in range(n)]


def quaternion():
    q = [random.gauss(0, 1) for _ in range(4)]
    length = math.sqrt(sum(x * x for x in q))
    return [x / length for x in q]


def placed(**more):
    scale = [random.uniform(0.5, 2) * random.choice([1, 1, -1]) for _ in range(3)]
    return {"translation": vector(5), "rotation": quaternion(), "scale": scale, **more}


def affine():
    m = vector(1, 16)
    m[3] = m[7] = m[11] = 0
    m[15] = 1
    return m


def weights():
    w = [random.random() for _ in range(4)]
    return [x / sum(w) for x in w]


def integers(most, n):
    return [[random.randint(-most, most) for _ in range(3)] for _ in range(n)]


def everything(path, seed):
    """Skins, morph targets, sparse and quantised arrays, instances and several scenes at once."""
    random.seed(seed)
    corners = 60
    file = File()
    points, sparse = ([vector(1) for _ in range(corners)] for _ in range(2))
    skinned = {"POSITION": file.array("VEC3", "f", points),
               "JOINTS_0": file.array("VEC4", "B", [[random.randrange(3) for _ in range(4)] for _ in range(corners)]),
               "WEIGHTS_0": file.array("VEC4", "f", [weights() for _ in range(corners)])}
    targets = [{"POSITION": file.array("VEC3", "f", [vector(1) for _ in range(corners)])},
               {"POSITION": file.array("VEC3", "b", integers(127, corners), normalized=True)}]
    quantised = file.array("VEC3", "h", integers(32767, corners), normalized=True)
    partly = file.array("VEC3", "f", sparse)
    places = sorted(random.sample(range(corners), 9))
    file.json["accessors"][partly]["sparse"] = {
        "count": 9, "indices": {"bufferView": file.view(struct.pack("<9H", *places)), "componentType": 5123},
        "values": {"bufferView": file.view(b"".join(struct.pack("<3f", *vector(1)) for _ in places))}}
    bind = file.array("MAT4", "f", [affine() for _ in range(4)])
    instances = {"TRANSLATION": file.array("VEC3", "f", [vector(9) for _ in range(4)]),
                 "ROTATION": file.array("VEC4", "f", [quaternion() for _ in range(4)]),
                 "SCALE": file.array("VEC3", "f", [[random.uniform(0.5, 2) for _ in range(3)] for _ in range(4)])}
    extensions = ["EXT_mesh_gpu_instancing", "KHR_mesh_quantization"]
    file.json |= {
        "extensionsUsed": extensions, "extensionsRequired": extensions,
        "meshes": [{"primitives": [{"attributes": skinned, "targets": targets}], "weights": [0.3, -0.7]},
                   {"primitives": [{"attributes": {"POSITION": quantised}}, {"attributes": {"POSITION": partly}}]}],
        "skins": [{"joints": [0, 2, 3, 5], "inverseBindMatrices": bind}, {"joints": [5, 4, 1]}],
        "nodes": [placed(children=[i + 1]) for i in range(5)] + [placed()] + [
            placed(mesh=0, skin=0), {"mesh": 0, "skin": 1, "weights": [0, 1.5]}, placed(mesh=1, children=[9]),
            placed(mesh=1), placed(mesh=1, extensions={"EXT_mesh_gpu_instancing": {"attributes": instances}})],
        "scenes": [{"nodes": [8]}, {"nodes": [0, 6, 7, 8, 10]}], "scene": 1}
    file.write(path)



# --- one thing each ----------------------------------------------------------------------------------------------
COLUMN = [(x, y, 0.0) for y in range(5) for x in (-0.5, 0.5)]  # a ladder of four squares
RUNGS = [(2 * i + a, 2 * i + b, 2 * i + c) for i in range(4) for a, b, c in ((0, 1, 3), (0, 3, 2))]


def ladder():
    """A file with the ladder in one node."""
    file = File()
    primitive = {"attributes": {"POSITION": file.array("VEC3", "f", COLUMN)}, "indices": indices(file, RUNGS)}
    file.json |= {"meshes": [{"primitives": [primitive]}], "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0}
    return file, primitive


def indices(file, faces):
    return file.array("SCALAR", "I", [(i,) for face in faces for i in face])


def require(file, *extensions):
    file.json |= {"extensionsUsed": list(extensions), "extensionsRequired": list(extensions)}
    return file


def morph():
    file, primitive = ladder()
    lean = [(0.3 * y, 0.0, 0.1 * y) for _, y, _ in COLUMN]
    bulge = [(x * y, 0.0, 0.0) for x, y, _ in COLUMN]
    primitive["targets"] = [{"POSITION": file.array("VEC3", "f", rows)} for rows in (lean, bulge)]
    file.json["meshes"][0]["weights"] = [0.5, 0.25]
    file.json["nodes"] = [{"mesh": 0}, {"mesh": 0, "weights": [-1, 1], "translation": [5, 0, 0]}]
    file.json["scenes"] = [{"nodes": [0, 1]}]
    return file


def skin():
    """Two bones, the upper one bent at rest; the node of the mesh is far away, which must not count."""
    file, primitive = ladder()
    upper = [min(max(y - 1, 0) / 2, 1) for _, y, _ in COLUMN]
    primitive["attributes"] |= {
        "JOINTS_0": file.array("VEC4", "H", [(0, 1 if w > 0 else 0, 0, 0) for w in upper]),
        "WEIGHTS_0": file.array("VEC4", "f", [(1 - w, w, 0.0, 0.0) for w in upper])}
    back = [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -y, 0, 1) for y in (0, 2)]
    half = math.radians(35)
    file.json["nodes"] = [{"mesh": 0, "skin": 0, "translation": [100, 0, 0]}, {"children": [2], "rotation": [0, 0, 0, 1]},
                          {"translation": [0, 2, 0], "rotation": [0, 0, math.sin(half), math.cos(half)]}]
    file.json |= {"skins": [{"joints": [1, 2], "skeleton": 1, "inverseBindMatrices": file.array("MAT4", "f", back)}],
                  "scenes": [{"nodes": [0, 1]}]}
    return file


def skeletons_within_each_other():
    """One mesh under a joint of its own skin, and a second skin whose joints lie below that of the first."""
    file = skin()
    file.json["nodes"][2]["children"] = [3]
    file.json["nodes"] += [{"translation": [0, 1, 1], "children": [4]}, {"mesh": 0, "skin": 1, "scale": [3, 3, 3]}]
    file.json["skins"].append({"joints": [2, 3]})
    return file


def sparse():
    file, primitive = ladder()
    places, moved = (1, 4, 7), [(2.0, 0.5, 1.0), (-2.0, 2.0, 1.0), (3.0, 3.0, -1.0)]
    change = {"count": 3, "indices": {"bufferView": file.view(bytes(places)), "componentType": 5121},
              "values": {"bufferView": file.view(b"".join(struct.pack("<3f", *p) for p in moved))}}
    file.json["accessors"][primitive["attributes"]["POSITION"]] |= {"sparse": change, "min": [-2, 0, -1], "max": [3, 4, 1]}
    return file


def sparse_over_zeros():
    file, primitive = ladder()
    accessor = file.json["accessors"][primitive["attributes"]["POSITION"]]
    del accessor["bufferView"]
    places = range(1, len(COLUMN))
    values = b"".join(struct.pack("<3f", x + 1, y, 0.5) for x, y, _ in COLUMN[1:])
    accessor |= {"min": [0, 0, 0], "max": [1.5, 4, 0.5]}
    accessor["sparse"] = {"count": len(places), "values": {"bufferView": file.view(values)},
                          "indices": {"bufferView": file.view(struct.pack(f"<{len(places)}H", *places)),
                                      "componentType": 5123}}
    return file


def instances():
    file, _ = ladder()
    turned = [[round(127 * x) for x in quaternion] for quaternion in ((0, 0, 0.6, 0.8), (0, 1, 0, 0), (0.8, 0, 0, -0.6))]
    arrays = {"TRANSLATION": file.array("VEC3", "f", [(5.0 * i, i, 0.0) for i in range(3)]),
              "ROTATION": file.array("VEC4", "b", turned, normalized=True)}
    file.json["nodes"] = [{"mesh": 0, "scale": [1, 2, 1], "extensions": {"EXT_mesh_gpu_instancing": {"attributes": arrays}}}]
    return require(file, "EXT_mesh_gpu_instancing")


def quantised():
    file = File()
    forms = (("B", False, 40), ("b", True, 25), ("h", False, 7000), ("H", True, 12000), ("H", False, 12000))
    meshes, nodes = [], []
    for k, (code, normalised, unit) in enumerate(forms):
        rows = [tuple(round(unit * c) for c in (x + 0.5, y, z)) for x, y, z in COLUMN]
        more = {"normalized": True} if normalised else {}
        meshes.append({"primitives": [{"attributes": {"POSITION": file.array("VEC3", code, rows, **more)},
                                       "indices": indices(file, RUNGS)}]})
        nodes.append({"mesh": k, "translation": [3 * k, 0, 0], "scale": [1 / unit] * 3 if not normalised else [2, 2, 2]})
    file.json |= {"meshes": meshes, "nodes": nodes, "scenes": [{"nodes": list(range(len(nodes)))}], "scene": 0}
    return require(file, "KHR_mesh_quantization")


def modes():
    """Points, lines, a loop, a chain, triangles, a strip and a fan; only the last three are a surface."""
    file = File()
    fan = [(0.0, 0.0, 0.0)] + [(math.cos(i), math.sin(i), 0.0) for i in range(5)]
    meshes = [{"primitives": [{"mode": mode, "attributes": {"POSITION": file.array("VEC3", "f", points)}}]}
              for mode, points in enumerate([COLUMN] * 6 + [fan])]
    meshes[4]["primitives"][0]["indices"] = indices(file, RUNGS)
    meshes.append({"primitives": [{"mode": 5, "attributes": {"POSITION": 4}, "indices": indices(file, [(0, 2, 1, 3, 5, 4)])}]})
    nodes = [{"mesh": k, "translation": [3 * k, 0, 0]} for k in range(len(meshes))]
    file.json |= {"meshes": meshes, "nodes": nodes, "scenes": [{"nodes": list(range(len(nodes)))}], "scene": 0}
    return file


def scenes():
    file, _ = ladder()
    file.json["nodes"] = [{"mesh": 0}, {"mesh": 0, "translation": [0, 7, 0]}, {"translation": [1, 1, 1]}]
    file.json |= {"scenes": [{"nodes": [0, 2]}, {"nodes": [1]}], "scene": 1}
    return file


def sheared():
    """A turn under an uneven scale, a mirror image, and a matrix."""
    file, _ = ladder()
    file.json["nodes"] = [{"scale": [3, 1, 0.5], "children": [1]}, {"mesh": 0, "rotation": [0, 0, 0.6, 0.8]},
                          {"mesh": 0, "scale": [-1, 1, 1], "translation": [9, 0, 0]},
                          {"mesh": 0, "matrix": [0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 0.5, 0, -9, 1, 2, 1]}]
    file.json["scenes"] = [{"nodes": [0, 2, 3]}]
    return file


def interleaved():
    file, primitive = ladder()
    view = file.view(b"".join(struct.pack("<6f4B", 0, 0, 1, *p, 255, 128, 0, 255) for p in COLUMN))
    file.json["bufferViews"][view]["byteStride"] = 28
    box = {"count": len(COLUMN), "componentType": 5126, "type": "VEC3", "bufferView": view}
    file.json["accessors"] += [box, box | {"byteOffset": 12, "min": [-0.5, 0, 0], "max": [0.5, 4, 0]},
                               box | {"byteOffset": 24, "componentType": 5121, "type": "VEC4", "normalized": True}]
    first = len(file.json["accessors"]) - 3
    primitive["attributes"] = {"NORMAL": first, "POSITION": first + 1, "COLOR_0": first + 2}
    return file


def main(folder):
    for scene in (morph, skin, skeletons_within_each_other, sparse, sparse_over_zeros, instances, quantised, modes, scenes,
                  sheared, interleaved):
        scene().write(os.path.join(folder, scene.__name__ + ".glb"))
    for seed in range(1, 6):
        everything(os.path.join(folder, f"everything{seed}.glb"), seed)


main(sys.argv[1])

#!/usr/bin/env python3
"""make_gltf.py FILE.glb SEED: a scene with skins, morph targets, sparse and quantised arrays, instances and several
scenes, with random figures. Its triangles touch nowhere."""
import json
import math
import random
import struct
import sys

COMPONENT = {"b": 5120, "B": 5121, "h": 5122, "H": 5123, "f": 5126}
WIDTH = {"VEC3": 3, "VEC4": 4, "MAT4": 16}


class File:
    def __init__(self):
        self.json = {"asset": {"version": "2.0"}, "bufferViews": [], "accessors": []}
        self.data = b""

    def view(self, data):
        self.data += b"\0" * (-len(self.data) % 4)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        return len(self.json["bufferViews"]) - 1

    def array(self, kind, code, rows, **more):
        size = struct.calcsize(f"<{WIDTH[kind]}{code}")
        stride = (size + 3) // 4 * 4
        view = self.view(b"".join(struct.pack(f"<{WIDTH[kind]}{code}", *r).ljust(stride, b"\0") for r in rows))
        if stride != size:
            self.json["bufferViews"][view]["byteStride"] = stride
        columns = list(zip(*rows))
        self.json["accessors"].append({"bufferView": view, "componentType": COMPONENT[code], "type": kind,
                                       "count": len(rows), "min": [min(c) for c in columns],
                                       "max": [max(c) for c in columns], **more})
        return len(self.json["accessors"]) - 1

    def write(self, path):
        self.json["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        data = self.data + b"\0" * (-len(self.data) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
        with open(path, "wb") as out:
            out.write(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


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


def main(path, seed):
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


main(sys.argv[1], int(sys.argv[2]))

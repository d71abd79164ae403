"""Writes small GLB files for the tests: arrays go in, their accessors and views come out."""
import json
import struct

COMPONENT = {"b": 5120, "B": 5121, "h": 5122, "H": 5123, "I": 5125, "f": 5126}
WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


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

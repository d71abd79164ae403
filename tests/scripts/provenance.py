#!/usr/bin/env python3
"""Reads, changes and forges the records in files by means of its own (docs/provenance.md), for provenance_test.sh.

Usage: provenance.py SHAPE RECIPE FILES     all files have the same record, and it tells the truth about the inputs
       provenance.py --without FILE         prints "none" where there is no record
       provenance.py --same-but-for-record A.ply B.ply
       provenance.py --change A.ply B.ply OLD NEW   in the text of the record
       provenance.py --forge A.ply COMMAND INPUTS   a PLY file with that record
       provenance.py --forge-text A.ply TEXT        and with that text in all places
"""
import hashlib
import json
import struct
import sys
import xml.etree.ElementTree as ET
import zipfile
import zlib


def in_lines(data, prefix):
    lines = [l for l in data.split(b"\n") if l.startswith(prefix)]
    assert all(len(l) <= 200 for l in lines), "a long line"
    return b"".join(l[len(prefix):] for l in lines).decode("ascii")


def in_glb(data):
    assert data[:4] == b"glTF" and struct.unpack_from("<I", data, 8)[0] == len(data)
    length, kind = struct.unpack_from("<I4s", data, 12)
    assert kind == b"JSON"
    asset = json.loads(data[20:20 + length])["asset"]
    assert asset["version"] == "2.0" and isinstance(asset["extras"], dict)
    return json.dumps(asset["extras"]["pelage"])


def in_png(data):
    at, texts = 8, []
    while at < len(data):
        length, name = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + length]
        assert struct.unpack_from(">I", data, at + 8 + length)[0] == zlib.crc32(name + body), name
        if name == b"tEXt":
            texts.append(body.split(b"\0", 1))
        at += 12 + length
    assert [t[0] for t in texts] == [b"pelage"]
    return texts[0][1].decode("latin-1")


def in_exr(data):
    at = 8
    while data[at]:
        name, kind = (data[at:].split(b"\0", 2)[k].decode() for k in (0, 1))
        at += len(name) + len(kind) + 2
        length, = struct.unpack_from("<I", data, at)
        if name == "pelage":
            assert kind == "string"
            return data[at + 4:at + 4 + length].decode("ascii")
        at += 4 + length


def in_vtk(path):
    array, = (a for a in ET.parse(path).getroot().iter("Array") if a.get("Name") == "pelage")
    assert array.get("type") == "String" and array.get("NumberOfTuples") == "1"
    codes = [int(c) for c in array.text.split()]
    assert codes[-1] == 0
    return bytes(codes[:-1]).decode("ascii")


def in_3mf(path):
    core = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
    with zipfile.ZipFile(path) as archive:
        assert archive.testzip() is None
        text = archive.read("3D/3dmodel.model")
    assert b'xmlns:pelage="' in text[:text.index(b"<resources")]
    return {m.get("name"): m.text for m in ET.fromstring(text).findall(core + "metadata")}["pelage:record"]


def record_of(path):
    data = open(path, "rb").read()
    kind = path.rsplit(".", 1)[1]
    if kind == "glb":
        return in_glb(data)
    if kind == "png":
        return in_png(data)
    if kind == "exr":
        return in_exr(data)
    if kind == "vtp":
        return in_vtk(path)
    if kind == "3mf":
        return in_3mf(path)
    if kind == "svg":
        return ET.parse(path).getroot().find("{http://www.w3.org/2000/svg}metadata").text
    if kind == "ply":
        return in_lines(data[:data.index(b"end_header\n")], b"comment pelage ")
    return in_lines(data, b"pelage " if kind == "dxf" else b"# pelage ")


def check(shape, recipe, files):
    records = {path: json.loads(record_of(path)) for path in files}
    first = records[files[0]]
    for path, record in records.items():
        read = {i["name"]: i for i in record["inputs"]}
        assert set(read) == {shape, recipe}, read
        for name, i in read.items():
            data = open(name, "rb").read()
            assert i["bytes"] == len(data) and i["sha256"] == hashlib.sha256(data).hexdigest(), (path, name)
        assert record["texts"] == [[recipe, open(recipe).read()]]
        assert record["command"][:2] == ["grow", shape] and "--seed=7" in record["command"]
        assert not any("coat" in w or "/" in w for w in record["command"]), record["command"]
        assert dict(record["values"])["seed"] == "7"
        for key in "version", "architecture", "values", "texts", "inputs":
            assert record[key] == first[key], (path, key)


def without_record(data):
    return b"\n".join(l for l in data.split(b"\n") if not l.startswith(b"comment pelage "))


def with_record(data, text):
    prefix, lines = b"comment pelage ", b""
    while text:
        end = min(len(text), 200 - len(prefix))
        while end < len(text) and (text[end - 1] in " \\" or text[end] in " \\"):
            end -= 1
        lines += prefix + text[:end].encode() + b"\n"
        text = text[end:]
    mark = b"comment written by pelage\n"
    data = without_record(data)
    return data.replace(mark, mark + lines, 1)


EMPTY = (b"ply\nformat ascii 1.0\ncomment written by pelage\nelement vertex 0\nproperty float x\nproperty float y\n"
         b"property float z\nend_header\n")


def forged(command, inputs, text="x"):
    return with_record(EMPTY, json.dumps({"program": "pelage", "version": text, "architecture": text, "inputs": inputs,
                                          "command": command, "values": [[text, text]], "texts": [[text, text]]},
                                         separators=(",", ":")))


def main(words):
    if words[0] == "--without":
        print(record_of(words[1]) or "none")
    elif words[0] == "--same-but-for-record":
        a, b = (open(p, "rb").read() for p in words[1:3])
        assert a != b and without_record(a) == b
    elif words[0] == "--change":
        text = record_of(words[1])
        assert words[3] in text
        open(words[2], "wb").write(with_record(open(words[1], "rb").read(), text.replace(words[3], words[4])))
    elif words[0] == "--forge":
        open(words[1], "wb").write(forged(json.loads(words[2]), json.loads(words[3])))
    elif words[0] == "--forge-text":
        t = words[2]
        open(words[1], "wb").write(forged(["grow", t], [{"name": t, "bytes": 1, "sha256": t}], t))
    else:
        check(words[0], words[1], words[2:])


if __name__ == "__main__":
    main(sys.argv[1:])

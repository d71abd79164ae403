"""PLY files, binary and little-endian, as the program reads and writes them. Needs numpy, which every Blender has."""
from dataclasses import dataclass, field

import numpy as np

_TYPES = {"char": "i1", "uchar": "u1", "short": "<i2", "ushort": "<u2", "int": "<i4", "uint": "<u4", "float": "<f4",
          "double": "<f8"}


@dataclass
class Mesh:
    """Polygons with numbers per vertex, and the lists that the faces have per corner."""
    points: np.ndarray  # n x 3
    sizes: np.ndarray  # corners per face
    corners: np.ndarray  # numbers of vertices, face by face
    columns: dict = field(default_factory=dict)  # name: one number per vertex
    corner_lists: dict = field(default_factory=dict)  # name: tuples per corner, m x components


def _face_layout(size: int, lists: dict) -> np.dtype:
    """One record of a face of so many corners."""
    parts = [("count", "<i4"), ("corners", "<i4", (size,))]
    for name, values in lists.items():
        parts += [(f"{name} count", "<i4"), (name, "<f4", (size * values.shape[1],))]
    return np.dtype(parts)


def _header(mesh: Mesh) -> bytes:
    lines = ["ply", "format binary_little_endian 1.0", f"element vertex {len(mesh.points)}"]
    lines += [f"property double {axis}" for axis in "xyz"] + [f"property float {name}" for name in mesh.columns]
    lines += [f"element face {len(mesh.sizes)}", "property list int int vertex_indices"]
    lines += [f"property list int float {name}" for name in mesh.corner_lists]
    return ("\n".join(lines) + "\nend_header\n").encode()


def _starts(sizes: np.ndarray) -> np.ndarray:
    return np.concatenate(([0], np.cumsum(sizes)[:-1])).astype(np.int64)


def _face_bytes(mesh: Mesh) -> np.ndarray:
    """Records of faces of one size are made together and put where they belong."""
    kinds = {int(n): _face_layout(int(n), mesh.corner_lists) for n in np.unique(mesh.sizes)}
    lengths = np.array([kinds[int(n)].itemsize for n in mesh.sizes], dtype=np.int64)
    place, first = _starts(lengths), _starts(mesh.sizes)
    buffer = np.zeros(int(lengths.sum()), dtype=np.uint8)
    for size, layout in kinds.items():
        which = np.flatnonzero(mesh.sizes == size)
        corner = first[which][:, None] + np.arange(size)
        records = np.zeros(len(which), dtype=layout)
        records["count"], records["corners"] = size, mesh.corners[corner]
        for name, values in mesh.corner_lists.items():
            records[f"{name} count"] = size * values.shape[1]
            records[name] = values[corner].reshape(len(which), -1)
        raw = records.view(np.uint8).reshape(len(which), layout.itemsize)
        buffer[place[which][:, None] + np.arange(layout.itemsize)] = raw
    return buffer


def write(path: str, mesh: Mesh):
    """Places as doubles, all else as floats."""
    layout = np.dtype([(axis, "<f8") for axis in "xyz"] + [(name, "<f4") for name in mesh.columns])
    vertices = np.zeros(len(mesh.points), dtype=layout)
    for k, axis in enumerate("xyz"):
        vertices[axis] = mesh.points[:, k]
    for name, values in mesh.columns.items():
        vertices[name] = values
    with open(path, "wb") as file:
        file.write(_header(mesh) + vertices.tobytes() + (_face_bytes(mesh).tobytes() if len(mesh.sizes) else b""))


def _read_header(file) -> dict:
    """Per element its count and properties (name, type, type of the list's length or None)."""
    elements = {}
    for raw in file:
        words = raw.decode("utf-8", "replace").split()
        if words[:1] == ["element"]:
            properties = []
            elements[words[1]] = (int(words[2]), properties)
        elif words[:2] == ["property", "list"]:
            properties.append((words[4], _TYPES[words[3]], _TYPES[words[2]]))
        elif words[:1] == ["property"]:
            properties.append((words[2], _TYPES[words[1]], None))
        elif words[:1] == ["end_header"]:
            break
    return elements


def _record(properties: list, counts: list) -> np.dtype:
    parts, lists = [], iter(counts)
    for name, kind, length in properties:
        if length:
            count = next(lists)
            parts += [(f"{name} count", length), (name, kind, (count,))]
        else:
            parts.append((name, kind))
    return np.dtype(parts)


def _list_counts(data: bytes, at: int, properties: list) -> list:
    """The lengths of the lists of the face that begins there."""
    counts = []
    for _, kind, length in properties:
        if length:
            counts.append(int(np.frombuffer(data, length, 1, at)[0]))
            at += np.dtype(length).itemsize + counts[-1] * np.dtype(kind).itemsize
        else:
            at += np.dtype(kind).itemsize
    return counts


def _read_faces(data: bytes, at: int, count: int, properties: list) -> tuple:
    """Sizes, vertices, and lists per corner. All lists of a face are as long as it has corners, or a multiple."""
    if not count:
        return np.zeros(0, int), np.zeros(0, int), {}
    first = _list_counts(data, at, properties)
    multiples = [n // first[0] for n in first]
    layouts, places, sizes = {}, np.zeros(count, np.int64), np.zeros(count, np.int64)
    head = np.dtype(properties[0][2]).itemsize
    for f in range(count):
        n = int.from_bytes(data[at:at + head], "little")
        if n not in layouts:
            layouts[n] = _record(properties, [n * m for m in multiples])
        sizes[f], places[f] = n, at
        at += layouts[n].itemsize
    start, total = _starts(sizes), int(sizes.sum())
    names = [name for name, _, length in properties if length]
    lists = [np.zeros((total, m), np.float64) for m in multiples]
    raw = np.frombuffer(data, np.uint8)
    for n, layout in layouts.items():
        which = np.flatnonzero(sizes == n)
        records = raw[places[which][:, None] + np.arange(layout.itemsize)].copy().view(layout).reshape(-1)
        corner = start[which][:, None] + np.arange(n)
        for name, target, m in zip(names, lists, multiples):
            target[corner] = records[name].reshape(len(which), n, m)
    return sizes, lists[0][:, 0].astype(np.int64), dict(zip(names[1:], lists[1:]))


def read(path: str) -> Mesh:
    """A file that `write` or the program has written."""
    with open(path, "rb") as file:
        elements = _read_header(file)
        data = file.read()
    count, properties = elements["vertex"]
    layout = _record(properties, [])
    vertices = np.frombuffer(data, layout, count)
    columns = {name: vertices[name] for name in layout.names if name not in ("x", "y", "z")}
    points = np.stack([vertices[axis].astype(np.float64) for axis in "xyz"], axis=1)
    faces, face_properties = elements.get("face", (0, []))
    sizes, corners, lists = _read_faces(data, count * layout.itemsize, faces, face_properties)
    return Mesh(points, sizes, corners, columns, lists)

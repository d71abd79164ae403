"""Shapes: what a coat grows on, from files, from arrays, or from the objects of other libraries."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import UsageError

Points = NDArray[np.float64]
Triangles = NDArray[np.int32]


class Shape:
    """A checked and repaired shape: a surface of triangles, a cloud of points, a grid, patches or a volume.

    Shape(points, faces) takes points of shape (n, 3) [world units] and faces, counter-clockwise from outside, of shape
    (m, 3), (m, 4), ..., or a list of faces with different numbers of corners; without faces at least 32 points are a
    cloud. `attributes` are numbers of shape (k,) or (k, components): k values at the points, or, where k is the number
    of corners, or else of faces, at these. `uv` has two numbers for every point or for every corner of all faces, one
    face after the other. `metres_per_unit` is 0.001 where coordinates count millimetres. InputError for what is no
    shape; `findings` tell what was repaired.
    """

    def __init__(self, points: ArrayLike, faces: ArrayLike | Sequence[Sequence[int]] | None = None, *,
                 uv: ArrayLike | None = None, attributes: Mapping[str, ArrayLike] | None = None,
                 metres_per_unit: float | None = None, name: str = "mesh"):
        polygons = _polygons(points, faces)
        given = dict(attributes or {})
        if uv is not None:
            given["uv"] = uv
        for key, values in given.items():
            array = np.asarray(values, dtype=float)
            polygons.set(key, array, _domain(key, len(array), np.shape(points)[0], faces))
        if metres_per_unit is not None:
            polygons.set_unit(metres_per_unit)
        self._file = _core.check_shape(polygons, name)
        self.name = name

    @classmethod
    def _of(cls, file: _core.ShapeFile, name: str) -> "Shape":
        shape = cls.__new__(cls)
        shape._file, shape.name = file, file.name or name
        return shape

    @property
    def kind(self) -> str:
        """ "surface", "points", "grid", "patches" or "volume"."""
        return self._file.kind

    @property
    def points(self) -> Points:
        """(n, 3) [world units], in the memory of the shape."""
        return self._file.mesh.points

    @property
    def triangles(self) -> Triangles:
        """(m, 3): numbers of points, counter-clockwise from outside; of a volume its skin."""
        return self._file.mesh.triangles

    @property
    def attributes(self) -> dict[str, NDArray[np.float64]]:
        """Numbers by name, of shape (k,) or (k, components), in the memory of the shape."""
        mesh = self._file.mesh
        return {name: mesh.attribute(name) for name in mesh.attribute_names}

    @property
    def findings(self) -> list[dict[str, Any]]:
        """What was found and repaired: kind, text, count, element (the first one), repaired."""
        return self._file.findings

    @property
    def grid(self) -> dict[str, Any] | None:
        """Of grids: count (nodes along x, y, z), periodic, dimension; else None."""
        return self._file.grid

    @property
    def up(self) -> str:
        """The axis that points up, as far as the file says: "y" or "z"."""
        return self._file.up

    @property
    def metres_per_unit(self) -> float | None:
        return self._file.metres_per_unit

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the repaired mesh; the extension is the format, see mesh_extensions()."""
        self._file.mesh.save(os.fspath(path), self.name, self.up, False)

    def with_uv(self, size: int = 2048, progress: Any = None) -> "Shape":
        """The same with an atlas for square images of so many texels a side, as `pelage unwrap` makes it."""
        polygons = self._file.polygons()
        uv, _, _ = _core.unwrap(polygons, *_core.atlas_options(size), progress)
        polygons.set("uv", uv, "corner")
        return Shape._of(_core.check_shape(polygons, self.name), self.name)

    def __repr__(self) -> str:
        return f"<pelage.Shape {self.name}: {self.kind}, {len(self.points)} points, {len(self.triangles)} triangles>"


#: What functions take for a shape: a path or "builtin:NAME?n=...", a Shape, a pair of arrays (points, faces), or an
#: object of trimesh, meshio, pyvista or the like.
ShapeLike = Union[str, "os.PathLike[str]", Shape, "tuple[ArrayLike, ArrayLike]", Any]


def load(path: str | os.PathLike[str]) -> Shape:
    """Reads a file, or makes a built-in shape or grid ("builtin:animal", "builtin:tile?n=512"). InputError, located."""
    text = os.fspath(path)
    builtin = text.startswith("builtin:")
    name = text.split(":")[1].split("?")[0] if builtin else os.path.splitext(os.path.basename(text))[0]
    return Shape._of(_core.find_shape(text), name)


def as_shape(shape: ShapeLike) -> Shape:
    """The Shape that something stands for; UsageError where that is not known.

    By what they have: `vertices` and `faces` (trimesh and others), `points` and `cells_dict` (meshio: triangles and
    quads), `points` and `regular_faces` or `irregular_faces` (pyvista).
    """
    if isinstance(shape, Shape):
        return shape
    if isinstance(shape, (str, os.PathLike)):
        return load(shape)
    if isinstance(shape, (tuple, list)) and len(shape) == 2:
        return Shape(shape[0], shape[1])
    other: Any = shape
    if hasattr(other, "vertices") and hasattr(other, "faces"):
        return Shape(other.vertices, other.faces)
    if hasattr(other, "points") and hasattr(other, "cells_dict"):
        return Shape(other.points, _faces_of_cells(other.cells_dict))
    if hasattr(other, "points") and hasattr(other, "faces"):
        return Shape(other.points, _faces_of_counts(np.asarray(other.faces)))
    raise UsageError(f"a {type(shape).__name__} is no shape: give a path, a pair of arrays (points, faces), or an "
                     "object with points and faces")


def _polygons(points: ArrayLike, faces: Any) -> _core.Polygons:
    rows = np.asarray(points, dtype=float)
    if faces is None:
        return _core.Polygons(rows, np.zeros((0, 3), np.int32))
    if _is_ragged(faces):
        sizes = [len(face) for face in faces]
        corners = np.fromiter((v for face in faces for v in face), np.int64, sum(sizes))
        return _core.Polygons(rows, _indices(corners), np.asarray(sizes, np.int64))
    return _core.Polygons(rows, _indices(np.asarray(faces)))


def _indices(numbers: NDArray[Any]) -> NDArray[np.int32]:
    if numbers.size and not np.issubdtype(numbers.dtype, np.integer):
        raise UsageError(f"faces hold numbers of points, and these are {numbers.dtype}")
    if numbers.size and (numbers.min() < 0 or numbers.max() > np.iinfo(np.int32).max):
        raise UsageError("faces hold numbers of points, from 0")
    return numbers.astype(np.int32, copy=False)


def _is_ragged(faces: Any) -> bool:
    return not isinstance(faces, np.ndarray) and len({len(face) for face in faces}) > 1


def _corner_count(faces: Any) -> int:
    return 0 if faces is None else sum(len(f) for f in faces) if _is_ragged(faces) else np.asarray(faces).size


def _domain(name: str, count: int, points: int, faces: Any) -> str:
    for domain, elements in (("vertex", points), ("corner", _corner_count(faces)),
                             ("face", 0 if faces is None else len(faces))):
        if count == elements:
            return domain
    raise UsageError(f"the attribute {name} has {count} rows: neither one for each of {points} points, nor for each "
                     f"of {_corner_count(faces)} corners, nor for each face")


def _faces_of_cells(cells: Mapping[str, Any]) -> Any:
    known = {"triangle", "quad", "polygon"}
    faces: list[Any] = [face for kind in sorted(known & set(cells)) for face in np.asarray(cells[kind])]
    if not faces:
        raise UsageError(f"the cells are {', '.join(sorted(cells)) or 'none'}; a surface has triangles or quads")
    return faces


def _faces_of_counts(flat: NDArray[Any]) -> Any:
    """Faces as VTK has them, each after its number of corners; or rows already."""
    if flat.ndim == 2:
        return flat
    faces, at = [], 0
    while at < len(flat):
        faces.append(flat[at + 1:at + 1 + flat[at]])
        at += 1 + int(flat[at])
    return faces

"""Shapes without growth: fairing, direction fields, grids, and the measures of patterns on them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .growing import Progress
from .shapes import Points, Shape, ShapeLike, as_shape, load


class Faired(NamedTuple):
    """points:  (n, 3), one for each of shape.points
    shape:   the mesh with them
    report:  noise and moved (in mean edges), steps, volumes before and after, ..."""

    points: Points
    shape: Shape
    report: dict[str, Any]


def fair(shape: ShapeLike, faces: ArrayLike | None = None, *, method: str = "guided", noise: float | None = None,
         steps: int | None = None, slide: bool = False, progress: Progress | None = None) -> Faired:
    """Takes the noise off a surface, fair(shape) or fair(points, faces), and keeps its edges.

    method:  "guided", "paper", "isotropic" or "taubin"
    noise:   standard deviation along the normals [mean edges]; default: estimated
    steps:   exactly so many; default: until the noise is off
    slide:   vertices on boundaries move along these; else they stay
    """
    given = as_shape(shape if faces is None else (shape, faces))
    mesh, report = _core.fair(given._file.mesh, method, noise, steps, slide, progress)
    return Faired(mesh.points, Shape._of(given._file.with_mesh(mesh), given.name), report)


class DirectionField(NamedTuple):
    """directions:        (n, 3): a unit tangent at every point, one of n that turn by 2 pi / n
    n:                 1: vectors, 2: lines, 4: crosses
    singular_faces:    triangles in which directions turn around; `singular_indices` counts the turns by 2 pi / n
    roughness:         mean square of the turn per length, times n^2 [1 / world^2]"""

    directions: Points
    n: int
    singular_faces: NDArray[np.int32]
    singular_indices: NDArray[np.int32]
    roughness: float


def direction_field(shape: ShapeLike, faces: ArrayLike | None = None, *, n: int = 2,
                    axis: Sequence[float] | None = None, curvature: bool = False, strokes: Sequence[ArrayLike] = (),
                    across: bool = False, smooth: float | None = None) -> DirectionField:
    """Tangent directions as smooth as the surface and the wishes allow: the projection of an axis, the larger principal
    curvature, polylines near the surface of shape (k, 3) that are followed exactly; `across` turns all but these by a
    right angle. `smooth` is the length over which wishes are smoothed [world units; default: 0.05 diagonals]."""
    given = as_shape(shape if faces is None else (shape, faces))
    polylines = [np.asarray(stroke, dtype=float) for stroke in strokes]
    point = None if axis is None else tuple(float(x) for x in axis)
    return DirectionField(**_core.direction_field(given._file.mesh, n, point, curvature, polylines, across, smooth))


def grid(name: str) -> Shape:
    """A grid: built in ("builtin:swan", "builtin:tile?n=512"), fitted to a region of a .toml file, or a grid's file. Its
    points are nodes; `grid` tells how many along each axis."""
    return load(name)


def measure(shape: ShapeLike, field: str = "", level: float | None = None) -> dict[str, Any]:
    """What the pattern of a finished coat is like, in numbers, as `pelage measure` gives them (docs/measure.md); lengths
    in world units. `field`: a number at every point, by default the first; `level`: where parts end."""
    return _core.measure(as_shape(shape)._file, field, level)

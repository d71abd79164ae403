"""Coats: grown at once, or step by step."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Callable, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import UsageError
from .recipes import Changes, RecipeLike, planned
from .shapes import Points, Shape, ShapeLike, Triangles, as_shape

if TYPE_CHECKING:
    from typing_extensions import Unpack

#: Called with what is being done and the fraction of it that is (negative: unknown), many times a second; returning
#: False stops the work with Cancelled, and an exception stops it with that. Ctrl-C does, too, with or without one.
Progress = Callable[[str, float], Optional[bool]]


class Coat:
    """A coat as it stood when it was taken: a finer mesh with colours and fields."""

    def __init__(self, growth: _core.Growth, shape: Shape, recipe: _core.Recipe):
        self._growth, self._recipe = growth, recipe
        self.shape = shape
        self._mesh = growth.dress()
        self._moment = _moment(growth)
        self._fields: dict[str, NDArray[np.float64]] | None = None

    @property
    def points(self) -> Points:
        """(n, 3) [world units], in the memory of the coat."""
        return self._mesh.points

    @property
    def triangles(self) -> Triangles:
        """(m, 3), counter-clockwise from outside, in the memory of the coat."""
        return self._mesh.triangles

    @property
    def colors(self) -> NDArray[np.float64]:
        """(n, 3): red, green and blue, linear light from 0 to 1."""
        return self._mesh.attribute("color")

    @property
    def normals(self) -> NDArray[np.float64]:
        """(n, 3) of unit length; where edges are sharp, one for each corner of the triangles."""
        return self._mesh.attribute("normal")

    @property
    def attributes(self) -> dict[str, NDArray[np.float64]]:
        """All that the files of the coat have beside points and triangles."""
        return {name: self._mesh.attribute(name) for name in self._mesh.attribute_names}

    @property
    def fields(self) -> dict[str, NDArray[np.float64]]:
        """Concentrations at the points by species, "STAGE.SPECIES" of earlier stages: (n,)."""
        if self._fields is None:
            self._require_moment("its fields")
            self._fields = self._growth.fields()
        return self._fields

    @property
    def uniform(self) -> bool:
        """Whether there is no pattern, and so no coat; `why_uniform` says why."""
        return self._growth.uniform

    @property
    def why_uniform(self) -> str:
        return self._growth.why_uniform

    @property
    def warnings(self) -> list[str]:
        """What may spoil it, or was done otherwise than asked."""
        return self._growth.warnings

    @property
    def summary(self) -> dict[str, Any]:
        """How the last stage ended: status, time, steps, change, ..."""
        return self._growth.summary

    def measure(self, field: str | None = None, level: float | None = None) -> dict[str, Any]:
        """What the pattern is like, in numbers, as `pelage measure` gives them (docs/measure.md); lengths in world
        units. `field`: a species, by default the last; `level`: where parts end."""
        name = field or self._growth.species[-1]
        if self.shape.kind in ("surface", "patches"):
            return _core.measure(self.shape._file.with_mesh(self._mesh), name.replace(".", "_"), level)
        self._require_moment("its nodes")
        nodes = self._growth.nodes().with_attribute(name, self._growth.values(name), "vertex")
        return _core.measure(self.shape._file.with_mesh(nodes), name, level)

    def save(self, path: str | os.PathLike[str], *, bake: int | None = None, compress: bool = False) -> list[str]:
        """Writes .glb, .ply, .obj, .vtp, .stl, .off or .3mf; returns what the format cannot hold, a line each.

        With `bake` (.glb) the coat is images of so many texels a side on the shape as it was given, on its uv or else
        on an atlas that is made for it.
        """
        file = os.fspath(path)
        extension = os.path.splitext(file)[1]
        name, up = self.shape.name, self.shape.up
        if bake is not None:
            if extension.lower() != ".glb":
                raise UsageError(f"{file}: of the formats only GLB holds an image; images() gives them as arrays")
            self._baked(bake).save(file, name, up, compress)
            return []
        mesh: _core.Mesh | _core.Polygons = self._mesh
        if self._recipe.keeps_shape and len(self.triangles):
            self._require_moment("the form of its file")
            mesh = self._growth.dress_in_file()
        mesh.save(file, name, up, compress)
        return mesh.losses(extension)

    def images(self, size: int = 2048) -> dict[str, NDArray[Any]]:
        """The coat as square images on the uv of its shape, row 0 on top: "color" (sRGB bytes), "height" (floats [world
        units], or the shown species where the look has no height), and "normal", "roughness", ... where it has these.
        """
        return self._baked(size).images()

    def image(self) -> NDArray[np.float64]:
        """Of a coat on a sheet of nodes, a pixel for each: (rows, columns, 3), linear light, the largest y on top."""
        grid = self.shape.grid
        if grid is None or grid["dimension"] != 2:
            raise UsageError("only a sheet of nodes is an image; images() has those on the uv of surfaces")
        columns, rows = grid["count"][:2]
        return self.colors.reshape(rows, columns, 3)[::-1]

    def render(self, width: int = 1024, height: int = 1024, *, samples: int = 32, azimuth: float = 35,
               elevation: float = 14, up: str | None = None, progress: Progress | None = None) -> NDArray[np.float32]:
        """A picture: (height, width, 3), linear light; save_png() writes it. Angles in degrees."""
        return self._mesh.render(width, height, samples, azimuth, elevation, up or self.shape.up, progress)

    def _repr_png_(self) -> bytes:
        """What a notebook shows of it."""
        grid = self.shape.grid
        flat = grid is not None and grid["dimension"] == 2
        picture = self.image().astype(np.float32) if flat else self.render(512, 512, samples=16)
        return _core.png_bytes(picture)

    def _baked(self, size: int) -> _core.TexturedMesh:
        self._require_moment("its images")
        return self._growth.bake(size)

    def _require_moment(self, what: str) -> None:
        if _moment(self._growth) != self._moment:
            raise UsageError(f"the run has gone on since this coat was taken, and {what} with it; take the coat again")

    def __repr__(self) -> str:
        return f"<pelage.Coat on {self.shape.name}: {len(self.points)} points{', uniform' if self.uniform else ''}>"


class Run:
    """A coat that grows step by step.

        run = pelage.Run("cow.obj", "leopard", size=0.04)
        while not run.done:
            run.advance(100)
        run.coat().save("cow.glb")

    Use a run from one thread at a time; it uses several itself, and several runs may grow in several threads.
    """

    def __init__(self, shape: ShapeLike | None, recipe: RecipeLike | None = None, *,
                 progress: Progress | None = None, **changes: Unpack[Changes]):
        plan = planned(recipe, changes)
        self.shape = as_shape(shape if shape is not None else _shape_of(plan.recipe))
        self._recipe = plan.recipe
        self._growth = _core.Growth(self.shape._file, plan.recipe, progress, plan.rates, "")

    @property
    def done(self) -> bool:
        return self._growth.done

    @property
    def fraction(self) -> float:
        """Of the way to the end, as far as it is known."""
        return self._growth.fraction

    def advance(self, steps: int = 1) -> "Run":
        """Up to so many steps, fewer if the coat is done before. NumericsError when the fields blow up."""
        self._growth.advance(steps)
        return self

    def finish(self) -> "Run":
        """All steps to the end."""
        self._growth.finish()
        return self

    @property
    def step_report(self) -> dict[str, Any]:
        """How the stage stands: status, message, time [model], steps, step, change, iterations, rejected, minimum,
        maximum."""
        return self._growth.summary

    @property
    def time(self) -> float:
        """Of the model, in the stage in progress."""
        return float(self._growth.summary["time"])

    @property
    def stage(self) -> tuple[int, int, str]:
        """Number of the stage in progress, from 0, how many there are, and its name."""
        return self._growth.stage

    @property
    def species(self) -> list[str]:
        """Of the stage in progress."""
        return self._growth.species

    @property
    def warnings(self) -> list[str]:
        return self._growth.warnings

    @property
    def uniform(self) -> bool:
        return self._growth.uniform

    def nodes(self) -> tuple[Points, Triangles]:
        """Where the unknowns are: points (n, 3) [world units], and the triangles between them, (0, 3) where there are
        none."""
        mesh = self._growth.nodes()
        return mesh.points, mesh.triangles

    def get(self, species: str) -> NDArray[np.float64]:
        """Concentrations at the nodes: (n,)."""
        return self._growth.values(species)

    def set(self, species: str, values: ArrayLike) -> "Run":
        """Replaces the concentrations at the nodes, (n,) or one number; steps begin anew from there."""
        count = len(self._growth.values(species))
        self._growth.set_values(species, np.broadcast_to(np.asarray(values, dtype=float), (count,)))
        return self

    def coat(self) -> Coat:
        """The coat as it stands."""
        return Coat(self._growth, self.shape, self._recipe)

    def checkpoint(self) -> bytes:
        """Everything that changes: another run of the same shape and recipe that restores it goes on with the same
        bits."""
        return self._growth.checkpoint()

    def restore(self, checkpoint: bytes) -> "Run":
        """InputError where the bytes are none of this shape and recipe; the run is then as before."""
        self._growth.restore(checkpoint)
        return self

    def __repr__(self) -> str:
        return f"<pelage.Run on {self.shape.name}: {100 * self.fraction:.0f} %>"


def grow(shape: ShapeLike | None = None, recipe: RecipeLike | None = None, *, progress: Progress | None = None,
         **changes: Unpack[Changes]) -> Coat:
    """The finished coat of a recipe on a shape; with neither recipe nor model that of the model "turing".

    shape:    path, "builtin:NAME", Shape, (points, faces), or an object of another library; None: that of the recipe
    recipe:   name (recipe_names()), path or text of a .toml, or a Model
    changes:  see Changes: size=0.04, seed=3, quality="draft", parameters={"s": 0.06}, ...

    UsageError, InputError, NumericsError; a coat without a pattern is `uniform`.
    """
    return Run(shape, recipe, progress=progress, **changes).finish().coat()


def tile(recipe: RecipeLike | None = None, *, nodes: int | tuple[int, int] = 512, progress: Progress | None = None,
         **changes: Unpack[Changes]) -> Coat:
    """A coat on a flat tile that repeats without a seam, of so many nodes (or columns, rows); image() gives it as
    pixels, whose number `size="24px"` may count in."""
    columns, rows = (nodes, nodes) if isinstance(nodes, int) else nodes
    return grow(f"builtin:tile?n={columns}x{rows}", recipe, progress=progress, **changes)


def _shape_of(recipe: _core.Recipe) -> str:
    if not recipe.shape:
        raise UsageError("no shape to grow on; name a file or a built-in one, for example builtin:animal")
    return recipe.shape


def _moment(growth: _core.Growth) -> tuple[int, float, int]:
    summary = growth.summary
    return growth.stage[0], summary["time"], summary["steps"]

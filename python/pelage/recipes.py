"""Recipes and models, and what may be changed in them."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Callable, TypedDict, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import UsageError

#: Rates of a program's own: called with the time and an array of concentrations for each species, of equal length and
#: not to be written to nor kept; returns as many arrays of rates, or numbers where these are the same everywhere.
Rates = Callable[..., Sequence[Union[NDArray[np.float64], float]]]


class Model:
    """Equations of your own.

    text:   a model file's text (docs/models.md), whose name is `name`
    rates:  a function instead of the text's rates, see Rates; diffusion, time steps and all else stay with the library.
            It is called for blocks of places, from several threads but one at a time, and is slower than text.
    """

    def __init__(self, text: str, name: str = "own", rates: Rates | None = None):
        self.text, self.name, self.rates = text, name, rates

    @classmethod
    def from_rates(cls, rates: Rates, diffusion: Mapping[str, float], initial: Mapping[str, Union[float, str]], *,
                   spacing: float, end: float | None = None, step: float | None = None, name: str = "own") -> "Model":
        """A model without a text: species in the order of `diffusion` [model length^2 / time], their initial values as
        numbers or formulas ("1 + 0.01 * noise()"), and the spacing of the finished pattern [model length], which
        `size` stretches. `end`: time after which it is finished; `step`: of the first steps."""
        if set(initial) != set(diffusion):
            raise UsageError(f"initial values of {', '.join(initial)}, but diffusion of {', '.join(diffusion)}")
        lines = [f'name = "{name}"', f'title = "{name}"', f"wavelength = {float(spacing)!r}"]
        suggested = {"end": end, "step": step}
        for species, rate in diffusion.items():
            lines += [f"[species.{species}]", f'diffusion = "{float(rate)!r}"', 'rate = "0"',
                      f'initial = "{initial[species]}"']
        if any(value is not None for value in suggested.values()):
            lines += ["[suggested]"] + [f"{key} = {float(v)!r}" for key, v in suggested.items() if v is not None]
        return cls("\n".join(lines) + "\n", name, rates)

    def __repr__(self) -> str:
        return f"<pelage.Model {self.name}{', rates in Python' if self.rates else ''}>"


RecipeLike = Union[str, "os.PathLike[str]", Model]


class Changes(TypedDict, total=False):
    """What functions that grow take beside a recipe: the options of `pelage grow` that change it, under their names.

    size is a fraction of the diagonal as a number (0.04), or a text ("4mm", "1.5u", "24px"). parameters are numbers, or
    texts with a formula of the place; "STAGE.PARAM" names those of a stage, and the parameter "size" is a map of the
    size (text) or a stage's size (number or length). materials are formulas by channel ("roughness", "height", ...),
    textures files by name. strokes are polylines of shape (n, 3) that directions follow. fields=False leaves the
    concentrations out of files.
    """

    model: Union[str, Model]
    parameters: Mapping[str, Union[float, str]]
    size: Union[float, str]
    unit: Union[float, str]
    seed: int
    quality: str
    method: str
    stepper: str
    solver: str
    solid: bool
    cells: int
    step: float
    steps: int
    until: float
    stationary: float
    refresh: int
    interpolate: bool
    crease: float
    fair: Union[bool, str]
    growth: float
    motion: str
    every: int
    species: str
    ramp: str
    invert: bool
    materials: Mapping[str, Union[float, str]]
    textures: Mapping[str, Union[str, "os.PathLike[str]"]]
    strokes: Sequence[ArrayLike]
    detail: int
    keep_shape: bool
    flat: bool
    displace: bool
    fields: bool


class Planned:
    """A recipe with all changes, and the rates that take the place of its model's; what everything grows by."""

    def __init__(self, recipe: _core.Recipe, rates: Rates | None):
        self.recipe, self.rates = recipe, rates


def planned(recipe: RecipeLike | None, changes: Mapping[str, Any]) -> Planned:
    """`recipe`: a name, a path ending in .toml, the text of one, a Model, or None for a model alone."""
    unknown = set(changes) - set(Changes.__annotations__)
    if unknown:
        raise TypeError(f"unknown argument {sorted(unknown)[0]!r}; known: {', '.join(sorted(Changes.__annotations__))}")
    changes = dict(changes)
    if isinstance(recipe, Model):
        if "model" in changes:
            raise UsageError("give the model once: as the recipe, or as model=")
        recipe, changes["model"] = None, recipe
    read = _read(recipe)
    model = changes.get("model")
    rates = None
    if isinstance(model, Model):
        read, rates = read.with_model(model.name, model.text), model.rates
        changes["model"] = model.name
    read = read.with_changes(_as_options(changes))
    if changes.get("strokes") is not None:
        read = read.with_strokes([np.asarray(stroke, dtype=float) for stroke in changes["strokes"]])
    return Planned(read, rates)


def _read(recipe: Any) -> _core.Recipe:
    if recipe is None:
        return _core.Recipe()
    if isinstance(recipe, _core.Recipe):
        return recipe
    text = os.fspath(recipe)
    return _core.parse_recipe(text, "recipe") if "\n" in text else _core.load_recipe(text)


def _as_options(changes: Mapping[str, Any]) -> _core.RecipeChanges:
    """As the command line has them."""
    options = _core.RecipeChanges()
    for name, value in changes.items():
        if value is None or name == "strokes":
            continue
        if name == "parameters":
            options.settings = [f"{key}={_text(v)}" for key, v in value.items() if not _is_map(key, v)]
            options.maps = [f"{key}={v}" for key, v in value.items() if _is_map(key, v)]
        elif name == "materials":
            options.channels = [f"{channel}={_text(v)}" for channel, v in value.items()]
        elif name == "textures":
            options.textures = [f"{key}={os.fspath(path)}" for key, path in value.items()]
        elif name == "fields":
            options.no_fields = not value
        elif name == "fair":
            options.fair = "guided" if value is True else value or ""
        elif name in ("size", "unit"):
            setattr(options, name, _text(value))
        else:
            setattr(options, name, value)
    return options


def _is_map(name: str, value: Any) -> bool:
    """A stage's size as a text is a length where it begins with a digit."""
    return isinstance(value, str) and not (name.endswith(".size") and value[:1].isdigit())


def _text(value: Any) -> str:
    return value if isinstance(value, str) else repr(float(value))

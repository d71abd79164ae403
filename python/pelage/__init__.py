"""Pelage: grows reaction-diffusion coats directly on surfaces.

    import pelage
    coat = pelage.grow("cow.obj", "leopard", size=0.04, seed=3)
    coat.save("cow.glb", bake=2048)
"""

from __future__ import annotations

import os

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from .errors import Cancelled, Error, InputError, NumericsError, OutputError, UsageError
from .geometry import DirectionField, Faired, direction_field, fair, grid, measure
from .growing import Coat, Run, grow, tile
from .matching import Match, match
from .models import Analysis, analyse
from .planar import measure_picture
from .recipes import Changes, Model
from .shapes import Shape, as_shape, load
from .sweeps import Table, sweep

__version__: str = _core.version


def recipe_names() -> list[str]:
    """The built-in recipes."""
    return _core.recipe_names()


def model_names() -> list[str]:
    """The built-in models, and their variants as "turing:production"."""
    return _core.model_names()


def mesh_extensions() -> list[str]:
    """Of the meshes that can be written, with the dot."""
    return _core.mesh_extensions()


def save_png(picture: ArrayLike, path: str | os.PathLike[str]) -> None:
    """Writes a picture (height, width, 3) in linear light as PNG, sRGB with 8 bits a channel."""
    _core.write_png(np.asarray(picture, dtype=np.float32), os.fspath(path))


__all__ = ["Analysis", "Cancelled", "Changes", "Coat", "DirectionField", "Error", "Faired", "InputError", "Match",
           "Model", "NumericsError", "OutputError", "Run", "Shape", "Table", "UsageError", "analyse", "as_shape",
           "direction_field", "fair", "grid", "grow", "load", "match", "measure", "measure_picture",
           "mesh_extensions", "model_names", "recipe_names", "save_png", "sweep", "tile"]

"""What linear theory knows about models before anything grows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .recipes import Model


class Analysis:
    """Linear stability about the steady state nearest to the initial values. Lengths and times in model units.

    title, parameters, species: of the model
    regime:         "turing", "waves", "oscillation", "quiet", ...; `verdict` says it in a line
    wavelength:     that grows fastest, or None; `growth` its rate, `oscillatory` whether it travels
    band:           wave numbers (2 pi / wavelength) between which waves grow, or (None, None)
    spacing:        of the finished pattern, which size stretches, or None
    steady_states:  all that were found, concentrations in the order of the species; `chosen` is the number of the one
    eigenvalues:    of the uniform system there
    conditions:     for a Turing pattern: (text, holds)
    thresholds:     where waves begin or end to grow, in words
    largest_steps:  stable steps of the steppers on the coarsest mesh that carries the pattern
    """

    def __init__(self, analysis: _core.Analysis):
        self._analysis = analysis

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._analysis, name)

    def dispersion(self, wave_numbers: ArrayLike) -> NDArray[np.complex128]:
        """Growth rates, with angular frequencies as imaginary parts, of waves exp(i k x): the eigenvalue of J - k^2 D
        with the largest real part."""
        return self._analysis.dispersion(np.asarray(wave_numbers, dtype=float))

    def __repr__(self) -> str:
        return f"<pelage.Analysis of {self._analysis.title}: {self._analysis.verdict}>"


def analyse(model: Union[str, Model], parameters: Mapping[str, float] | None = None) -> Analysis:
    """Of a built-in model ("turing", "gray-scott:spots"), the path of a .toml file, or a Model, with some of its
    parameters changed. A Model's rates in Python are not looked at: its text is."""
    if isinstance(model, Model):
        return Analysis(_core.analyse(model.name, dict(parameters or {}), {model.name: model.text}))
    return Analysis(_core.analyse(model, dict(parameters or {}), {}))

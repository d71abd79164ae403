"""The inverse problem: parameters of a model whose coats have the measures of a target."""

from __future__ import annotations

import itertools
import math
import threading
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Callable, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core
from .errors import Cancelled, Error, NumericsError, UsageError
from .growing import Coat, Run, grow, tile
from .models import Analysis, analyse
from .planar import grey, kind_of, measure_picture
from .recipes import Model
from .shapes import ShapeLike
from .sweeps import cores, run_all

Numbers = NDArray[np.float64]
#: A flat picture, a coat, or measures by name.
Target = Union[Coat, Mapping[str, Any], ArrayLike]

#: What counts as met: of the wavelength a fraction, of the orientation degrees.
TOLERANCES = {"wavelength": 0.05, "coverage": 0.05, "euler": 0.15, "coherence": 0.1, "bandwidth": 0.15,
              "orientation": 10.0, "kind": 0.5}

#: Nodes to a wavelength and wavelengths across the tiles that are grown.
_RESOLUTION, _LEAST_ACROSS, _USUAL_ACROSS, _MOST_ACROSS = 10, 6, 8, 10
#: From this order on a picture has an orientation.
_ORDERED = 0.5
#: Runs of the search are shared out: this part over all of the bounds, the rest in rounds nearer and nearer.
_SPREAD, _ROUNDS = 0.4, 4
#: Deviation of proposals, in parts of the bounds, around a single place.
_STRAY = 0.2
#: Where linear theory refuses places, others are tried, so many times.
_ATTEMPTS = 5
#: Candidates that are grown again with further seeds.
_FINALISTS = 4
#: Fewer trials than these within all tolerances say nothing of the uncertainty: then the nearest ones do.
_FEWEST = 12
_REFUSED = "refused"
#: So many tolerances nearer an inverted pattern has to be.
_PREFERENCE = 0.1
#: Range of parameters without bounds and variants: value / this to value * this.
_FACTOR = 1.5
#: From this standard deviation on, in those of the bounds, a combination of parameters is not determined.
_LOOSE = 0.5


@dataclass
class Reached:
    """One measure of a match.

    wanted:      of the target
    reached:     mean over the seeds
    error:       standard error of their difference: over the seeds, and of a picture as large as the target
    tolerance:   within which it counts as met
    """

    wanted: Any
    reached: Any
    error: float
    tolerance: float
    miss: float  # in tolerances

    @property
    def met(self) -> bool:
        return abs(self.miss) <= 1


@dataclass
class Match:
    """What was found.

    parameters:     of the model
    size:           wavelength to ask for, in the unit of the target; None where the target has no wavelength
    invert:         what is low is the pattern
    measures:       by name: what was wanted and what was reached, see Reached
    uncertainty:    by parameter: the interval that holds 90 % of the values that would do
    combinations:   of parameters, each scaled to its bounds: (weights by name, standard deviation in those of the
                    bounds); near 1 the combination is not determined at all, near 0 it is
    supporting:     of how many runs the uncertainty is made (the effective number)
    runs:           coats grown
    skipped:        places at which nothing grows by linear theory, or the model's wavelength is unknown
    failed:         runs by what became of them ("no pattern", ...)
    """

    model: Union[str, Model]
    parameters: dict[str, float]
    size: Optional[float]
    invert: bool
    measures: dict[str, Reached]
    bounds: dict[str, tuple[float, float]]
    uncertainty: dict[str, tuple[float, float]]
    combinations: list[tuple[dict[str, float], float]]
    supporting: float
    runs: int
    skipped: int
    failed: dict[str, int]
    notes: list[str]
    species: str
    level: float
    softness: float
    colors: tuple[str, str]
    trials: list[dict[str, Any]] = field(repr=False, default_factory=list)

    @property
    def reached(self) -> bool:
        """Whether all measures are within their tolerances."""
        return all(m.met for m in self.measures.values())

    @property
    def missed(self) -> list[str]:
        """The measures that are not."""
        return [name for name, m in self.measures.items() if not m.met]

    def recipe(self) -> str:
        """The text of a recipe with the colours of the target (docs/recipes.md). A Model's text is within; rates in
        Python are not."""
        name = self.model.name if isinstance(self.model, Model) else self.model
        lines = ['name = "match"', f'summary = "Matched with {name}"']
        if isinstance(self.model, Model):
            lines += ["[models]", f"{name} = '''", self.model.text.rstrip("\n"), "'''"]
        lines += ["[stage]", f'model = "{name}"']
        if self.size is not None:
            lines.append(f'size = "{self.size:.9g}u"')
        values = ", ".join(f"{key} = {value!r}" for key, value in self.parameters.items())
        lines.append(f"parameters = {{ {values} }}")
        low, high = self.level - self.softness, self.level + self.softness
        ends = (high, low) if self.invert else (low, high)
        lines += ["[[look.layers]]", f'color = "{self.colors[0]}"', "[[look.layers]]", f'color = "{self.colors[1]}"',
                  f'opacity = "smoothstep({ends[0]:.6g}, {ends[1]:.6g}, {self.species})"']
        return "\n".join(lines) + "\n"

    def grow(self, shape: ShapeLike, **changes: Any) -> Coat:
        """The match as a coat; `size` is that of the target in units of the shape unless given."""
        if isinstance(self.model, Model) and self.model.rates is not None:
            changes.setdefault("model", self.model)
        return grow(shape, self.recipe(), **changes)

    def tile(self, nodes: int | tuple[int, int] = 256, **changes: Any) -> Coat:
        """The same on a flat tile; `size="24px"` is usual there."""
        if isinstance(self.model, Model) and self.model.rates is not None:
            changes.setdefault("model", self.model)
        return tile(self.recipe(), nodes=nodes, **changes)

    def summary(self) -> str:
        """All of it in words, a line each."""
        name = self.model.name if isinstance(self.model, Model) else self.model
        lines = [f"{name}: " + ("reached" if self.reached else f"not reached: {', '.join(self.missed)}")]
        for key, m in self.measures.items():
            shown = [m.wanted if isinstance(m.wanted, str) else f"{m.wanted:.4g}",
                     m.reached if isinstance(m.reached, str) else f"{m.reached:.4g}"]
            lines.append(f"  {key}: wanted {shown[0]}, reached {shown[1]} +- {m.error:.2g}"
                         + ("" if m.met else f", which is {abs(m.miss):.1f} tolerances off"))
        if self.size is not None:
            lines.append(f"  size {self.size:.4g}")
        lines += [f"  {key} = {value:.5g}, 90 % within {self.uncertainty[key][0]:.4g} to {self.uncertainty[key][1]:.4g}"
                  for key, value in self.parameters.items() if key in self.uncertainty]
        for weights, deviation in self.combinations:
            terms = " ".join(f"{w:+.2f} {key}" for key, w in weights.items() if abs(w) >= 0.2)
            lines.append(f"  {terms}: {'not determined' if deviation > _LOOSE else 'determined'}, "
                         f"{deviation:.2f} of the deviation of the bounds")
        lines.append(f"  {self.runs} runs, {self.skipped} skipped, "
                     + (", ".join(f"{n} failed ({why})" for why, n in self.failed.items()) or "none failed"))
        return "\n".join(lines + [f"  {note}" for note in self.notes])


def match(target: Target, model: Union[str, Model], bounds: Mapping[str, tuple[float, float]] | None = None, *,
          pixel: float = 1, periodic: bool = False, tolerances: Mapping[str, float] | None = None,
          invert: bool | None = None, runs: int = 120, seeds: int = 5, seed: int = 1, threads: int | None = None,
          progress: Callable[[int, int], Optional[bool]] | None = None) -> Match:
    """Parameters of `model` whose coats have the measures of `target`, and how well they are known.

    target:      a picture, (h, w), or (h, w, 3) in linear light or sRGB bytes, whose bright parts are the pattern; a
                 Coat; or measures by name:
                 "wavelength" [your unit], "coverage", "kind", "euler", "coherence", "bandwidth", "orientation"
                 [degrees] (measure_picture says what they are)
    bounds:      {"F": (0.02, 0.06), ...}; default: the parameters in which the model's variants differ, as far as these
                 go; of a model without variants all that its equations know, within a factor of 1.5
    pixel:       length of a pixel of the picture [your unit];  periodic: the picture repeats without a seam
    tolerances:  within which measures count as met, see TOLERANCES; math.inf: does not count
    invert:      whether what is low is the pattern; default: whichever suits
    runs:        coats that the search may grow;  seeds: of the finalists; `seed` begins the numbers of all starts
    threads:     so many runs at a time; default: one for each core
    progress:    called with the runs that are done and all of them; returning False stops the work

    The same arguments give the same result. See docs/python-match.md for the method and its limits.
    """
    wanted = _wanted_of(target, pixel, periodic, tolerances or {})
    search = _Search(model, bounds, wanted, invert, runs, seed, threads or cores(), progress)
    search.run(runs, seeds)
    return search.result(seeds)


# ---- the target ----------------------------------------------------------------------------------------------------


@dataclass
class _Wanted:
    measures: dict[str, Any]
    tolerances: dict[str, float]
    across: Optional[float]  # wavelengths along the side of the picture, whose chance is part of the errors
    periodic: bool
    colors: tuple[str, str]
    notes: list[str]

    def misses(self, measured: Mapping[str, Any], names: Sequence[str]) -> Numbers:
        return np.array([self.miss(name, measured[name]) for name in names])

    def miss(self, name: str, value: Any) -> float:
        """In tolerances."""
        wanted, tolerance = self.measures[name], self.tolerances[name]
        if name == "kind":
            return 0 if value == wanted else 1 / tolerance
        if name == "wavelength":
            return math.log(value / wanted) / tolerance
        apart = float(value) - float(wanted)
        return (apart if name != "orientation" else (apart + 90) % 180 - 90) / tolerance


def _wanted_of(target: Target, pixel: float, periodic: bool, tolerances: Mapping[str, float]) -> _Wanted:
    unknown = set(tolerances) - set(TOLERANCES)
    if unknown:
        raise UsageError(f"no measure {sorted(unknown)[0]!r}; there are {', '.join(TOLERANCES)}")
    colors = ("#1d1713", "#e9dcc3")
    notes: list[str] = []
    across: Optional[float] = None
    if isinstance(target, Mapping):
        found = dict(target)
        periodic = True
    elif isinstance(target, Coat):
        found, across, periodic = _measures_of_coat(target)
    else:
        values = grey(target)
        found = measure_picture(values, pixel=pixel, periodic=periodic)
        if found["kind"] != "uniform":
            across, colors = found["across"], _colors_of(target, values)
    if found.get("kind") == "uniform":
        raise UsageError("the target is uniform: it has no pattern to match")
    if not isinstance(target, Mapping):
        if found["order"] < _ORDERED:
            notes.append(f"its order is {found['order']:.2f}: no orientation is wanted")
            found.pop("orientation", None)
        if across is not None and across < _LEAST_ACROSS:
            notes.append(f"the picture is {across:.1f} wavelengths across: its measures are uncertain")
        found = {name: found[name] for name in TOLERANCES if name in found}
    unknown = set(found) - set(TOLERANCES)
    if unknown:
        raise UsageError(f"no measure {sorted(unknown)[0]!r}; there are {', '.join(TOLERANCES)}")
    all_tolerances = {**TOLERANCES, **tolerances}
    found = {name: value for name, value in found.items() if math.isfinite(all_tolerances[name])}
    if not set(found) - {"wavelength"}:
        raise UsageError("a wavelength alone has nothing to search for: give it as size")
    return _Wanted(found, all_tolerances, across, periodic, colors, notes)


def _measures_of_coat(coat: Coat) -> tuple[dict[str, Any], Optional[float], bool]:
    """Of tiles as of pictures; of surfaces by Coat.measure(), whose definitions are the same."""
    if coat.uniform:
        return {"kind": "uniform"}, None, True
    grid = coat.shape.grid
    if grid is not None and grid["dimension"] == 2:
        periodic = bool(grid["periodic"][0] and grid["periodic"][1])
        found = measure_picture(_sheet(coat), pixel=_spacing(coat), periodic=periodic)
        return found, found.get("across"), periodic
    m = coat.measure()
    if not m["spectrum"]["peak"] > 0:
        return {"kind": "uniform"}, None, True
    wavelength = 2 * math.pi / m["spectrum"]["peak"]
    euler = (m["above"]["parts"] - m["below"]["parts"]) * wavelength**2 / m["area"]
    k, share = m["spectrum"]["wave_number"], m["spectrum"]["share"]
    lower, upper = np.interp((0.25, 0.75), np.cumsum(share) - share / 2, np.log(k))
    found = {"wavelength": wavelength, "bandwidth": float(upper - lower), "coverage": m["above"]["share"],
             "euler": euler, "coherence": m["coherence"], "order": 0.0, "kind": kind_of(euler, m["coherence"])}
    return found, math.sqrt(m["area"]) / wavelength, True


def _sheet(coat: Coat) -> Numbers:
    """The last species as a picture, row 0 on top."""
    columns, rows = coat.shape.grid["count"][:2]  # type: ignore[index]
    return np.asarray(list(coat.fields.values())[-1].reshape(rows, columns)[::-1])


def _spacing(coat: Coat) -> float:
    return float(coat.points[1, 0] - coat.points[0, 0])


def _colors_of(picture: ArrayLike, values: Numbers) -> tuple[str, str]:
    """Of the ground and of the pattern, as medians."""
    colors = np.asarray(picture)
    scale = 255.0 if np.issubdtype(colors.dtype, np.integer) else 1.0
    linear = scale == 1.0
    if colors.ndim == 2:
        shades = (values - values.min()) / max(float(np.ptp(values)), 1e-300)
        colors, linear = np.repeat(shades[..., None], 3, 2), False
    else:
        colors = np.clip(np.repeat(colors, 3, 2) if colors.shape[2] == 1 else colors[..., :3], 0, None) / scale
    low, high = np.quantile(values, (0.005, 0.995))
    above = values > (low + high) / 2
    return _hex(np.median(colors[~above], 0), linear), _hex(np.median(colors[above], 0), linear)


def _hex(color: Numbers, linear: bool) -> str:
    c = np.clip(color, 0, 1)
    if linear:
        c = np.where(c <= 0.0031308, 12.92 * c, 1.055 * c**(1 / 2.4) - 0.055)
    return "#" + "".join(f"{round(255 * x):02x}" for x in c)


# ---- the search ----------------------------------------------------------------------------------------------------


@dataclass
class _Trial:
    at: Numbers  # in the unit cube of the bounds
    measures: dict[str, Any]
    inverted: bool
    distance: float


class _Search:
    """Rounds of approximate Bayesian computation: proposals of a round surround the trials that do best so far, and all
    trials are weighted by one over the density that all rounds together had there (Cornuet, Marin, Mira, Robert 2012).
    """

    def __init__(self, model: Union[str, Model], bounds: Mapping[str, tuple[float, float]] | None, wanted: _Wanted,
                 invert: bool | None, runs: int, seed: int, threads: int, progress: Any):
        if runs < 10:
            raise UsageError(f"runs is {runs}; at least 10")
        self.model, self.wanted, self.threads, self.progress = model, wanted, threads, progress
        self.analysis = analyse(model)
        self.starts: list[dict[str, float]] = [dict(self.analysis.parameters)]
        self.bounds = _checked(bounds, self.analysis) if bounds else self._bounds_of_variants()
        self.names = list(self.bounds)
        self.low = np.array([b[0] for b in self.bounds.values()], dtype=float)
        self.high = np.array([b[1] for b in self.bounds.values()], dtype=float)
        self.inversions = (False, True) if invert is None else (invert,)
        self.searched = [name for name in wanted.measures if name != "wavelength"]
        across = min(max(round(wanted.across or _USUAL_ACROSS), _LEAST_ACROSS), _MOST_ACROSS)
        self.nodes = across * _RESOLUTION
        self.random = np.random.default_rng(seed)
        self.next_seed = seed
        self.trials: list[_Trial] = []
        self.densities: list[tuple[int, Callable[[Numbers], Numbers]]] = []
        self.done = self.planned = self.skipped = 0
        self.failed: dict[str, int] = {}

    # -- what is searched

    def _bounds_of_variants(self) -> dict[str, tuple[float, float]]:
        own = self.analysis.parameters
        self.starts += [dict(analyse(name).parameters) for name in _variants_of(self.model)]
        ranges = {key: (min(s[key] for s in self.starts), max(s[key] for s in self.starts)) for key in own}
        if all(low == high for low, high in ranges.values()):
            ranges = {key: (min(v / _FACTOR, v * _FACTOR), max(v / _FACTOR, v * _FACTOR)) for key, v in own.items()}
        ranges = {key: r for key, r in ranges.items() if r[0] < r[1] and _acts(self.model, key, r)}
        if not ranges:
            raise UsageError("this model needs bounds: which parameters, from where to where")
        return ranges

    def values_at(self, at: Numbers) -> dict[str, float]:
        return {name: float(v) for name, v in zip(self.names, self.low + at * (self.high - self.low))}

    # -- runs

    def run(self, runs: int, seeds: int) -> None:
        self.planned = runs + (_FINALISTS + 2) * seeds
        count = round(_SPREAD * runs)
        points = self._points()
        for _ in range(_ATTEMPTS):
            missing = count - self.done
            if missing > 0:
                self._round([next(points) for _ in range(missing)], lambda x: np.ones(len(x)))
        if not self.trials:
            raise NumericsError(f"no pattern anywhere within the bounds: {self.done} runs without one, {self.skipped} "
                                "places where the model has no wavelength, by linear theory")
        left = runs - count
        for i in range(_ROUNDS):
            share = left // _ROUNDS + (1 if i < left % _ROUNDS else 0)
            near, density = self._near(share)
            self._round(near, density)

    def _cube(self, values: Mapping[str, float]) -> Numbers:
        places = (np.array([values[n] for n in self.names]) - self.low) / (self.high - self.low)
        return np.asarray(places.clip(0, 1))

    def _points(self) -> Iterator[Numbers]:
        """The variants, then points that fill the bounds evenly: the additive sequence of Roberts (2018)."""
        yield from (self._cube(start) for start in self.starts)
        d = len(self.names)
        root = 2.0
        for _ in range(60):
            root = (1 + root)**(1 / (d + 1))
        steps = root**-np.arange(1, d + 1)
        for i in itertools.count(1):
            yield (0.5 + i * steps) % 1

    def _near(self, count: int) -> tuple[list[Numbers], Callable[[Numbers], Numbers]]:
        """Points around the trials that do best, drawn by their weights, and the density of such points."""
        weights, places = self._accepted(max(6, len(self.trials) // 5))
        count_of = 1 / (weights**2).sum()  # the effective number; few places leave their own spread uncertain
        spread = (count_of * _covariance(weights, places) + _STRAY**2 * np.eye(len(self.names))) / (count_of + 1)
        covariance = 2 * spread
        root, inverse = np.linalg.cholesky(covariance), np.linalg.inv(covariance)
        points: list[Numbers] = []
        for _ in range(100 * count):
            centre = places[self.random.choice(len(places), p=weights)]
            at = centre + root @ self.random.standard_normal(len(self.names))
            if ((at < 0) | (at > 1)).any():
                continue
            points.append(at)
            if len(points) == count:
                break

        def density(x: Numbers) -> Numbers:
            d = x[:, None, :] - places
            powers = np.exp(-np.einsum("ijk,kl,ijl->ij", d, inverse, d) / 2) @ weights
            return np.asarray(powers / math.sqrt(np.linalg.det(2 * math.pi * covariance)))

        return points, density

    def _accepted(self, least: int) -> tuple[Numbers, Numbers]:
        """Weights and places of the trials that meet all tolerances, or of the nearest ones if these are too few."""
        inside = [t for t in self.trials if np.abs(self.wanted.misses(t.measures, self.searched)).max() <= 1]
        if len(inside) < least:
            inside = sorted(self.trials, key=lambda t: t.distance)[:least]
        places = np.array([t.at for t in inside])
        total = sum(n for n, _ in self.densities)
        weights = 1 / np.sum([n / total * density(places) for n, density in self.densities], axis=0)
        return weights / weights.sum(), places

    def _round(self, points: Sequence[Numbers], density: Callable[[Numbers], Numbers]) -> None:
        self.densities.append((len(points), density))
        for at, measured in zip(points, self._grown([(at, _RESOLUTION) for at in points])):
            if measured is not None:
                self.trials.append(self._trial(at, measured))

    def _trial(self, at: Numbers, measured: dict[str, Any]) -> _Trial:
        inverted = min(self.inversions, key=lambda i: self._distance(_inverted(measured, i)) + _PREFERENCE * i)
        return _Trial(at, _inverted(measured, inverted), inverted, self._distance(_inverted(measured, inverted)))

    def _distance(self, measured: Mapping[str, Any]) -> float:
        return float(np.sqrt((self.wanted.misses(measured, self.searched)**2).mean()))

    def _grown(self, what: Sequence[tuple[Numbers, float]]) -> list[Optional[dict[str, Any]]]:
        """Measures of a tile at each of these places and sizes [nodes], None of those without a pattern."""
        first = self.next_seed
        self.next_seed += len(what)
        stop = threading.Event()

        def one(i: int) -> Any:
            at, size = what[i]
            try:
                coat = tile(model=self.model, nodes=self.nodes, size=f"{size!r}px", seed=first + i,
                            parameters=self.values_at(at), progress=lambda *_: not stop.is_set())
            except Cancelled:
                raise
            except UsageError:  # the model has no wavelength there
                return _REFUSED
            except Error as fault:
                return type(fault).__name__
            if coat.uniform:
                return "no pattern"
            u = _sheet(coat)
            measured = measure_picture(u, pixel=1 / size, periodic=self.wanted.periodic)
            if measured["kind"] == "uniform":
                return "no pattern"
            low, high = np.quantile(u, (0.005, 0.995))
            return {**measured, "level": (low + high) / 2, "range": high - low, "species": list(coat.fields)[-1]}

        def told(done: int, _: int) -> Optional[bool]:
            return None if self.progress is None else self.progress(self.done + done, self.planned)

        found = run_all(one, range(len(what)), self.threads, stop, told)
        refused = found.count(_REFUSED)
        self.skipped += refused
        self.done += len(what) - refused
        for text in found:
            if isinstance(text, str) and text != _REFUSED:
                self.failed[text] = self.failed.get(text, 0) + 1
        return [m if isinstance(m, dict) else None for m in found]

    # -- what was found

    def result(self, seeds: int) -> Match:
        weights, places = self._accepted(_FEWEST)
        finalists = [t.at for t in sorted(self.trials, key=lambda t: t.distance)[:_FINALISTS]]
        finalists.append(weights @ places)
        best, inverted, ratio = self._best(finalists, seeds)
        final = self._grown([(best, _RESOLUTION / ratio)] * seeds)
        measured = [_inverted(m, inverted) for m in final if m is not None]
        if not measured:
            raise NumericsError("what was found does not grow again with other seeds")
        notes = list(self.wanted.notes)
        if len(measured) < seeds:
            notes.append(f"{seeds - len(measured)} of {seeds} seeds have no pattern")
        size = None
        if "wavelength" in self.wanted.measures:
            size = self.wanted.measures["wavelength"] / ratio
            for m in measured:  # grown as if a wavelength were so many nodes; hence in the unit of the target:
                m["wavelength"] *= size
        low, high = self.low, self.high
        supporting = float(1 / (weights**2).sum())
        if supporting < 15:
            notes.append(f"the uncertainty rests on some {supporting:.0f} runs: take more runs")
        interval = {}
        for i, name in enumerate(self.names):
            ends = low[i] + (high[i] - low[i]) * _quantiles(places[:, i], weights, (0.05, 0.95))
            interval[name] = (float(ends[0]), float(ends[1]))
        middle = sorted(measured, key=lambda m: float(m["level"]))[len(measured) // 2]
        return Match(self.model, self.values_at(best), size, inverted, self._reached(measured), dict(self.bounds),
                     interval, self._combinations(weights, places), supporting, self.done, self.skipped,
                     self.failed, notes, middle["species"], middle["level"], 0.08 * middle["range"], self.wanted.colors,
                     [{**self.values_at(t.at), "distance": t.distance, "invert": t.inverted, **t.measures}
                      for t in self.trials])

    def _best(self, places: Sequence[Numbers], seeds: int) -> tuple[Numbers, bool, float]:
        """Of these places the one whose mean over the seeds is nearest, and its wavelength over size."""
        found = self._grown([(at, _RESOLUTION) for at in places for _ in range(seeds)])
        options = []
        for i, at in enumerate(places):
            measured = [m for m in found[i * seeds:(i + 1) * seeds] if m is not None]
            for inverted in self.inversions if measured else ():
                mean = _mean([_inverted(m, inverted) for m in measured])
                lost = seeds - len(measured)
                options.append((self._distance(mean) + lost + _PREFERENCE * inverted, inverted, i,
                                float(mean["wavelength"])))
        if not options:
            raise NumericsError("what was found does not grow again with other seeds")
        _, inverted, i, ratio = min(options)
        return places[i], inverted, ratio

    def _reached(self, measured: Sequence[dict[str, Any]]) -> dict[str, Reached]:
        mean, count = _mean(measured), len(measured)
        across = self.nodes / _RESOLUTION
        picture = 0 if self.wanted.across is None else (across / self.wanted.across)**2
        rows = {}
        for name, wanted in self.wanted.measures.items():
            deviation = 0.0
            if name not in ("kind", "orientation") and count > 1:
                deviation = float(np.std([m[name] for m in measured], ddof=1))
            if name == "orientation" and count > 1:
                turns = [self.wanted.miss(name, m[name]) * self.wanted.tolerances[name] for m in measured]
                deviation = float(np.std(turns, ddof=1))
            rows[name] = Reached(wanted, mean[name], deviation * math.sqrt(1 / count + picture),
                                 self.wanted.tolerances[name], self.wanted.miss(name, mean[name]))
        return rows

    def _combinations(self, weights: Numbers, places: Numbers) -> list[tuple[dict[str, float], float]]:
        values, vectors = np.linalg.eigh(_covariance(weights, places))
        uniform = math.sqrt(1 / 12)
        return [({name: float(v) for name, v in zip(self.names, vector)}, math.sqrt(max(value, 0)) / uniform)
                for value, vector in zip(values, vectors.T)]


def _covariance(weights: Numbers, places: Numbers) -> Numbers:
    d = places - weights @ places
    return np.asarray((d.T * weights) @ d)


def _checked(bounds: Mapping[str, tuple[float, float]], analysis: Analysis) -> dict[str, tuple[float, float]]:
    for name, (low, high) in bounds.items():
        if name not in analysis.parameters:
            raise UsageError(f"{analysis.title} has no parameter {name!r}; it has {', '.join(analysis.parameters)}")
        if not low < high:
            raise UsageError(f"bounds of {name} are {low} to {high}; the first is to be the lower one")
    return {name: (float(low), float(high)) for name, (low, high) in bounds.items()}


def _variants_of(model: Union[str, Model]) -> list[str]:
    if isinstance(model, Model):
        return []
    base = model.split(":")[0]  # figures of papers are literal in their lengths, and no kinds of their own
    return [name for name in _core.model_names() if name.startswith(base + ":") and "bajaj" not in name]


def _acts(model: Union[str, Model], name: str, values: tuple[float, float]) -> bool:
    """Whether a parameter is more than one of the start: whether a step from the same fields is another."""
    after = []
    for value in values:
        try:
            run = Run("builtin:tile?n=8", model=model, unit="1px", parameters={name: value}, step=1e-3, steps=2)
            for i, species in enumerate(run.species):
                run.set(species, 0.4 + 0.3 * np.cos(np.arange(64) + i))
            after.append([run.advance(1).get(species).tolist() for species in run.species])
        except Error:
            return True
    return after[0] != after[1]


def _inverted(measured: Mapping[str, Any], invert: bool) -> dict[str, Any]:
    """As if what is low were the pattern."""
    if not invert:
        return dict(measured)
    return {**measured, "coverage": 1 - measured["coverage"], "euler": -measured["euler"],
            "kind": kind_of(-measured["euler"], measured["coherence"])}


def _mean(measured: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    names = ("wavelength", "bandwidth", "coverage", "euler", "coherence", "order")
    mean: dict[str, Any] = {name: float(np.mean([m[name] for m in measured])) for name in names}
    double = np.exp(2j * np.radians([m["orientation"] for m in measured]))
    mean["orientation"] = math.degrees(np.angle((double * [m["order"] for m in measured]).sum()) / 2) % 180
    mean["kind"] = kind_of(mean["euler"], mean["coherence"])
    return mean


def _quantiles(values: Numbers, weights: Numbers, wanted: Sequence[float]) -> Numbers:
    order = np.argsort(values)
    return np.asarray(np.interp(wanted, np.cumsum(weights[order]) - weights[order] / 2, values[order]))

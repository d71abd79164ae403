"""Sweeps over parameters: many runs, and their measures as a table."""

from __future__ import annotations

import csv
import importlib
import itertools
import os
import threading
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, Optional, Union

import numpy as np
from numpy.typing import NDArray

from .errors import Cancelled, Error, UsageError
from .growing import Coat, grow
from .recipes import Changes, RecipeLike
from .shapes import ShapeLike, as_shape

#: Takes a finished coat and returns its numbers (or texts) by name.
Measure = Callable[[Coat], Mapping[str, Any]]
#: Called after every run with how many are done and how many there are; returning False stops the sweep.
SweepProgress = Callable[[int, int], Optional[bool]]

#: Points up to which one run hardly uses more than one core (measured: docs/python-match.md).
_SMALL = 20_000


class Table(Sequence[Mapping[str, Any]]):
    """Rows with the same names; `table["wavelength"]` is a column as an array, `table[3]` a row.

    What a row lacks is nan in columns of numbers, "" in columns of texts.
    """

    def __init__(self, rows: Iterable[Mapping[str, Any]]):
        self.rows: list[dict[str, Any]] = [dict(row) for row in rows]
        self.names: list[str] = list(dict.fromkeys(name for row in self.rows for name in row))

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[Mapping[str, Any]]:
        return iter(self.rows)

    def __getitem__(self, key: Any) -> Any:
        return self.column(key) if isinstance(key, str) else self.rows[key]

    def column(self, name: str) -> NDArray[Any]:
        if name not in self.names:
            raise UsageError(f"no column {name!r}; there are {', '.join(self.names)}")
        values = [row.get(name) for row in self.rows]
        if any(isinstance(value, str) for value in values):
            return np.array(["" if value is None else value for value in values])
        return np.array([np.nan if value is None else value for value in values])

    @property
    def failed(self) -> list[dict[str, Any]]:
        """Rows of runs that failed; their "error" says why."""
        return [row for row in self.rows if row.get("error")]

    def to_pandas(self) -> Any:
        """As a DataFrame; needs pandas."""
        return importlib.import_module("pandas").DataFrame({name: self.column(name) for name in self.names})

    def save_csv(self, path: str | os.PathLike[str]) -> None:
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, self.names, restval="", lineterminator="\n")
            writer.writeheader()
            writer.writerows(self.rows)

    def __repr__(self) -> str:
        failed = f", {len(self.failed)} failed" if self.failed else ""
        return f"<pelage.Table: {len(self)} rows of {', '.join(self.names)}{failed}>"


def sweep(shape: ShapeLike, recipe: RecipeLike | None = None, *,
          over: Mapping[str, Iterable[Any]] | Iterable[Mapping[str, Any]], measure: Measure | None = None,
          threads: int | None = None, progress: SweepProgress | None = None, **changes: Any) -> Table:
    """Grows a coat for every combination of values and measures it: a row each, in the order of the combinations, the
    last name changing fastest.

    over:      {"F": [0.03, 0.04], "seed": range(100)}, or rows [{"F": 0.03, "seed": 1}, ...]; names are those of
               changes (seed, size, quality, ...) or else of parameters of the model ("STAGE.PARAM")
    measure:   takes a coat and returns numbers by name; default: those of Coat.measure() that are single numbers, and
               "above.share", "spectrum.peak", ...
    threads:   so many runs at a time; default: on shapes of up to 20,000 points one for each core, on others, whose
               runs use all cores by themselves, one
    changes:   hold for all runs, see Changes

    A run that fails (NumericsError, UsageError for values a model refuses, ...) is a row with "error"; one without a
    pattern has "uniform" = True and no measures. Ctrl-C ends all runs and then the sweep.
    """
    points = _points(over)
    shape = as_shape(shape)
    stop = threading.Event()

    def run(point: Mapping[str, Any]) -> dict[str, Any]:
        row = {**point, "uniform": False, "error": ""}
        try:
            coat = grow(shape, recipe, progress=lambda *_: not stop.is_set(), **_with(changes, point))
            if coat.uniform:
                return {**row, "uniform": True}
            return {**row, **(measure or _numbers_of)(coat)}
        except Cancelled:
            raise
        except Error as fault:
            return {**row, "error": str(fault)}

    return Table(run_all(run, points, threads or (1 if len(shape.points) > _SMALL else cores()), stop, progress))


def cores() -> int:
    return os.cpu_count() or 1


def run_all(run: Callable[[Any], Any], points: Sequence[Any], threads: int, stop: threading.Event,
            progress: SweepProgress | None = None) -> list[Any]:
    """run(point) for all of them, results in their order. `stop` is set when one throws, or on Ctrl-C: what runs then
    is to end soon, and what waits does not begin."""
    if threads < 1:
        raise UsageError(f"threads is {threads}; at least one run at a time")
    with ThreadPoolExecutor(threads) as pool:
        tasks = [pool.submit(run, point) for point in points]
        try:
            results = []
            for task in tasks:
                results.append(task.result())
                if progress is not None and progress(len(results), len(tasks)) is False:
                    raise Cancelled("the progress function has returned False")
            return results
        except BaseException:
            stop.set()
            pool.shutdown(wait=True, cancel_futures=True)
            raise


def _points(over: Mapping[str, Iterable[Any]] | Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    if isinstance(over, Mapping):
        values = [list(column) for column in over.values()]
        return [dict(zip(over, row)) for row in itertools.product(*values)]
    return [dict(row) for row in over]


def _with(changes: Mapping[str, Any], point: Mapping[str, Any]) -> dict[str, Any]:
    """What is no change is a parameter of the model."""
    known = {name: _plain(value) for name, value in point.items() if name in Changes.__annotations__}
    parameters = {name: _plain(value) for name, value in point.items() if name not in known}
    return {**changes, **known, "parameters": {**changes.get("parameters", {}), **parameters}}


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else value


def _numbers_of(coat: Coat) -> dict[str, float]:
    measures = coat.measure()
    flat: dict[str, float] = {}
    for name, value in measures.items():
        inner = value.items() if isinstance(value, Mapping) else [("", value)]
        flat.update({f"{name}.{key}" if key else name: number for key, number in inner
                     if isinstance(number, (int, float))})
    return flat

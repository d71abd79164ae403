"""Sweeps: every row is the run that it names, whatever becomes of the others."""

import csv
import os
import signal

import numpy as np
import pytest

import pelage

TILE = "builtin:tile?n=32"
SPOTS = {"model": "gray-scott", "size": "8px", "until": 1500}


def test_rows_are_the_runs_in_order_whatever_the_threads():
    over = {"F": [0.037, 0.05], "seed": range(3)}
    alone = pelage.sweep(TILE, over=over, threads=1, **SPOTS)
    together = pelage.sweep(TILE, over=over, threads=3, **SPOTS)
    assert alone.rows == together.rows
    assert [(row["F"], row["seed"]) for row in alone] == [(f, s) for f in (0.037, 0.05) for s in range(3)]
    coat = pelage.grow(TILE, seed=2, parameters={"F": 0.037}, **SPOTS)
    measured = coat.measure()
    assert alone[2]["wavelength"] == measured["wavelength"] and alone[2]["above.share"] == measured["above"]["share"]
    assert alone["seed"].tolist() == [0, 1, 2] * 2


def test_rows_may_be_given_and_parameters_stay():
    table = pelage.sweep(TILE, over=[{"k": 0.06, "size": "8px"}, {"size": "12px"}], model="gray-scott", until=1500,
                         parameters={"F": 0.04}, measure=lambda coat: {"top": coat.fields["v"].max()})
    tops = [pelage.grow(TILE, model="gray-scott", until=1500, size=size, parameters=p).fields["v"].max()
            for size, p in (("8px", {"F": 0.04, "k": 0.06}), ("12px", {"F": 0.04}))]
    assert table["top"].tolist() == tops
    assert np.isnan(table["k"][1]) and table["size"].tolist() == ["8px", "12px"]


def blows_up(t, u):
    return [u * u * u]


def test_a_run_that_fails_is_a_row():
    table = pelage.sweep(TILE, over={"F": [0.05, 5]}, **SPOTS)
    assert [bool(row["error"]) for row in table] == [False, True]
    assert "must be from 0 to 0.12" in table.failed[0]["error"] and np.isnan(table["coherence"][1])
    runaway = pelage.Model.from_rates(blows_up, {"u": 1}, {"u": "1 + 0.1*noise(2)"}, spacing=10, end=100)
    table = pelage.sweep(TILE, runaway, size="8px", over={"seed": [1, 2]})
    assert len(table.failed) == 2


def test_what_has_no_pattern_says_so():
    table = pelage.sweep(TILE, model="schnakenberg", unit="0.6px", over={"a": [0.1, 0.9]})
    assert table["uniform"].tolist() == [False, True] and not table.failed
    assert np.isnan(table["coherence"][1]) and table["coherence"][0] > 0


def test_csv_and_pandas(tmp_path):
    table = pelage.sweep(TILE, over={"F": [0.05, 5]}, measure=lambda coat: {"one": 1.5}, **SPOTS)
    table.save_csv(tmp_path / "t.csv")
    with open(tmp_path / "t.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["one"] for row in rows] == ["1.5", ""] and rows[1]["error"] == table[1]["error"]
    pandas = pytest.importorskip("pandas")
    frame = table.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and frame["F"].tolist() == [0.05, 5]


def test_unknown_columns_and_no_threads():
    table = pelage.Table([{"a": 1}, {"b": "x"}])
    with pytest.raises(pelage.UsageError, match="no column 'c'; there are a, b"):
        table["c"]
    with pytest.raises(pelage.UsageError, match="at least one"):
        pelage.sweep(TILE, over={"seed": [1]}, threads=-1, **SPOTS)


@pytest.mark.parametrize("threads", [1, 2])
def test_ctrl_c_ends_all_runs(threads):
    measured = []

    def interrupt(done, count):
        assert count == 40
        os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        pelage.sweep(TILE, over={"seed": range(40)}, threads=threads, progress=interrupt,
                     measure=lambda coat: measured.append(1) or {}, **SPOTS)
    assert len(measured) < 20


def test_ctrl_c_ends_the_run_that_grows():
    measured = []
    with pytest.raises(KeyboardInterrupt):
        pelage.sweep(TILE, model="barkley", size="16px", over={"until": [0.1, 400.0]}, threads=2,
                     progress=lambda done, count: os.kill(os.getpid(), signal.SIGINT),
                     measure=lambda coat: measured.append(coat.summary["time"]) or {})
    assert len(measured) == 1 and measured[0] < 1


def test_progress_can_stop_it_and_faults_of_measures_come_through():
    with pytest.raises(pelage.Cancelled):
        pelage.sweep(TILE, over={"seed": range(4)}, progress=lambda done, count: done < 2, **SPOTS)
    with pytest.raises(ZeroDivisionError):
        pelage.sweep(TILE, over={"seed": range(4)}, measure=lambda coat: {"x": 1 / 0}, **SPOTS)

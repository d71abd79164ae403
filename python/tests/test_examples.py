"""The examples run, and what they say is so; their notebooks are the same code."""

import json
import pathlib
import runpy
import sys

import numpy as np
import pytest


PYTHON = pathlib.Path(__file__).resolve().parents[1]
NOTEBOOKS = PYTHON.parent / "tools" / "notebooks.py"


@pytest.fixture
def example(monkeypatch, tmp_path):
    """Runs a script with these settings and returns what it has found, by the names of its variables."""

    def run(name, **settings):
        for key, value in settings.items():
            monkeypatch.setenv(key, str(value))
        monkeypatch.setattr(sys, "argv", [name, str(tmp_path)])
        return {**runpy.run_path(str(PYTHON / "examples" / f"{name}.py")), "folder": tmp_path}

    return run


def test_spot_statistics(example):
    table = example("spot_statistics", SEEDS=4)["table"]
    assert (table["turn"] == 12).all() and len(table) == 4
    assert 40 < table["spots"].mean() < 56 and 0 < table["spots"].std() < 5


def test_turing_space(example):
    found = example("turing_space", CELLS=6)
    assert np.array_equal(found["theory"], found["textbook"]) and 5 < found["theory"].sum() < 20
    assert all(place["waves"] == place["grew"] for place in found["places"])
    assert 0 < sum(place["grew"] for place in found["places"]) < len(found["places"])


def test_stripes_to_spots(example):
    found = example("stripes_to_spots", ROWS=80, QUALITY="draft")
    assert found["left"]["kind"] == "stripes" and found["left"]["coherence"] > 0.6
    assert found["right"]["kind"] == "spots" and found["right"]["coverage"] < found["left"]["coverage"] - 0.1
    assert (found["folder"] / "stripes-to-spots.png").exists() and (found["folder"] / "stripes-to-spots.glb").exists()


def test_growing_domain(example):
    found = example("growing_domain", NODES=101, UNTIL=150)
    halves = found["peaks"]
    assert sorted(set(halves)) == [1, 2, 4] and halves == sorted(halves), halves
    assert found["counts"][1] > 1.4 * found["counts"][0]


def test_own_wave(example):
    found = example("own_wave", NODES=48, UNTIL=40)
    assert found["difference"] < 1e-6 and found["change"] > 0.1


def test_scan_to_print(example):
    found = example("scan_to_print", QUALITY="draft")
    assert found["rough"][1] < found["rough"][0] / 3
    for name in ("part.stl", "part.3mf"):
        assert (found["folder"] / name).stat().st_size > 100_000
    assert len(found["part"].triangles) == len(found["coat"].triangles)


def test_notebooks(tmp_path):
    tool = runpy.run_path(str(NOTEBOOKS))
    scripts = sorted((PYTHON / "examples").glob("*.py"))
    tool["main"](str(tmp_path), *map(str, scripts))
    for script in scripts:
        notebook = json.loads((tmp_path / f"{script.stem}.ipynb").read_text(encoding="utf-8"))
        assert notebook["nbformat"] == 4 and notebook["cells"][0]["source"][0].startswith("# ")
        code = "\n".join("".join(c["source"]) for c in notebook["cells"] if c["cell_type"] == "code")
        assert compile(code, script.name, "exec")
        lines = [line for line in script.read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]
        assert [line for line in code.splitlines() if line] == lines
    with pytest.raises(ValueError, match="before the first cell"):
        tool["cells_of"]("import os\n# %%\n")

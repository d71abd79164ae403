"""Measures of pictures against patterns that are known, and matches against pictures of other models."""

import math

import numpy as np
import pytest

import pelage


def picture_of(coat):
    columns, rows = coat.shape.grid["count"][:2]
    return list(coat.fields.values())[-1].reshape(rows, columns)[::-1]


def lattice(distance, radius, rows=4, columns=8):
    """Discs in a triangular lattice, on a tile that repeats: (picture, wavelength)."""
    height, width = round(rows * distance * math.sqrt(3)), columns * distance
    y, x = np.mgrid[0:height, 0:width]
    nearest = np.full(x.shape, np.inf)
    for j in range(2 * rows):
        for i in range(columns):
            dx = np.abs(x - (i + j % 2 / 2) * distance) % width
            dy = np.abs(y - j * height / (2 * rows)) % height
            nearest = np.minimum(nearest, np.hypot(np.minimum(dx, width - dx), np.minimum(dy, height - dy)))
    return np.clip(radius - nearest + 0.5, 0, 1), distance * math.sqrt(3) / 2


@pytest.mark.parametrize("periodic, within", [(True, 0.002), (False, 0.01)])
def test_stripes(periodic, within):
    y, x = np.mgrid[0:96, 0:128]
    m = pelage.measure_picture(np.cos(2 * np.pi * (8 * x / 128 + 6 * (95 - y) / 96)), pixel=0.5, periodic=periodic)
    assert m["wavelength"] == pytest.approx(0.5 / math.hypot(8 / 128, 6 / 96), rel=within)
    assert m["orientation"] == pytest.approx(135, abs=0.1) and m["order"] > 0.99 and m["coherence"] > 0.99
    assert m["kind"] == "stripes" and abs(m["euler"]) < 0.03 and m["coverage"] == pytest.approx(0.5, abs=0.03)


def test_spots_and_holes():
    picture, wavelength = lattice(24, 7)
    m = pelage.measure_picture(picture, periodic=True)
    assert m["wavelength"] == pytest.approx(wavelength, rel=0.02)
    assert m["coverage"] == pytest.approx(math.pi * 7**2 / (24**2 * math.sqrt(3) / 2), abs=0.02)
    assert m["euler"] == pytest.approx(math.sqrt(3) / 2, rel=0.04) and m["coherence"] < 0.15 and m["kind"] == "spots"
    holes = pelage.measure_picture(1 - picture, periodic=True)
    assert holes["kind"] == "holes" and holes["euler"] == pytest.approx(-m["euler"])
    assert holes["coverage"] == pytest.approx(1 - m["coverage"], abs=0.01)


def test_colours_resolution_and_grain_do_not_matter():
    coarse, fine = lattice(16, 5)[0], lattice(32, 10)[0]
    paint = np.array([0.8, 0.1, 0.1]) * fine[..., None] + np.array([0.1, 0.35, 0.1]) * (1 - fine[..., None])
    grain = np.random.default_rng(1).normal(0, 0.05, fine.shape)
    a = pelage.measure_picture(coarse, pixel=2, periodic=True)
    for other in (fine, paint, fine + grain):
        b = pelage.measure_picture(other, periodic=True)
        assert b["wavelength"] == pytest.approx(a["wavelength"], rel=0.02) and b["kind"] == "spots"
        assert b["coverage"] == pytest.approx(a["coverage"], abs=0.02)
        assert b["euler"] == pytest.approx(a["euler"], rel=0.05)


def test_definitions_are_those_of_the_library():
    coat = pelage.tile(model="schnakenberg:stripes", nodes=120, size="12px", seed=4)
    ours, measured = pelage.measure_picture(picture_of(coat), pixel=1 / 120), coat.measure()
    assert ours["wavelength"] == pytest.approx(2 * math.pi / measured["spectrum"]["peak"], rel=0.04)
    assert ours["coverage"] == pytest.approx(measured["above"]["share"], abs=0.01)
    assert ours["coherence"] == pytest.approx(measured["coherence"], abs=0.05)


@pytest.mark.parametrize("maker, model, seed", [("swift-hohenberg:hexagons", "gray-scott", 71),
                                                ("brusselator:stripes", "gray-scott", 72)])
def test_match_recovers_size_coverage_and_kind(maker, model, seed):
    target = picture_of(pelage.tile(model=maker, nodes=84, size="12px", seed=seed))
    found = pelage.match(target, model, pixel=0.5, runs=40, seeds=2)
    wanted = pelage.measure_picture(target, pixel=0.5)
    again = [picture_of(found.tile(84, size=f"{found.size / 0.5!r}px", seed=s)) for s in (901, 902, 903)]
    measured = [pelage.measure_picture(-u if found.invert else u, pixel=0.5) for u in again]
    assert np.mean([m["wavelength"] for m in measured]) == pytest.approx(wanted["wavelength"], rel=0.05)
    assert np.mean([m["coverage"] for m in measured]) == pytest.approx(wanted["coverage"], abs=0.05)
    assert [m["kind"] for m in measured].count(wanted["kind"]) >= 2
    assert not {"wavelength", "coverage", "kind"} & set(found.missed), found.summary()
    assert set(found.parameters) == {"F", "k"} and found.runs == 40 + 6 * 2


def test_the_same_arguments_give_the_same_match_whatever_the_threads():
    wanted = {"wavelength": 3, "coverage": 0.3, "kind": "spots"}
    a, b = (pelage.match(wanted, "gray-scott", {"F": (0.03, 0.05), "k": (0.06, 0.066)}, runs=10, seeds=1, threads=n)
            for n in (1, 2))
    assert a == b and a.summary() == b.summary()


def test_orientation_and_what_is_determined():
    wanted = {"orientation": 35, "kind": "stripes"}
    found = pelage.match(wanted, "witkin-kass-stripes", {"theta": (-1.5, 1.5), "k": (0.9, 1.1)}, runs=120, seeds=2)
    assert found.reached and math.degrees(found.parameters["theta"]) == pytest.approx(35, abs=8)
    low, high = found.uncertainty["theta"]
    assert math.degrees(low) < 35 < math.degrees(high) and high - low < 0.8
    (best, sharp), (worst, loose) = found.combinations
    assert abs(best["theta"]) > 0.9 and sharp < 0.35 and abs(worst["k"]) > 0.9 and loose > 0.7
    assert found.supporting > 20
    assert found.size is None


def test_what_cannot_be_reached_is_said():
    found = pelage.match({"wavelength": 1, "coverage": 0.85, "kind": "stripes"}, "klausmeier", invert=False, runs=10,
                         seeds=1)
    assert not found.reached and "coverage" in found.missed
    assert found.summary().startswith("klausmeier: not reached: ") and "tolerances off" in found.summary()


def test_light_holes_are_dark_spots():
    wanted = {"coverage": 0.75, "kind": "holes"}
    found = pelage.match(wanted, "gray-scott", {"k": (0.0645, 0.0652), "F": (0.036, 0.037)}, runs=10, seeds=1)
    assert found.invert and found.measures["coverage"].reached == pytest.approx(0.78, abs=0.04)
    u = found.tile(64, size="8px", seed=9)
    shown = pelage.measure_picture(u.colors.mean(1).reshape(64, 64), periodic=True)
    assert shown["kind"] == "holes" and shown["coverage"] == pytest.approx(0.78, abs=0.06)


def test_places_where_nothing_grows_are_skipped():
    found = pelage.match({"coverage": 0.3}, "schnakenberg", {"b": (0.9, 2.5)}, runs=10, seeds=1)
    assert found.skipped > 0
    with pytest.raises(pelage.NumericsError, match="no pattern anywhere"):
        pelage.match({"coverage": 0.3}, "schnakenberg", {"b": (3.5, 4.0)}, runs=12)


def test_the_recipe_is_the_match():
    text = 'name = "mine"\ntitle = "Mine"\n' + "".join(
        f'[species.{s}]\ndiffusion = {d}\nrate = "{rate}"\ninitial = "{start}"\n'
        for s, d, rate, start in (("v", 40, "b - u^2*v", "0.9"), ("u", 1, "0.1 - u + u^2*v", "1 + 0.01*noise(4)")))
    model = pelage.Model(text + '[parameters]\nb = { value = 0.9, min = 0, max = 4, unit = "1", help = "supply" }\n'
                         "[suggested]\nstep = 0.1\nend = 150\n", "mine")
    red, blue = np.array([200, 30, 30], np.uint8), np.array([20, 20, 120], np.uint8)
    picture = np.where(lattice(16, 5)[0][..., None] > 0.5, red, blue)
    found = pelage.match(picture, model, {"b": (0.8, 1.2)}, runs=10, seeds=1)
    assert 'color = "#c81e1e"' in found.recipe() and 'color = "#141478"' in found.recipe()
    by_hand = pelage.tile(model=model, parameters=found.parameters, nodes=48, size="12px", seed=3)
    assert np.array_equal(found.tile(48, size="12px", seed=3).fields["u"], by_hand.fields["u"])
    colors = found.tile(96, size="12px", seed=4).colors
    is_red = colors[:, 0] > colors[:, 2]
    assert is_red.mean() == pytest.approx(found.measures["coverage"].reached, abs=0.05)
    assert not found.grow("builtin:sphere?n=642", size="0.6u", seed=1).uniform


def test_a_coat_on_a_surface_is_a_target():
    coat = pelage.grow("builtin:sphere?n=2562", model="schnakenberg", size="0.5u", seed=5)
    found = pelage.match(coat, "schnakenberg", runs=10, seeds=2)
    assert found.size == pytest.approx(0.5, rel=0.08)
    assert found.measures["coverage"].met and found.measures["kind"].wanted == "spots"


def test_faults():
    with pytest.raises(pelage.UsageError, match="no measure 'roundness'"):
        pelage.match({"roundness": 1}, "turing")
    with pytest.raises(pelage.UsageError, match="no parameter 'zeta'"):
        pelage.match({"coverage": 0.3}, "turing", {"zeta": (0, 1)})
    with pytest.raises(pelage.UsageError, match="the first is to be the lower"):
        pelage.match({"coverage": 0.3}, "turing", {"Da": (0.2, 0.1)})
    with pytest.raises(pelage.UsageError, match="wavelength alone"):
        pelage.match({"wavelength": 0.3}, "turing")
    with pytest.raises(pelage.UsageError, match="uniform"):
        pelage.match(np.ones((32, 32)), "turing")
    with pytest.raises(pelage.UsageError, match="at least 8 x 8"):
        pelage.match(np.ones((4, 4, 4, 4)), "turing")
    with pytest.raises(pelage.Cancelled):
        pelage.match({"coverage": 0.3}, "turing", progress=lambda done, of: False)

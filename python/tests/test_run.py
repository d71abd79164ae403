"""Runs step by step: fields in and out, checkpoints, stages, coats of a moment."""

import numpy as np
import pytest

import pelage


def test_slices_do_not_matter(sphere):
    whole, slices = (pelage.Run(sphere, size=0.3) for _ in range(2))
    whole.advance(100)
    slices.advance(40).advance(60)
    assert np.array_equal(whole.get("b"), slices.get("b"))
    assert whole.step_report == slices.step_report


def test_checkpoint(sphere):
    run = pelage.Run(sphere, size=0.3)
    saved = run.advance(30).checkpoint()
    run.advance(30)
    other = pelage.Run(sphere, size=0.3).restore(saved).advance(30)
    assert np.array_equal(run.get("a"), other.get("a"))
    with pytest.raises(pelage.InputError):
        pelage.Run(sphere, size=0.4).restore(saved)


@pytest.mark.parametrize("method", ["remeshed", "loop", "linear"])
def test_values_are_those_that_were_set(sphere, method):
    run = pelage.Run(sphere, size=0.4, method=method)
    points, triangles = run.nodes()
    wanted = 4 + 0.1 * points[:, 2]
    run.set("b", wanted)
    assert np.allclose(run.get("b"), wanted, rtol=0, atol=1e-9)
    assert triangles.max() < len(points) == len(run.get("b"))
    run.set("b", 4)
    assert np.allclose(run.get("b"), 4, rtol=0, atol=1e-9)


def test_what_was_set_grows(sphere):
    """A single wave of the linear theory grows at its rate."""
    analysis = pelage.analyse("turing:production", {"unevenness": 0.0})
    run = pelage.Run(sphere, model="turing:production", size=0.4, parameters={"unevenness": 0.0}, step=0.5, until=20)
    points, _ = run.nodes()
    state = dict(zip(analysis.species, analysis.steady_states[analysis.chosen]))
    for species, value in state.items():
        run.set(species, value + 1e-4 * points[:, 2] * (1 if species == "b" else 0))
    run.advance(1)
    assert np.ptp(run.get("b")) == pytest.approx(2e-4, rel=0.2)


def test_wrong_values(sphere):
    run = pelage.Run(sphere, size=0.4)
    with pytest.raises(pelage.UsageError, match="unknown species"):
        run.get("c")
    with pytest.raises(ValueError):
        run.set("b", [1, 2, 3])
    with pytest.raises(pelage.UsageError, match="finite"):
        run.set("b", np.nan)


def test_a_coat_of_the_past_says_so(sphere, tmp_path):
    run = pelage.Run(sphere, size=0.3).advance(5)
    coat = run.coat()
    points = coat.points.copy()
    run.advance(5)
    coat.save(tmp_path / "coat.ply")
    assert np.array_equal(points, coat.points)
    with pytest.raises(pelage.UsageError, match="gone on"):
        coat.images(32)


def test_blow_up_is_an_error(sphere):
    with pytest.raises(pelage.NumericsError, match="step"):
        pelage.grow(sphere, size=0.3, stepper="explicit", step=500.0, until=1e6)


def test_uniform_coats_say_so(sphere):
    coat = pelage.grow(sphere, size=0.3, parameters={"unevenness": 0.0}, until=10)
    assert coat.uniform and coat.why_uniform


STAGES = """
[[stage]]
name = "large"
model = "turing"
size = 0.4
steps = 20

[[stage]]
name = "small"
model = "turing"
size = 0.3
steps = 20
"""


def test_stages(sphere):
    run = pelage.Run(sphere, STAGES)
    first = run.stage
    coat = run.finish().coat()
    assert first == (0, 2, "large") and run.stage == (1, 2, "small")
    assert list(coat.fields) == ["large.a", "large.b", "a", "b"]


def test_volumes_and_grids():
    block = pelage.grow("builtin:box?n=12x12x12", model="turing", size="6px", steps=30)
    assert block.measure()["area"] > 0
    line = pelage.Run("builtin:line?n=40", model="turing", size="10px").advance(10)
    assert line.nodes()[0].shape == (40, 3)
    with pytest.raises(pelage.UsageError, match="sheet"):
        block.image()


def test_unknown_names(sphere, tmp_path):
    with pytest.raises(TypeError, match="unknown argument 'sise'"):
        pelage.grow(sphere, sise=0.3)
    with pytest.raises(pelage.UsageError, match='did you mean "turing"'):
        pelage.grow(sphere, model="turign")
    with pytest.raises(pelage.UsageError, match="no shape to grow on"):
        pelage.grow(None, model="turing")
    recipe = tmp_path / "own.toml"
    recipe.write_text("[[stage]]\nmodel = 'turing'\nsise = 0.3\n")
    with pytest.raises(pelage.UsageError) as caught:
        pelage.grow(sphere, recipe)
    assert caught.value.line == 3 and caught.value.file == str(recipe) and caught.value.kind == "usage"
    with pytest.raises(pelage.InputError):
        pelage.load(tmp_path / "none.obj")
    with pytest.raises(pelage.OutputError):
        pelage.load("builtin:sphere?n=162").save(tmp_path / "no" / "folder.ply")
    with pytest.raises(pelage.UsageError, match="of the formats only GLB"):
        pelage.grow(sphere, size=0.4, steps=1).save(tmp_path / "coat.ply", bake=64)


def test_recipe_as_text(sphere):
    text = '[[stage]]\nmodel = "turing"\nsize = 0.3\nsteps = 5\n'
    coat, same = pelage.grow(sphere, text), pelage.grow(sphere, model="turing", size=0.3, steps=5)
    assert np.array_equal(coat.fields["b"], same.fields["b"])


def test_pictures(sphere, tmp_path):
    coat = pelage.grow(sphere, size=0.3, until=300)
    picture = coat.render(64, 48, samples=4)
    assert picture.shape == (48, 64, 3) and picture.dtype == np.float32 and np.ptp(picture) > 0.3
    pelage.save_png(picture, tmp_path / "coat.png")
    data = (tmp_path / "coat.png").read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n" and data[16:24] == bytes([0, 0, 0, 64, 0, 0, 0, 48])
    assert pelage.tile("weave", nodes=32, size="16px", steps=3)._repr_png_()[:8] == data[:8]


def test_strokes_are_followed(sphere):
    """Directions of an anisotropic model run along a stroke around the equator."""
    angle = np.linspace(0, 2 * np.pi, 200)
    equator = np.c_[np.cos(angle), np.sin(angle), 0 * angle]
    field = pelage.direction_field(sphere, strokes=[equator])
    near = np.abs(sphere[0][:, 2]) < 0.05
    east = np.c_[-sphere[0][:, 1], sphere[0][:, 0], 0 * sphere[0][:, 0]]
    along = np.abs(np.einsum("ij,ij->i", field.directions, east))[near]
    assert along.min() > 0.95

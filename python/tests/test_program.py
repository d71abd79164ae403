"""Every function against the command line: the same inputs give the same bytes."""

import json

import numpy as np
import pytest

import pelage


def same_bytes(folder, extension):
    """Of what the program, told to leave out how it was made, and the package have written."""
    return (folder / f"program{extension}").read_bytes() == (folder / f"package{extension}").read_bytes()


GROWN = {
    "recipe": (["builtin:animal?n=800", "--recipe", "leopard", "--quality", "draft", "--size", "0.15"],
               dict(shape="builtin:animal?n=800", recipe="leopard", quality="draft", size=0.15)),
    "model": (["builtin:torus?n=600", "--model", "gray-scott:spots", "--size", "0.15", "--seed", "7", "--steps", "40",
               "--set", "F=0.03", "--method", "linear"],
              dict(shape="builtin:torus?n=600", model="gray-scott:spots", size=0.15, seed=7, steps=40,
                   parameters={"F": 0.03}, method="linear")),
    "map": (["builtin:sphere?n=642", "--size", "0.2", "--param-map", "size=1+0.5*bx", "--ramp", "science", "--invert",
             "--material", "height=0.1*b", "--until", "300"],
            dict(shape="builtin:sphere?n=642", size=0.2, parameters={"size": "1+0.5*bx"}, ramp="science", invert=True,
                 materials={"height": "0.1*b"}, until=300)),
    "kept": (["builtin:sphere?n=642", "--size", "0.3", "--keep-shape", "--no-fields"],
             dict(shape="builtin:sphere?n=642", size=0.3, keep_shape=True, fields=False)),
    "fair": (["builtin:sphere?n=642", "--size", "0.3", "--fair=taubin", "--until", "200"],
             dict(shape="builtin:sphere?n=642", size=0.3, fair="taubin", until=200)),
}


@pytest.mark.parametrize("name", GROWN)
def test_grow(name, program, tmp_path):
    arguments, given = GROWN[name]
    program("grow", *arguments, "-o", "program.ply", folder=tmp_path)
    coat = pelage.grow(**given)
    coat.save(tmp_path / "package.ply")
    assert same_bytes(tmp_path, ".ply")


def test_settings_of_stages(program, tmp_path):
    recipes = json.loads(program("recipes", "--json", folder=tmp_path))
    names = [stage["name"] for recipe in recipes if recipe["name"] == "leopard" for stage in recipe["stages"]]
    assert len(names) == 2
    arguments = [x for name in names for x in ("--set", f"{name}.size=0.3")]
    program("grow", "builtin:sphere?n=642", "--recipe", "leopard", *arguments, "--quality", "draft", "-o", "program.ply",
            "-q", folder=tmp_path)
    coat = pelage.grow("builtin:sphere?n=642", "leopard", quality="draft",
                       parameters={f"{name}.size": 0.3 for name in names})
    coat.save(tmp_path / "package.ply")
    assert same_bytes(tmp_path, ".ply")


def test_file_with_quads(program, tmp_path):
    """Polygons, attributes and corners of a file survive as in the program."""
    (tmp_path / "cube.obj").write_text(
        "\n".join(f"v {x} {y} {z}" for x, y, z in
                  [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]) +
        "\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
    program("grow", "cube.obj", "--size", "0.3", "--keep-shape", "-o", "program.ply", folder=tmp_path)
    pelage.grow(tmp_path / "cube.obj", size=0.3, keep_shape=True).save(tmp_path / "package.ply")
    assert b"element face 6" in (tmp_path / "program.ply").read_bytes()
    assert same_bytes(tmp_path, ".ply")


def test_bake(program, tmp_path):
    program("unwrap", "builtin:animal?n=800", "-o", "animal.obj", "-q", folder=tmp_path)
    program("grow", "animal.obj", "--size", "0.2", "--bake", "128", "-o", "program.glb", folder=tmp_path)
    coat = pelage.grow(tmp_path / "animal.obj", size=0.2)
    coat.save(tmp_path / "package.glb", bake=128)
    assert same_bytes(tmp_path, ".glb")
    images = coat.images(128)
    assert images["color"].shape == (128, 128, 3) and images["color"].dtype == np.uint8
    assert images["height"].shape == (128, 128)


def test_tile(program, tmp_path):
    program("grow", "builtin:tile?n=48x32", "--recipe", "weave", "--size", "16px", "-o", "program.png", folder=tmp_path)
    picture = pelage.tile("weave", nodes=(48, 32), size="16px").image()
    assert picture.shape == (32, 48, 3)
    pelage.save_png(picture, tmp_path / "package.png")
    assert same_bytes(tmp_path, ".png")


def test_measure(program, tmp_path):
    coat = pelage.grow("builtin:sphere?n=642", size=0.3)
    coat.save(tmp_path / "coat.vtp")
    said = json.loads(program("measure", "coat.vtp", "--field", "b", "--json", folder=tmp_path))
    measured = pelage.measure(tmp_path / "coat.vtp", "b")
    for name in ("area", "minimum", "maximum", "mean", "deviation", "level", "border", "wavelength", "spacing", "coherence"):
        assert measured[name] == pytest.approx(said[name], rel=1e-15), name
    assert measured["spots"]["count"] == said["spots"]["count"]
    assert measured["above"]["share"] == pytest.approx(said["above"]["share"], rel=1e-15)
    of_coat = coat.measure()  # of doubles, where the file has floats
    assert of_coat["wavelength"] == pytest.approx(measured["wavelength"], rel=1e-5)


def test_analyse(program, tmp_path):
    said = json.loads(program("analyse", "turing:production", "--set", "s=0.06", "--json", folder=tmp_path))
    found = pelage.analyse("turing:production", {"s": 0.06})
    flat = json.dumps(said)
    assert found.verdict in flat
    assert repr(found.wavelength) in flat and repr(found.growth) in flat
    assert found.dispersion(2 * np.pi / found.wavelength).real == pytest.approx(found.growth, rel=1e-9)


def test_fair(program, tmp_path):
    rng = np.random.default_rng(1)
    shape = pelage.load("builtin:sphere?n=642")
    noisy = pelage.Shape(shape.points + 0.01 * rng.standard_normal(shape.points.shape), shape.triangles)
    noisy.save(tmp_path / "noisy.ply")
    program("fair", "noisy.ply", "-o", "program.ply", folder=tmp_path)
    faired = pelage.fair(tmp_path / "noisy.ply")
    faired.shape.save(tmp_path / "package.ply")
    of_program, of_package = pelage.load(tmp_path / "program.ply"), pelage.load(tmp_path / "package.ply")
    assert np.array_equal(of_program.points, of_package.points)
    assert np.linalg.norm(faired.points, axis=1).std() < 0.6 * np.linalg.norm(noisy.points, axis=1).std()


def test_direction_field(program, tmp_path):
    program("field", "builtin:sphere?n=642", "--axis", "0,0,1", "-o", "program.vtp", folder=tmp_path)
    of_program = pelage.load(tmp_path / "program.vtp").attributes["direction"]
    field = pelage.direction_field("builtin:sphere?n=642", axis=(0, 0, 1))
    assert np.allclose(field.directions, of_program, atol=1e-7)  # the file has floats


def test_grid(program, tmp_path):
    region = program("grid", "--list", folder=tmp_path).splitlines()[1].split()[0]
    program("grid", region, "-o", "program.vts", folder=tmp_path)
    assert np.allclose(pelage.grid(f"builtin:{region}").points, pelage.load(tmp_path / "program.vts").points, atol=1e-6)


def test_names(program, tmp_path):
    recipes = json.loads(program("recipes", "--json", folder=tmp_path))
    assert [recipe["name"] for recipe in recipes] == pelage.recipe_names()

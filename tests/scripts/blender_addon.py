#!/usr/bin/env python3
"""Tests what of the Blender add-on needs no Blender, for blender_addon_test.sh. Usage: SOURCE PELAGE FOLDER"""
import ast
import json
import os
import subprocess
import sys
import time
import tomllib
import zipfile

SOURCE, PELAGE, FOLDER = sys.argv[1:]
sys.path.insert(0, os.path.join(SOURCE, "blender", "pelage_addon"))
import process  # noqa: E402
import recipe_text  # noqa: E402

TEMPORARY = os.environ["TMPDIR"]


def asked(*words):
    return subprocess.run([PELAGE, *words], check=True, capture_output=True, text=True).stdout


def zip_file():
    """Modules that Python can read, and a picture of every coat that the program has."""
    archive = zipfile.ZipFile(os.path.join(FOLDER, "one.zip"))
    names = set(archive.namelist())
    for name in names:
        assert name.startswith("pelage_addon/"), f"{name} is not in the add-on's folder"
        if name.endswith(".py"):
            ast.parse(archive.read(name), feature_version=(3, 10))  # the Python of Blender 3.4
    manifest = tomllib.loads(archive.read("pelage_addon/blender_manifest.toml").decode())
    told = ast.parse(archive.read("pelage_addon/__init__.py"))
    info = next(ast.literal_eval(n.value) for n in told.body if getattr(n, "targets", [None])[0] is not None
                and getattr(n.targets[0], "id", "") == "bl_info")
    assert manifest["version"] == ".".join(map(str, info["version"])), "two versions"
    for kind in ("recipes", "models"):
        for one in json.loads(asked(kind, "--json")):
            picture = f"pelage_addon/pictures/{kind}/{one['name'].replace(':', '-')}.png"
            assert picture in names, f"no {picture}: tools/gallery_page.py makes it"


def stages_of(document):
    stages = document["stage"]
    return stages if isinstance(stages, list) else [stages]


def edited(text):
    """With everything that a user can ask for; and the names of stages whose mask was joined."""
    text = recipe_text.with_size_map(text, "1 + attribute(tail)")
    text, joined = recipe_text.with_mask(text, "attribute(bald) > 0.5", "excluded")
    for k in range(len(recipe_text.stages(text))):
        text = recipe_text.with_strokes(text, k, [[(0, 0.5, -1), (1, 2, 3e-7)]])
    return text, joined


def recipes():
    """Every recipe, edited, is what Python's own parser of TOML says that it should be."""
    for one in json.loads(asked("recipes", "--json")):
        text = asked("recipes", one["name"])
        before = stages_of(tomllib.loads(text))
        changed, joined = edited(text)
        after = stages_of(tomllib.loads(changed))
        assert len(before) == len(after)
        for k, (a, b) in enumerate(zip(before, after)):
            factor = "1 + attribute(tail)"
            assert b["size-map"] == (f"({a['size-map']})*({factor})" if "size-map" in a else factor), one["name"]
            bald = "attribute(bald) > 0.5"
            assert b["mask"] == (f"({a['mask']}) or ({bald})" if "mask" in a else bald), one["name"]
            assert b.get("inside") == (a.get("inside") if "mask" in a else "excluded"), one["name"]
            assert (recipe_text.stage_names(text)[k] in joined) == ("mask" in a)
            assert b["directions"] == {"strokes": [[[0, 0.5, -1], [1, 2, 3e-7]]]}, one["name"]
            edits = ("size-map", "mask", "inside", "directions")
            assert {x: y for x, y in a.items() if x not in edits} == {x: y for x, y in b.items() if x not in edits}
            said = {x: y if isinstance(y, str) else float(y) for x, y in a.get("parameters", {}).items()}
            found = recipe_text.stage_group(text, k, "parameters")
            assert {x: y if isinstance(said[x], str) else float(y) for x, y in found.items()} == said, one["name"]
        assert recipe_text.size_of(text) == before[0].get("size"), one["name"]
        form = tomllib.loads(recipe_text.without_form(text))
        assert recipe_text.is_solid(text) == (tomllib.loads(text).get("solid", False))
        said = {x: y for x, y in tomllib.loads(text).get("look", {}).items() if x != "detail"}
        assert form.get("look", {}) == said, one["name"]
        rest = lambda document: {x: y for x, y in document.items() if x != "stage"}  # noqa: E731
        assert rest(tomllib.loads(text)) == rest(tomllib.loads(changed)), one["name"]


def other_texts():
    """Tables, dotted names, strings over lines, comments that look like keys."""
    text = ('# mask = "no"\n[[stage]]\nname = "a"  # name = "b"\nmodel = "mine.toml"\nparameters.D = 2\n'
            'mask = """\nbx > 0 \\\n  or by > 0"""\n[stage.directions]\naxis = [0, 1, 0]\n[[texture]]\nname = "age"\n'
            'file = "age.png"\n[[brush]]\nname = "bald"')
    changed, joined = edited(text)
    document = tomllib.loads(changed)
    assert joined == ["a"] and document["stage"][0]["name"] == "a"
    assert document["stage"][0]["directions"] == {"strokes": [[[0, 0.5, -1], [1, 2, 3e-7]]]}
    assert "bx > 0" in document["stage"][0]["mask"] and document["texture"][0]["file"] == "age.png"
    assert recipe_text.stage_group(text, 0, "parameters") == {"D": "2"}
    assert recipe_text.files_named(text) == ["mine.toml", "age.png"]
    assert recipe_text.painted_names(text) == ["age", "bald"]
    assert recipe_text.attributes_in("1 + attribute( tail ) * attribute(b_1)", "attribute") == {"tail", "b_1"}


def names():
    """What formulas cannot hold, or a file would read as something else, gets another name."""
    for name, plain in (("Tail", "Tail"), ("Fat half.L", "Fat_half_L"), ("2nd", "_2nd"), ("x", "x_"), ("U", "U_"),
                        ("", "_"), ("Größe", "Gr__e")):
        assert recipe_text.formula_name(name) == plain, f"{name}: {recipe_text.formula_name(name)}"
    assert recipe_text.is_part_of("TAIL_linear_2", "tail") and recipe_text.is_part_of("tail_4", "Tail")
    assert not recipe_text.is_part_of("tail_5", "tail") and not recipe_text.is_part_of("tailor", "tail")


def finished(job):
    try:
        return job.result()
    finally:
        job.close()


def failed(words, *commands):
    job = process.Job()
    try:
        job.start(*commands)
        finished(job)
    except process.Failure as failure:
        assert words in str(failure), f"\"{failure}\" instead of ... {words} ..."
        job.close()
        assert os.listdir(TEMPORARY) == []
        return
    raise AssertionError(f"{commands} did not fail")


def program():
    """It is heard, its faults are told, and it ends when it is asked to."""
    job = process.Job()
    sphere, quick = "builtin:sphere?n=642", ["--quality", "draft", "--steps", "400", "--json"]
    job.start([PELAGE, "unwrap", sphere, "-o", "shape.ply"],
              [PELAGE, "grow", "shape.ply", "--size", "0.05", "--keep-shape", "-o", "coat.ply", *quick])
    tasks = set()
    while job.running():
        tasks.add(job.task)
        time.sleep(0.001)
    told = finished(job)
    assert told["files"][0]["path"] == "coat.ply" and any("growing" in task for task in tasks), tasks
    assert job.warnings == told["warnings"] and len(job.warnings) == 1, "edges are too long for that size"
    assert os.listdir(TEMPORARY) == []
    failed("no-such", [PELAGE, "grow", sphere, "--model", "no-such", "-o", "coat.ply"])
    failed("nobody.ply", [PELAGE, "unwrap", "nobody.ply", "-o", "shape.ply"], [PELAGE, "grow", "shape.ply"])
    failed("cannot be run", [os.path.join(FOLDER, "no-program")])


def cancelled():
    """In the midst of growing."""
    job, sphere = process.Job(), "builtin:sphere?n=642"
    job.start([PELAGE, "grow", sphere, "--size", "0.05", "--until", "1e9", "--stationary", "0", "-o",
               "coat.ply", "--json"])
    end = time.monotonic() + 120
    while "growing" not in job.task and job.running() and time.monotonic() < end:
        time.sleep(0.01)
    assert job.running(), job.task
    job.cancel()
    assert not job.running() and job._process.returncode != -9, "it had to be killed"
    try:
        finished(job)
        raise AssertionError("a cancelled run has a result")
    except process.Failure as failure:
        assert str(failure) == "Cancelled"
    assert os.listdir(TEMPORARY) == []


def words():
    """Lines of the program, as a process hears them."""
    job = process.Job()
    for line, heard in (("pelage: growing", ("growing", 0, "")),
                        ("pelage: growing 30 %, 5 s left", ("growing", 0.3, "5 s")),
                        ("pelage: writing a 5 %.ply", ("writing a 5 %.ply", 0, ""))):
        job.hear(line)
        assert (job.task, job.fraction, job.left) == heard, (line, job.task, job.fraction, job.left)
    job.hear("pelage: warning: mind the step")
    assert job.warnings == ["mind the step"] and job.task == "writing a 5 %.ply"
    job.close()


zip_file()
recipes()
other_texts()
names()
words()
program()
cancelled()

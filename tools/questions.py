#!/usr/bin/env python3
"""Measures the tables of docs/questions.md and prints them in Markdown.

Usage: questions.py PELAGE steppers|refresh|moving [MODEL ...]

Seconds are those of the processor, of one run on one thread from reading to writing.
"""
import json
import pathlib
import resource
import subprocess
import sys
import tempfile

SPHERE = ["builtin:sphere?n=642", "--interpolate", "--size", "1.2u", "--method", "linear", "--threads", "1"]
PELAGE = sys.argv[1]
FOLDER = pathlib.Path(tempfile.mkdtemp())


def answer(*arguments, limit=300):
    """What the program prints as JSON, or its error."""
    try:
        done = subprocess.run([PELAGE, *arguments, "--json"], capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None, "too long"
    if done.returncode:
        return None, done.stderr.strip().split("\n")[-1].removeprefix("pelage: error: ")
    return json.loads(done.stdout), ""


def kind(m):
    """One of two phases is in pieces, or both are, or neither is."""
    above, below = m["above"]["parts"], m["below"]["parts"]
    if above > 3 * below:
        return "spots"
    return "holes" if below > 3 * above else "stripes"


def grow(model, *options):
    """What grew: its kind, wavelength, steps and seconds; or why nothing did."""
    coat = str(FOLDER / "coat.vtp")
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    grown, error = answer("grow", "--model", model, *options, "-o", coat)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    if not grown:
        return {"error": error}
    stage = grown["stages"][0]
    result = {"steps": stage["growth"]["steps"], "step": stage["growth"]["last_step"], "end": stage["growth"]["time"],
              "seconds": seconds, "kind": "nothing", "wave": 0}
    if grown["uniform"]:
        return result
    field = species_shown(model)
    measured, error = answer("measure", coat, "--field", field)
    if measured:
        result["kind"] = kind(measured)
        result["wave"] = measured["spectrum"].get("wavelength", 0)
    return result


def species_shown(model):
    described, _ = answer("models", model)
    return described[0]["species"][-1]["name"]


def share(result, reference):
    """Wavelength over that of the reference, in words with the kind of pattern."""
    if "error" in result:
        return "-"
    if not result["wave"] or not reference.get("wave"):
        return result["kind"]
    return f"{result['kind']} {result['wave'] / reference['wave']:.2f}"


def number(result, key):
    return f"{result[key]:.2g}" if key in result else "-"


def steppers(models):
    """Explicit against semi-implicit steps, of the size that the program holds for safe."""
    print("| model | rkc2 | s | semi-implicit | largest | taken | s | explicit | largest | taken | s |")
    print("| --- |" + " --- |" * 10)
    for model in models:
        reference = grow(model, *SPHERE)
        limits = (answer("analyse", model)[0] or {}).get("largest_steps", {})
        row = f"| {model} | {reference.get('kind', '-')} | {number(reference, 'seconds')} |"
        for stepper in ("semi-implicit", "explicit"):
            result = grow(model, *SPHERE, "--stepper", stepper)
            largest = limits.get(stepper)
            row += (f" {share(result, reference)} | {f'{largest:.2g}' if largest else '-'} | {number(result, 'step')} |"
                    f" {number(result, 'seconds')} |")
        print(row, flush=True)


def refresh(models):
    """Matrices that are kept for some semi-implicit steps, at the safe step and at a quarter of it."""
    intervals = (1, 4, 16, 64, 1000000)
    print("| model | step | steps |" + "".join(f" K = {k if k < 1e6 else 'all'} | s |" for k in intervals))
    print("| --- |" * 1 + " --- |" * (2 + 2 * len(intervals)))
    for model in models:
        safe = grow(model, *SPHERE, "--stepper", "semi-implicit")
        for part in (1, 4):
            step = safe.get("step", 0) / part
            if not step:
                continue
            row, reference = "", None
            for k in intervals:
                result = grow(model, *SPHERE, "--step", str(step), "--refresh", str(k))
                reference = reference or result
                row += f" {share(result, reference)} | {number(result, 'seconds')} |"
            print(f"| {model} | {step:.2g} | {reference.get('steps', '-')} |{row}", flush=True)


def moving(models):
    """A surface whose lengths grow by half, renewed with its matrices every so many steps."""
    intervals = (1, 10, 100, 1000)
    print("| model | stepper |" + "".join(f" every {k} | s |" for k in intervals))
    print("| --- |" + " --- |" * (1 + 2 * len(intervals)))
    for model in models:
        end = grow(model, *SPHERE).get("end", 0)
        for stepper in ("rkc2", "sbdf2", "semi-implicit"):
            row, reference = "", None
            for k in intervals:
                result = grow(model, *SPHERE, "--stepper", stepper, "--growth", str(0.405 / end), "--until", str(end),
                              "--every", str(k))
                reference = reference or result
                row += f" {share(result, reference)} | {number(result, 'seconds')} |"
            print(f"| {model} | {stepper} |{row}", flush=True)


if __name__ == "__main__":
    models = sys.argv[3:] or [m["name"] for m in answer("models")[0]]
    {"steppers": steppers, "refresh": refresh, "moving": moving}[sys.argv[2]](models)

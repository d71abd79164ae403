#!/usr/bin/env python3
"""docs/gallery.md, a picture of every recipe and of every model with its variants, on the built-in animal, by `pelage gallery`.
Interrupted, the same command goes on where it was. Usage: gallery_page.py [PELAGE]"""

import json
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
HEAD = """# Every recipe and every model

On the program's animal: `python3 tools/gallery_page.py build/release/bin/pelage` makes this page and its pictures, and goes on
where it was interrupted. `pelage gallery [--recipes] -o DIR --shape FILE` makes such a page for shapes of your own.
"""


def listed(pelage, command):
    listed = subprocess.run([pelage, command, "--json"], check=True, capture_output=True).stdout
    return [entry["name"] for entry in json.loads(listed)]


def make_pictures(pelage, folder, pixels, choice):
    """Unless they are finished; the folder's own page says so."""
    target = ROOT / "docs/gallery" / folder
    page = target / "index.html"
    looks = ["--shape", "builtin:animal", "--picture-size", str(pixels), "--no-ground"]
    if not page.exists() or not page.stat().st_size:
        subprocess.run([pelage, "gallery", *choice, *looks, "-o", target], check=True)
    return page


def table(names, folder, columns):
    """Rows of pictures, each with its name below it."""
    lines = ["|" + " |" * columns, "|" + " --- |" * columns]
    for first in range(0, len(names), columns):
        cells = [
            f'![{n}](gallery/{folder}/{n.replace(":", "-")}-animal.png)<br>`{n}`' for n in names[first : first + columns]
        ]
        lines.append("| " + " | ".join(cells + [""] * (columns - len(cells))) + " |")
    return "\n".join(lines) + "\n"


def main():
    pelage = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/bin/pelage")
    recipes, models = listed(pelage, "recipes"), listed(pelage, "models")
    made = [make_pictures(pelage, "recipes", 224, ["--recipes"]), make_pictures(pelage, "models", 144, [])]
    text = f'{HEAD}\n## Recipes\n\n{table(recipes, "recipes", 4)}\n## Models\n\n{table(models, "models", 6)}'
    (ROOT / "docs/gallery.md").write_text(text)
    for page in made:
        page.unlink()


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Notebooks from scripts: cells begin at lines "# %%", those of "# %% [markdown]" hold text behind "# ".

usage: notebooks.py FOLDER SCRIPT.py...
"""

import json
import pathlib
import sys


def cells_of(script: str) -> list:
    cells, lines = [], None
    for line in script.splitlines():
        if line.startswith("# %%"):
            lines = []
            cells.append(("markdown" if "[markdown]" in line else "code", lines))
        elif lines is None:
            raise ValueError(f"code before the first cell: {line!r}")
        else:
            lines.append(line)
    return [cell(kind, lines) for kind, lines in cells]


def cell(kind: str, lines: list) -> dict:
    if kind == "markdown":
        lines = [line[2:] if line.startswith("# ") else line.lstrip("#") for line in lines]
    source = "\n".join(lines).strip("\n").splitlines(keepends=True)
    code = {"execution_count": None, "outputs": []} if kind == "code" else {}
    return {"cell_type": kind, "metadata": {}, **code, "source": source}


def notebook_of(script: str) -> dict:
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return {"cells": cells_of(script), "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
            "nbformat": 4, "nbformat_minor": 4}


def main(folder: str, *scripts: str) -> None:
    target = pathlib.Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    for script in map(pathlib.Path, scripts):
        text = json.dumps(notebook_of(script.read_text(encoding="utf-8")), indent=1, ensure_ascii=False)
        (target / script.with_suffix(".ipynb").name).write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])

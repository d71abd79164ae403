#!/usr/bin/env python3
"""Checks that every layer includes only layers to its left (docs/architecture.md, "Layers").

Usage: check_layers.py [ROOT]    prints each upward include as FILE:LINE and exits 1 if there is one.
"""
import pathlib
import re
import sys

ORDER = "base < linalg shape react recipe < discretise io < time fair look < run < catalog < apps"
RANK = {layer: rank for rank, group in enumerate(ORDER.split("<")) for layer in group.split()}

# The public headers belong to the layer that implements them.
PUBLIC = {"error": "base", "progress": "base", "triangle_mesh": "shape", "image": "shape", "recipe": "recipe",
          "run": "run", "pelage": "catalog"}
INCLUDE = re.compile(r'\s*#\s*include\s*"([^"]+)"')


def layer_of(path):
    """The layer of a path below src/, include/ or the root, or None for a header next to its user."""
    first, _, rest = path.partition("/")
    if first == "pelage":
        name = rest.removesuffix(".h").removesuffix(".cpp")
        return PUBLIC.get(name) or sys.exit(f"tools/check_layers.py: give include/{path} a layer in PUBLIC")
    return first if rest and first in RANK else None


def violations(root):
    files = [(f, f.relative_to(root / base).as_posix()) for base, pattern in
             (("src", "*/*"), ("include", "pelage/*"), (".", "apps/**/*")) for f in sorted((root / base).glob(pattern))
             if f.suffix in (".h", ".cpp")]
    for file, path in files:
        user = layer_of(path)
        for number, line in enumerate(file.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            used = match and layer_of(match[1])
            if used and used != user and RANK[used] >= RANK[user]:
                yield f"{file.relative_to(root)}:{number}: layer {user} must not include {match[1]} (layer {used})"


if __name__ == "__main__":
    faults = list(violations(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(faults) or "layers: every include points to the left")
    sys.exit(1 if faults else 0)

#!/usr/bin/env python3
"""Checks that every layer includes only layers to its left (docs/architecture.md, "Layers").

Usage: check_layers.py [ROOT]    prints each upward include as FILE:LINE and exits 1 if there is one.
"""
import pathlib
import re
import sys

ORDER = "base < linalg shape react recipe < discretise io < time fair direction look < run < catalog < verify < apps"
RANK = {layer: rank for rank, group in enumerate(ORDER.split("<")) for layer in group.split()}

# The public headers belong to the layer that implements them.
PUBLIC = {"error": "base", "point": "base", "progress": "base", "triangle_mesh": "shape", "image": "shape",
          "recipe": "recipe", "run": "run", "pelage": "catalog"}
INCLUDE = re.compile(r'\s*#\s*include\s*"([^"]+)"')


def layer_of(path):
    """The layer of a path as an #include gives it, or None for a header beside its user."""
    first, _, name = path.partition("/")
    layer = PUBLIC.get(name.partition(".")[0]) if first == "pelage" else first
    if name and layer not in RANK:
        sys.exit(f"tools/check_layers.py: give {path} a place in ORDER or PUBLIC")
    return layer if name else None


def violations(root):
    for base, pattern in ("src", "*/*"), ("include", "pelage/*"), (".", "apps/**/*"):
        for file in sorted(f for f in (root / base).glob(pattern) if f.suffix in (".h", ".cpp")):
            user = layer_of(file.relative_to(root / base).as_posix())
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                used = match and layer_of(match[1])
                if used and used != user and RANK[used] >= RANK[user]:
                    yield f"{file.relative_to(root)}:{number}: {user} must not include {match[1]} (layer {used})"


if __name__ == "__main__":
    faults = list(violations(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(faults) or "layers: every include points to the left")
    sys.exit(1 if faults else 0)

#!/usr/bin/env python3
"""Checks that every layer includes only layers to its left, and others' headers only where they belong
(docs/architecture.md, "Layers").

Usage: check_layers.py [ROOT]    prints each wrong include as FILE:LINE and exits 1 if there is one.
"""
import pathlib
import re
import sys

ORDER = "base < linalg shape react recipe < discretise io print < time fair direction look gridgen solid measure unwrap < run < catalog < verify render studio < apps python"
RANK = {layer: rank for rank, group in enumerate(ORDER.split("<")) for layer in group.split()}

# The public headers belong to the layer that implements them.
PUBLIC = {"error": "base", "channel": "base", "named_files": "base", "point": "base", "progress": "base", "triangle_mesh": "shape", "polygon_mesh": "shape",
          "up_axis": "shape", "image": "shape", "texture_maps": "shape", "grid": "shape", "atlas": "shape", "cells": "shape",
          "tet_mesh": "shape", "node_shape": "shape",
          "unwrap": "unwrap", "finding": "shape", "stability": "react", "recipe": "recipe", "io": "io", "fair": "fair", "field": "direction",
          "measure": "measure", "own_rates": "run", "run_summary": "run", "recipe_changes": "catalog", "grow": "catalog", "analyse": "catalog", "render": "render", "pelage": "apps"}
INCLUDE = re.compile(r'\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')

# Where headers belong that are neither of the C++ standard library nor of Eigen: those whose names begin like this, in
# files whose paths begin like that.
OUTSIDE = {"tbb/": ["src/base/parallel.cpp"], "sanitizer/": ["src/base/parallel.cpp"], "toml++/": ["src/recipe/document.cpp"], "tiny_gltf.h": ["src/io/"],
           "spng.h": ["src/io/png_reader.cpp"], "turbojpeg.h": ["src/io/jpeg_reader.cpp"],
           "libdeflate.h": ["src/io/zlib.cpp"],
           "pugixml.hpp": ["src/io/vtk_document.", "src/io/record_in_file.cpp"], "stb_truetype.h": ["src/look/text.cpp"], "embree3/": ["src/render/"],
           "malloc.h": ["apps/cli/main.cpp", "python/module/module.cpp"], "unistd.h": ["src/io/", "apps/cli/"], "fcntl.h": ["src/io/"],
           "sys/": ["src/io/temporary_file.cpp", "apps/cli/"], "spawn.h": ["apps/cli/"], "CLI/": ["apps/cli/"], "httplib.h": ["apps/cli/studio_server.cpp"], "nlohmann/": ["apps/cli/", "src/studio/", "src/io/gltf_", "src/io/record.cpp"],
           "pybind11/": ["python/module/"], "sha2.h": ["src/io/sha256.cpp"], "draco/": ["src/io/gltf_draco.cpp"], "meshoptimizer.h": ["src/io/gltf_meshoptimizer.cpp", "src/io/gltf_compressor.cpp"]}


def layer_of(path):
    """The layer of a path as an #include gives it, or None for a header beside its user."""
    first, _, name = path.partition("/")
    layer = PUBLIC.get(name.partition(".")[0]) if first == "pelage" else first
    if name and layer not in RANK:
        sys.exit(f"tools/check_layers.py: give {path} a place in ORDER or PUBLIC")
    return layer if name else None


def belongs(header, file):
    """Headers of the C++ standard library have neither a dot nor a slash in their names."""
    if header.startswith("Eigen/"):
        return not file.startswith("include/")
    return not re.search(r"[./]", header) or any(
        file.startswith(place) for name, places in OUTSIDE.items() if header.startswith(name) for place in places)


def violations(root):
    for base, pattern in ("src", "*/*"), ("include", "pelage/*"), (".", "apps/**/*"), (".", "python/**/*"):
        for file in sorted(f for f in (root / base).glob(pattern) if f.suffix in (".h", ".cpp")):
            user = layer_of(file.relative_to(root / base).as_posix())
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                used = match and match[1] and layer_of(match[1])
                place = file.relative_to(root).as_posix()
                if user == "python" and match and match[1] and "/" in match[1] and not match[1].startswith("pelage/"):
                    yield f"{place}:{number}: the Python package includes public headers only, not {match[1]}"
                elif used and used != user and RANK[used] >= RANK[user]:
                    yield f"{place}:{number}: {user} must not include {match[1]} (layer {used})"
                if match and match[2] and not belongs(match[2], place):
                    yield f"{place}:{number}: <{match[2]}> does not belong here (see OUTSIDE in tools/check_layers.py)"


if __name__ == "__main__":
    faults = list(violations(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(faults) or "layers: every include is where it belongs")
    sys.exit(1 if faults else 0)

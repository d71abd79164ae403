#!/usr/bin/env python3
"""Packs the Blender add-on with the pictures of the gallery: tools/blender_addon.py [ZIP], default out/pelage_addon.zip."""
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ADDON = ROOT / "blender" / "pelage_addon"
GALLERY = ROOT / "docs" / "gallery"
EPOCH = (1980, 1, 1, 0, 0, 0)  # the same sources make the same file


def contents() -> dict:
    """By their names in the file: modules, manifest and licence, and a picture of each recipe and model."""
    files = {path.name: path for path in ADDON.iterdir() if path.suffix in (".py", ".toml")}
    files["LICENSE"] = ROOT / "LICENSE"
    for picture in GALLERY.glob("*/*-animal.png"):
        files[f"pictures/{picture.parent.name}/{picture.name.removesuffix('-animal.png')}.png"] = picture
    return files


def main():
    """Writes the file."""
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "out" / "pelage_addon.zip"
    target.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, path in sorted(contents().items()):
            entry = zipfile.ZipInfo(f"{ADDON.name}/{name}", EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, path.read_bytes())
    print(f"wrote     {target}")


if __name__ == "__main__":
    main()

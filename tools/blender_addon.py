#!/usr/bin/env python3
"""Packs the Blender add-on with the gallery's pictures. Usage: blender_addon.py [ZIP], default out/pelage_addon.zip"""
import struct
import sys
import zipfile
import zlib
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


def chunk(kind: bytes, data: bytes) -> bytes:
    """One of a PNG file."""
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def without_caption(png: bytes) -> bytes:
    """The square above the words: menus have words of their own. Rows of PNG files need none of the rows below them."""
    chunks, at = {}, 8
    while at < len(png):
        size, kind = struct.unpack_from(">I4s", png, at)
        chunks[kind] = chunks.get(kind, b"") + png[at + 8:at + 8 + size]
        at += 12 + size
    width, height, *form = struct.unpack(">IIBBBBB", chunks[b"IHDR"])
    assert form == [8, 2, 0, 0, 0] and width <= height, "pictures of the gallery are upright, of three bytes a pixel"
    rows = zlib.decompress(chunks[b"IDAT"])[:(1 + 3 * width) * width]
    return (png[:8] + chunk(b"IHDR", struct.pack(">IIBBBBB", width, width, *form))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def main():
    """Writes the file."""
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "out" / "pelage_addon.zip"
    target.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, path in sorted(contents().items()):
            entry = zipfile.ZipInfo(f"{ADDON.name}/{name}", EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            data = path.read_bytes()
            archive.writestr(entry, without_caption(data) if path.suffix == ".png" else data)
    print(f"wrote     {target}")


if __name__ == "__main__":
    main()

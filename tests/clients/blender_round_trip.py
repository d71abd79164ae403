# blender -b --factory-startup --python-exit-code 3 -P blender_round_trip.py -- PELAGE FOLDER
# The steps of docs/blender.md: a figure is made and painted, exported as PLY and GLB, taken through the program, and
# imported again: it stands where it stood, has its name, and the colours that were painted.
import json
import math
import os
import subprocess
import sys

import bpy
import numpy
from mathutils import Vector

for name, kind in (("bool", bool), ("int", int), ("float", float), ("object", object)):
    if name not in numpy.__dict__:  # the glTF importer of Blender 3.4 uses names that numpy 1.24 dropped
        setattr(numpy, name, kind)

PELAGE, FOLDER = sys.argv[sys.argv.index("--") + 1:][:2]
os.makedirs(FOLDER, exist_ok=True)
os.chdir(FOLDER)
NEW_PLY = "ply_export" in dir(bpy.ops.wm)  # from 3.6 on written in C++, before an add-on
OLD_NAMES = bpy.app.version < (3, 6)  # Blender's glTF put "_" before all names, where newer ones take only those that have it


def run(*arguments):
    done = subprocess.run([PELAGE, *arguments], capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(arguments)}: {done.stderr}"
    return done.stdout + done.stderr


def attributes(path):
    """Those that formulas can read: normals are not among them."""
    return [a for a in json.loads(run("check", path, "--json"))["attributes"] if not a.startswith("normal ")]


# --- the figure ------------------------------------------------------------------------------------------------
def make():
    """A cone, so that above and below differ, taller than wide; colours, weights, numbers and directions on it."""
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)
    bpy.ops.mesh.primitive_cone_add(vertices=24, radius1=1, radius2=0.4, depth=5, location=(2, 3, 4))
    figure = bpy.context.object
    figure.name = figure.data.name = "Beast"
    bpy.ops.object.modifier_add(type="SUBSURF")
    figure.modifiers[-1].subdivision_type = "SIMPLE"
    figure.modifiers[-1].levels = 3
    bpy.ops.object.modifier_apply(modifier=figure.modifiers[-1].name)
    mesh = figure.data
    weights = figure.vertex_groups.new(name="Tail")
    for vertex in mesh.vertices:
        weights.add([vertex.index], 0.5 + vertex.co.z / 10, "ADD")
    paint = mesh.color_attributes.new("Mask", "BYTE_COLOR", "CORNER")
    for loop, colour in zip(mesh.loops, paint.data):
        colour.color_srgb = shade(mesh.vertices[loop.vertex_index].co)
    again = mesh.color_attributes.new("Vertices", "FLOAT_COLOR", "POINT")
    for vertex, colour in zip(mesh.vertices, again.data):
        colour.color_srgb = shade(vertex.co)
    tail = mesh.attributes.new(own_name("tail"), "FLOAT", "POINT")
    for vertex, value in zip(mesh.vertices, tail.data):
        value.value = weights.weight(vertex.index)
    return figure


def own_name(name):
    return name if OLD_NAMES else "_" + name


def shade(p):
    """sRGB, in steps of bytes, so that nothing is rounded on the way."""
    return [round(255 * c) / 255 for c in (0.5 + p[2] / 10, 0.5 + p[0] / 4, 0.5 + p[1] / 4)] + [1.0]


def show(figure, name):
    """Makes a colour the one that exporters take."""
    colors = figure.data.color_attributes
    colors.active_color = colors[name]
    colors.render_color_index = colors.find(name)


def export_ply(figure, path, color):
    show(figure, color)
    bpy.ops.object.select_all(action="DESELECT")
    figure.select_set(True)
    if NEW_PLY:
        bpy.ops.wm.ply_export(filepath=path, export_selected_objects=True)
    else:
        bpy.ops.export_mesh.ply(filepath=path, use_selection=True)


def export_glb(figure, path, color):
    show(figure, color)
    bpy.ops.object.select_all(action="DESELECT")
    figure.select_set(True)
    bpy.ops.export_scene.gltf(filepath=path, use_selection=True, export_attributes=True)


# --- what comes back ---------------------------------------------------------------------------------------------
def corners(figure):
    """What Blender shows at every corner: place in the world and the active colour, in sRGB."""
    mesh = figure.data
    paint = mesh.color_attributes.active_color or mesh.color_attributes[0]
    by_corner = paint.domain == "CORNER"
    for loop in mesh.loops:
        colour = paint.data[loop.index if by_corner else loop.vertex_index].color_srgb
        yield tuple(figure.matrix_world @ mesh.vertices[loop.vertex_index].co), tuple(colour)[:3]


def box(figure):
    places = [place for place, _ in corners(figure)]
    return [min(p[k] for p in places) for k in range(3)] + [max(p[k] for p in places) for k in range(3)]


def bring(path):
    before = set(bpy.data.objects)
    if path.endswith(".glb"):
        bpy.ops.import_scene.gltf(filepath=path)
    elif NEW_PLY:
        bpy.ops.wm.ply_import(filepath=path)
    else:
        bpy.ops.import_mesh.ply(filepath=path)
    bpy.context.view_layer.update()
    new = [o for o in set(bpy.data.objects) - before if o.type == "MESH"]
    assert len(new) == 1, f"{path}: {len(new)} meshes arrived"
    return new[0]


def off(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def color_error(figure, arrived):
    """The largest difference from what was painted at the same place."""
    return max(off(colour, shade(figure.matrix_world.inverted() @ Vector(place))) for place, colour in corners(arrived))


def compare(figure, path, name):
    """Place, name and colours of what arrives."""
    arrived = bring(path)
    away = off(box(figure), box(arrived))
    assert away < 1e-5, f"{path}: the bounding box is off by {away}: {box(arrived)} instead of {box(figure)}"
    assert arrived.name.split(".")[0] == name, f"{path}: called {arrived.name}"
    worst = color_error(figure, arrived)
    assert worst < 1.01 / 255, f"{path}: colours are off by {255 * worst:.2f} of 255"
    bpy.data.objects.remove(arrived)
    return f"{path} {255 * worst:.2f}"


def grown(figure, path):
    """A coat: it stands where the figure stands, and has colours of its own."""
    arrived = bring(path)
    away = off(box(figure), box(arrived))
    assert away < 1e-5, f"{path}: the bounding box is off by {away}: {box(arrived)} instead of {box(figure)}"
    assert len({tuple(round(c, 2) for c in colour) for _, colour in corners(arrived)}) > 8, f"{path}: no coat"
    bpy.data.objects.remove(arrived)


def without(figure, color):
    """A copy that does not have one of the colours."""
    other = figure.copy()
    other.data = figure.data.copy()
    bpy.context.collection.objects.link(other)
    other.data.color_attributes.remove(other.data.color_attributes[color])
    return other


def what_is_exported(figure):
    """The table of docs/blender.md."""
    export_ply(figure, "beast.ply", "Mask")
    export_ply(without(figure, "Mask"), "floats.ply", "Vertices")
    export_glb(figure, "beast.glb", "Vertices")
    export_glb(figure, "corners.glb", "Mask")
    has = {path: attributes(path) for path in ("beast.ply", "floats.ply", "beast.glb", "corners.glb")}
    for path, names in has.items():
        print(path, "has", "; ".join(names))
    painted = "color (4 per vertex)"
    assert painted in has["beast.ply"] and painted in has["beast.glb"]
    assert "TAIL (1 per vertex)" in has["beast.glb"], "the copied weights are not in the GLB file"
    if OLD_NAMES:
        assert has["beast.ply"] == [painted, "uv (2 per corner)"] and has["floats.ply"] == ["uv (2 per corner)"]
        mixed = bring("corners.glb")
        assert color_error(figure, mixed) > 0.1, "colours of corners are no longer mixed up: docs/blender.md says so"
        bpy.data.objects.remove(mixed)


def main():
    figure = make()
    what_is_exported(figure)
    # Back as it was: PLY to PLY and GLB, GLB to GLB.
    run("fair", "beast.ply", "--steps", "0", "-o", "back.ply,beast_back.glb")
    run("fair", "beast.glb", "--steps", "0", "-o", "back_glb.glb")
    told = [compare(figure, "back.ply", "back"), compare(figure, "beast_back.glb", "beast"),
            compare(figure, "back_glb.glb", "Beast")]
    # A coat whose size follows the paint, on the figure's own vertices.
    for source, form in (("beast.ply", "color_1"), ("beast.glb", "color_1"), ("beast.glb", "tail")):
        run("grow", source, "--model", "turing", "--size", "0.1", "--param-map", f"size=1 + attribute({form})", "--steps",
            "80", "--keep-shape", "-o", "coat.glb" + (",coat.ply" if source.endswith("ply") else ""))
        grown(figure, "coat.glb")
    grown(figure, "coat.ply")
    print("ok the same box, names, colours within", ", ".join(told), "of 255")


main()

"""What the program has made, brought into the scene."""
import os
import re

import bpy
import numpy as np
from mathutils import Matrix

from . import figure, material, ply
from .process import Failure
from .recipe_text import RESERVED

COLOR = "Pelage"  # the colour attribute
PREFIX = "pelage_"  # of attributes that are numbers
_RGB = ("red", "green", "blue")
_NO_FIELDS = {"nx", "ny", "nz", "alpha", *_RGB}


def fields(coat: ply.Mesh, sent=()) -> dict:
    """The species and channels of a coat by name, without what was sent to the program and came back."""
    found = {}
    for name, values in coat.columns.items():
        given_back = name in sent and f"input_{name}" not in coat.columns
        if name in _NO_FIELDS or name.startswith("input_") or given_back:
            continue
        plain = name[:-1] if name.endswith("_") and name[:-1] in RESERVED else name  # PLY has other uses for u and v
        found[plain] = values
    return found


def _set_attribute(mesh, name: str, kind: str, property_name: str, values: np.ndarray):
    old = mesh.attributes.get(name)
    if old and (old.data_type, old.domain) != (kind, "POINT"):
        mesh.attributes.remove(old)
        old = None
    attribute = old or mesh.attributes.new(name, kind, "POINT")
    attribute.data.foreach_set(property_name, np.ascontiguousarray(values, np.float32).reshape(-1))


def set_attributes(mesh, coat: ply.Mesh, sent=()):
    """Colours and fields at the vertices of a mesh that has as many."""
    found = fields(coat, sent)
    for attribute in [a.name for a in mesh.attributes if a.name.startswith(PREFIX)]:
        if attribute[len(PREFIX):] not in found:  # of a coat before
            mesh.attributes.remove(mesh.attributes[attribute])
    for name, values in found.items():
        _set_attribute(mesh, PREFIX + name, "FLOAT", "value", values)
    rgb = np.stack([coat.columns[name] / np.float32(255) for name in _RGB] + [np.ones(len(coat.points))], axis=1)
    is_new = COLOR not in mesh.attributes
    _set_attribute(mesh, COLOR, "BYTE_COLOR", "color_srgb", rgb)
    if is_new:  # shown from now on; later the choice is the user's
        mesh.color_attributes.active_color = mesh.color_attributes[COLOR]
        mesh.color_attributes.render_color_index = mesh.color_attributes.find(COLOR)


def attribute_sources(mesh) -> dict:
    """Where the material finds each channel of a coat that is at vertices."""
    sources = {"color": material.Source(attribute=COLOR)}
    for channel in material.CHANNELS:
        if f"{PREFIX}material_{channel}" in mesh.attributes:
            sources[channel] = material.Source(attribute=f"{PREFIX}material_{channel}")
    return sources


def on_vertices(obj, path: str, sent, displace: bool) -> list:
    """Onto the object's own mesh."""
    coat = ply.read(path)
    if len(coat.points) != len(obj.data.vertices):
        raise Failure(f"\"{obj.name}\" has {len(obj.data.vertices)} vertices, and the coat {len(coat.points)}: the "
                      "mesh was changed while it grew")
    set_attributes(obj.data, coat, sent)
    obj.data.update()
    return material.dress(obj, attribute_sources(obj.data), "", displace)


# --- images ------------------------------------------------------------------------------------------------------


def _load(path: str, name: str, channel: str):
    """Into the file of the scene: the folder that it is read from will be gone."""
    image = bpy.data.images.load(path)
    image.name = name
    image.colorspace_settings.name = "sRGB" if material.is_color(channel) else "Non-Color"
    image.pack()
    image.filepath = image.filepath_raw = ""
    for packed in image.packed_files:
        packed.filepath = ""
    return image


def _remove_unused(images):
    for image in images:
        if image.users == 0:
            bpy.data.images.remove(image)


def _images_of(obj) -> list:
    """Those that the nodes of its materials show."""
    trees = [slot.material.node_tree for slot in obj.material_slots if slot.material and slot.material.node_tree]
    nodes = [tree.nodes.get(f"Pelage {channel}") for tree in trees for channel in material.CHANNELS]
    return list({node.image for node in nodes if node and getattr(node, "image", None)})


def as_images(obj, folder: str, files: list, uv: str, displace: bool) -> list:
    """The program's images, packed, in the object's materials. `files`: what the program says of them."""
    about = {os.path.basename(file["path"]): file.get("form", "") for file in files}
    sources, notes = {}, []
    old = _images_of(obj)
    has_relief = "coat-normal.png" in about  # without one the height is but the shown species
    for channel in (c for c in material.CHANNELS if has_relief or c != "height"):
        name = f"coat-{channel}" + (".exr" if channel == "height" else ".png")
        if name in about:
            image = _load(os.path.join(folder, name), f"{obj.name} {channel}", channel)
            white = re.match(r"white is (\S+)", about[name])
            sources[channel] = material.Source(image=image, strength=float(white[1]) if white else 1)
    if "coat-thickness.png" in about:
        notes.append("The coat's thickness of glass has no place in Blender's Principled BSDF and is left out")
    notes += material.dress(obj, sources, uv, displace)
    _remove_unused(old)
    return notes


def set_uv(mesh, texcoord: np.ndarray, mirrored: bool) -> str:
    """The atlas that the program has made, as a uv map of the mesh; returns its name."""
    uv = np.empty((len(mesh.loops), 2), np.float32)
    uv[figure.loop_order(mesh, mirrored)] = texcoord
    layer = mesh.uv_layers.new(name=COLOR, do_init=False)
    layer.data.foreach_set("uv", uv.reshape(-1))
    return layer.name


# --- a mesh of its own -------------------------------------------------------------------------------------------


def _make_mesh(name: str, coat: ply.Mesh):
    """A smooth mesh of Blender's."""
    mesh = bpy.data.meshes.new(name)
    starts = np.cumsum(coat.sizes) - coat.sizes
    mesh.vertices.add(len(coat.points))
    mesh.vertices.foreach_set("co", coat.points.astype(np.float32).reshape(-1))
    mesh.loops.add(len(coat.corners))
    mesh.loops.foreach_set("vertex_index", coat.corners.astype(np.int32))
    mesh.polygons.add(len(coat.sizes))
    mesh.polygons.foreach_set("loop_start", starts.astype(np.int32))
    if not bpy.types.MeshPolygon.bl_rna.properties["loop_total"].is_readonly:  # up to 3.5
        mesh.polygons.foreach_set("loop_total", coat.sizes.astype(np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(coat.sizes), bool))
    mesh.update(calc_edges=True)
    return mesh


def _object_beside(obj, mesh):
    """The one that an earlier run has made gets the mesh and keeps its materials; or else a new one."""
    beside = next((other for other in bpy.data.objects if other.get("pelage_of") == obj.name), None)
    if beside:
        old, beside.data = beside.data, mesh
        for material_before in old.materials:
            mesh.materials.append(material_before)
        if old.users == 0:
            bpy.data.meshes.remove(old)
        return beside
    beside = bpy.data.objects.new(mesh.name, mesh)
    beside["pelage_of"] = obj.name
    for collection in obj.users_collection:
        collection.objects.link(beside)
    return beside


def new_mesh(obj, path: str, frame: figure.Frame, displace: bool) -> tuple:
    """The finer mesh as an object beside; returns it and lines."""
    coat = ply.read(path)
    mesh = _make_mesh(f"{obj.name} coat", coat)
    set_attributes(mesh, coat)
    beside = _object_beside(obj, mesh)
    beside.matrix_world = Matrix(frame.world.tolist())
    return beside, material.dress(beside, attribute_sources(mesh), "", displace)


# --- places ------------------------------------------------------------------------------------------------------


def set_places(obj, path: str, frame: figure.Frame):
    """The vertices go where the program has put them; all else stays."""
    faired = ply.read(path)
    if len(faired.points) != len(obj.data.vertices):
        raise Failure(f"\"{obj.name}\" has {len(obj.data.vertices)} vertices, and {len(faired.points)} came back: the "
                      "mesh was changed meanwhile")
    obj.data.vertices.foreach_set("co", frame.local_points(faired.points).astype(np.float32).reshape(-1))
    obj.data.update()

"""An object as the program sees it: its mesh, what is painted on it, and strokes beside it."""
import math
from contextlib import contextmanager

import bpy
import numpy as np
from mathutils import Vector
from mathutils.geometry import interpolate_bezier

from . import ply
from .process import Failure
from .recipe_text import formula_name, is_part_of

AXES = {"X": (1, 0, 0), "-X": (-1, 0, 0), "Y": (0, 1, 0), "-Y": (0, -1, 0), "Z": (0, 0, 1), "-Z": (0, 0, -1)}
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


class Frame:
    """The axes of coats: x to where a figure looks, y up, z to its right; lengths are those of the scene.

    They turn with the object, so that a coat does not depend on where the object stands, while its scale counts.
    """

    def __init__(self, obj, front: str, up: str):
        ahead, upwards = np.array(AXES[front], float), np.array(AXES[up], float)
        if abs(ahead @ upwards) > 0:
            raise Failure("A figure cannot look where its upper side is: choose other axes")
        turn = np.array([ahead, upwards, np.cross(ahead, upwards)])
        place, rotation, _ = obj.matrix_world.decompose()
        world = np.array(obj.matrix_world)
        rotated = np.array(rotation.to_matrix())
        scale = rotated.T @ world[:3, :3]
        # Blender's matrices are floats: without their rounding a turned object has the same coat to the bit.
        digits = 5 - math.floor(math.log10(max(np.abs(scale).max(), 1e-30)))
        self.from_object = turn @ np.round(scale, digits)
        self.from_world = turn @ rotated.T
        self.place = np.array(place)
        self.world = np.eye(4)
        self.world[:3, :3], self.world[:3, 3] = self.from_world.T, self.place
        self.mirrored = np.linalg.det(self.from_object) < 0
        if abs(np.linalg.det(self.from_object)) == 0:
            raise Failure("The object's scale makes it flat: set its scale to something else than 0")

    def points(self, local: np.ndarray) -> np.ndarray:
        """Places of the object's mesh."""
        return local @ self.from_object.T

    def world_points(self, world: np.ndarray) -> np.ndarray:
        """Places of the scene."""
        return (world - self.place) @ self.from_world.T

    def local_points(self, points: np.ndarray) -> np.ndarray:
        """Back into the object's mesh."""
        return points @ np.linalg.inv(self.from_object).T


@contextmanager
def shown_mesh(context, obj, evaluated: bool):
    """The object's own mesh, or the one that its modifiers make."""
    if not evaluated:
        yield obj.data
        return
    graph = context.evaluated_depsgraph_get()
    shown = obj.evaluated_get(graph)
    try:
        yield shown.to_mesh(preserve_all_data_layers=True, depsgraph=graph)
    finally:
        shown.to_mesh_clear()


def numbers(collection, name: str, components: int = 1, kind=np.float32) -> np.ndarray:
    """A property of all elements of a collection of Blender's."""
    values = np.empty(len(collection) * components, kind)
    collection.foreach_get(name, values)
    return values.reshape(-1, components) if components > 1 else values


def loop_order(mesh, mirrored: bool) -> np.ndarray:
    """Blender's corners as they are sent. Mirrored objects are turned inside out, as Blender shows them."""
    sizes = numbers(mesh.polygons, "loop_total", kind=np.int32)
    first = np.repeat(numbers(mesh.polygons, "loop_start", kind=np.int32), sizes)
    within = np.arange(len(first)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    return first + (np.repeat(sizes, sizes) - 1 - within if mirrored else within)


def polygons(mesh, frame: Frame, uv) -> ply.Mesh:
    """With the uv of that name, if there is one."""
    points = frame.points(numbers(mesh.vertices, "co", 3).astype(np.float64))
    sizes = numbers(mesh.polygons, "loop_total", kind=np.int32)
    loops = loop_order(mesh, frame.mirrored)
    corners = numbers(mesh.loops, "vertex_index", kind=np.int32)[loops]
    lists = {"texcoord": numbers(mesh.uv_layers[uv].data, "uv", 2)[loops]} if uv else {}
    return ply.Mesh(points, sizes, corners, {}, lists)


def _face_normals(mesh: ply.Mesh, following: np.ndarray) -> np.ndarray:
    """Unit vectors; 0 of faces without area."""
    first = np.cumsum(mesh.sizes) - mesh.sizes
    places = mesh.points - mesh.points.mean(axis=0)
    sums = np.add.reduceat(np.cross(places[mesh.corners], places[mesh.corners[following]]), first)
    return sums / np.maximum(np.linalg.norm(sums, axis=1), 1e-300)[:, None]


def sharpest_bend(mesh: ply.Mesh) -> float:
    """The largest angle between two faces that share an edge, in radians."""
    first, corner = np.cumsum(mesh.sizes) - mesh.sizes, np.arange(len(mesh.corners))
    face = np.repeat(np.arange(len(mesh.sizes)), mesh.sizes)
    following = np.where(corner + 1 < (first + mesh.sizes)[face], corner + 1, first[face])
    normals = _face_normals(mesh, following)
    edges = np.sort(np.stack([mesh.corners, mesh.corners[following]], axis=1), axis=1)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    shared = np.flatnonzero((edges[order[1:]] == edges[order[:-1]]).all(axis=1))
    one, other = normals[face[order[shared]]], normals[face[order[shared + 1]]]
    cosines = (one * other).sum(axis=1)[(np.abs(one).sum(axis=1) > 0) & (np.abs(other).sum(axis=1) > 0)]
    return float(np.arccos(np.clip(cosines.min(initial=1), -1, 1)))


def tiles(mesh: ply.Mesh) -> int:
    """How many images its uv lies in (UDIM); one where a face lies across the border of a tile, for then it repeats."""
    uv, first = mesh.corner_lists["texcoord"], np.cumsum(mesh.sizes) - mesh.sizes
    least, most = (np.floor(reduce.reduceat(uv, first) + nudge) for reduce, nudge in
                   ((np.minimum, 1e-5), (np.maximum, -1e-5)))
    return 1 if np.any(most > least) else len(np.unique(least, axis=0))


# --- what formulas read ------------------------------------------------------------------------------------------


def readable_names(obj) -> list:
    """Vertex groups and attributes that formulas can read, by their names in Blender."""
    kinds = ("FLOAT", "INT", "INT8", "BOOLEAN", "FLOAT_VECTOR", "FLOAT_COLOR", "BYTE_COLOR")
    attributes = [a.name for a in obj.data.attributes if a.data_type in kinds and a.domain in _TO_VERTICES]
    return [group.name for group in obj.vertex_groups] + [name for name in attributes if not name.startswith(".")]


def _means(values: np.ndarray, vertices: np.ndarray, count: int) -> np.ndarray:
    """Per vertex the mean of what lies at it."""
    total = np.zeros((count, values.shape[1]))
    np.add.at(total, vertices, values)
    return total / np.maximum(np.bincount(vertices, minlength=count), 1)[:, None]


def _from_corners(mesh, values):
    return _means(values, numbers(mesh.loops, "vertex_index", kind=np.int32), len(mesh.vertices))


def _from_faces(mesh, values):
    return _from_corners(mesh, np.repeat(values, numbers(mesh.polygons, "loop_total", kind=np.int32), axis=0))


def _from_edges(mesh, values):
    ends = numbers(mesh.edges, "vertices", 2, np.int32)
    return _means(np.repeat(values, 2, axis=0), ends.reshape(-1), len(mesh.vertices))


_TO_VERTICES = {"POINT": lambda mesh, values: values, "CORNER": _from_corners, "FACE": _from_faces,
                "EDGE": _from_edges}


def _weights(mesh, index: int) -> np.ndarray:
    """Of a vertex group; 0 for vertices that are not in it."""
    values = np.zeros(len(mesh.vertices))
    for vertex in mesh.vertices:
        for element in vertex.groups:
            if element.group == index:
                values[vertex.index] = element.weight
    return values


def _color_columns(mesh, attribute, name: str) -> dict:
    """By the rule of docs/recipes.md: a formula reads what was painted."""
    at_vertices = _TO_VERTICES[attribute.domain]
    painted = at_vertices(mesh, numbers(attribute.data, "color_srgb", 4))
    linear = at_vertices(mesh, numbers(attribute.data, "color", 4))
    columns = {name: painted[:, :3] @ _LUMINANCE, f"{name}_4": linear[:, 3]}
    for k in range(3):
        columns[f"{name}_{k + 1}"] = painted[:, k]
        columns[f"{name}_linear_{k + 1}"] = linear[:, k]
    return columns


def _attribute_columns(mesh, attribute, name: str) -> dict:
    if attribute.data_type in ("FLOAT_COLOR", "BYTE_COLOR"):
        return _color_columns(mesh, attribute, name)
    at_vertices = _TO_VERTICES[attribute.domain]
    if attribute.data_type == "FLOAT_VECTOR":
        values = at_vertices(mesh, numbers(attribute.data, "vector", 3))
        return {f"{name}_{k + 1}": values[:, k] for k in range(3)}
    kinds = {"FLOAT": np.float32, "BOOLEAN": bool}
    values = numbers(attribute.data, "value", kind=kinds.get(attribute.data_type, np.int32))
    return {name: at_vertices(mesh, values.astype(np.float64)[:, None])[:, 0]}


def _columns_of(mesh, groups: dict, source: str, name: str) -> dict:
    if source in groups:
        return {name: _weights(mesh, groups[source])}
    attribute = mesh.attributes.get(source)  # modifiers may have taken it away
    return _attribute_columns(mesh, attribute, name) if attribute else {}


def painted(obj, mesh, wanted: set) -> tuple:
    """What formulas want of the object's groups and attributes, as numbers per vertex; and lines about names."""
    groups = {group.name: group.index for group in obj.vertex_groups}
    columns, notes = {}, []
    for source in readable_names(obj):
        name = formula_name(source)
        if not any(is_part_of(one, name) for one in wanted):
            continue
        if name != source:
            notes.append(f"\"{source}\" is attribute({name}) in formulas")
        for column, values in _columns_of(mesh, groups, source, name).items():
            if column in columns:
                notes.append(f"attribute({column}) is that of the first of several such names, not of \"{source}\"")
            columns.setdefault(column, values)
    return columns, notes


# --- strokes -----------------------------------------------------------------------------------------------------

STROKE_TYPES = {"CURVE", "CURVES", "GPENCIL", "GREASEPENCIL"}


def _bezier_points(spline) -> list:
    knots = list(spline.bezier_points)
    if spline.use_cyclic_u:
        knots.append(knots[0])
    points = [knots[0].co]
    for a, b in zip(knots, knots[1:]):
        points += interpolate_bezier(a.co, a.handle_right, b.handle_left, b.co, spline.resolution_u + 1)[1:]
    return points


def _curve_strokes(curve) -> list:
    strokes = []
    for spline in curve.splines:
        if spline.type == "BEZIER":
            strokes.append(_bezier_points(spline))
        else:  # the control points of NURBS: their polygon leads the same way
            points = [point.co.to_3d() for point in spline.points]
            strokes.append(points + points[:1] if spline.use_cyclic_u else points)
    return strokes


def _layer_strokes(layer) -> list:
    """What a layer of grease pencil shows now."""
    now = bpy.context.scene.frame_current
    frame = max((f for f in layer.frames if f.frame_number <= now), key=lambda f: f.frame_number, default=None)
    if frame is None:
        return []
    if hasattr(frame, "drawing"):  # from 4.3 on
        return [[layer.matrix_local @ p.position for p in stroke.points] for stroke in frame.drawing.strokes]
    return [[layer.matrix_layer @ p.co for p in stroke.points] for stroke in frame.strokes]


def strokes_of(obj, frame: Frame) -> list:
    """The lines of a curve or of grease pencil, as polylines in the coat's axes."""
    if obj.type == "CURVE":
        lines = _curve_strokes(obj.data)
    elif obj.type == "CURVES":
        lines = [[point.position for point in curve.points] for curve in obj.data.curves]
    else:
        lines = [stroke for layer in obj.data.layers if not layer.hide for stroke in _layer_strokes(layer)]
    lines = [np.array([obj.matrix_world @ Vector(point) for point in line]) for line in lines if len(line) > 1]
    if not lines:
        raise Failure(f"\"{obj.name}\" has no line of two points or more, to take directions from")
    return [frame.world_points(line).tolist() for line in lines]


def input_unit(scene):
    """The program's word for what one unit of the scene is, or None where it has none."""
    settings = scene.unit_settings
    units = {1e-6: "um", 0.001: "mm", 0.01: "cm", 0.0254: "in", 0.3048: "ft", 1.0: "m", 1000.0: "km"}
    if settings.system == "NONE":
        return None
    return next((name for metres, name in units.items() if abs(settings.scale_length / metres - 1) < 1e-5), None)


def is_mesh(obj) -> bool:
    """Whether the object is one that a coat can grow on."""
    return obj is not None and obj.type == "MESH"


def find(name: str):
    """An object by its name: references do not outlive an undo."""
    return bpy.data.objects.get(name)

"""A coat on an object: what is sent to the program, and what is done with its answer."""
import math
import os
import shutil

import bpy

from . import catalogue, figure, ply, recipe_text, results
from .process import Failure, Job


def _value(obj, text: str, low: float, high: float) -> str:
    """A map as a formula: of a group or an attribute the values at 0 and 1, or the formula that it is."""
    if text not in figure.readable_names(obj):
        return text
    return f"{low:.9g} + {high - low:.9g}*attribute({recipe_text.formula_name(text)})"


def _truth(obj, text: str) -> str:
    if text not in figure.readable_names(obj):
        return text
    return f"attribute({recipe_text.formula_name(text)}) > 0.5"


def _change_recipe(obj, coat, frame, notes: list) -> str:
    """The coat's recipe with the object's maps, mask and strokes."""
    settings, text = obj.pelage, recipe_text.without_form(coat.text)
    if settings.size_map:
        text = recipe_text.with_size_map(text, _value(obj, settings.size_map, settings.size_at_0, settings.size_at_1))
    if settings.mask:
        text, joined = recipe_text.with_mask(text, _truth(obj, settings.mask), settings.inside)
        notes += [f"Stage {name} has a mask of its own, which the object's mask joins: there its inside is as the coat "
                  "has it" for name in joined]
    if settings.strokes:
        stages = [k for k in range(len(coat.stages)) if coat.follows_directions(k)]
        if not stages:
            notes.append(f"The coat {coat.name} follows no directions: the strokes of \"{settings.strokes.name}\" are "
                         "not used")
        strokes = figure.strokes_of(settings.strokes, frame)
        for k in stages:
            text = recipe_text.with_strokes(text, k, strokes)
    return text


def _parameter_words(obj) -> list:
    words = []
    for parameter in obj.pelage.parameters:
        name = f"{parameter.stage}.{parameter.name}"
        if parameter.map:
            words += ["--param-map", f"{name}={_value(obj, parameter.map, parameter['value'], parameter.at_one)}"]
        elif parameter.is_set():
            words += ["--set", f"{name}={parameter['value']:.9g}"]
    return words


def _look_words(settings, creases: bool) -> list:
    words = ["--crease", f"{math.degrees(settings.crease):.9g}"] if creases else []
    return words + (["--material", f"height={settings.height}"] if settings.height else [])


def _pattern_words(context, obj, creases: bool) -> list:
    settings = obj.pelage
    words = ["--seed", str(settings.seed), "--quality", settings.quality]
    if settings.size > 0:
        words += ["--size", f"{settings.size:.9g}u"]
    if unit := figure.input_unit(context.scene):
        words += ["--input-unit", unit]
    return words + _parameter_words(obj) + _look_words(settings, creases)


class Growth:
    """From the moment that it is asked for to the coat in the scene."""

    def __init__(self, context, obj):
        self.name, self.notes, self.job = obj.name, [], Job()
        try:
            self._begin(context, obj)
        except BaseException:
            self.job.close()
            raise

    def _begin(self, context, obj):
        settings = obj.pelage
        self.result, self.modifiers, self.displace = settings.result, settings.modifiers, settings.displace  # of now
        coat = catalogue.Coat(settings)
        self.solid = recipe_text.is_solid(coat.text)
        if self.solid and self.result == "IMAGES":
            raise Failure(f"The coat {coat.name} grows in the volume, which has no images: choose another result")
        self.frame = figure.Frame(obj, settings.front, settings.up)
        text = _change_recipe(obj, coat, self.frame, self.notes)
        self.evaluated = self.modifiers != "IGNORE" and any(m.show_viewport for m in obj.modifiers)
        wanted = recipe_text.attributes_in(text, settings.height, *_parameter_words(obj))
        brought = ["uv", *recipe_text.painted_names(text)]
        wanted = {one for one in wanted if not any(recipe_text.is_part_of(one, name) for name in brought)}
        with figure.shown_mesh(context, obj, self.evaluated) as mesh:
            self._check(obj, mesh)
            self._write(obj, mesh, wanted)
        with open(os.path.join(self.job.folder, "coat.toml"), "w", encoding="utf-8") as file:
            file.write(text)
        for name in coat.files():
            target = os.path.join(self.job.folder, name)
            os.makedirs(os.path.dirname(target), exist_ok=True)
            shutil.copyfile(os.path.join(coat.folder, name), target)
        self.job.start(*self._commands(context, obj, coat.catalogue.path))

    def _check(self, obj, mesh):
        """What cannot be done is said before anything grows."""
        if not mesh.polygons:
            raise Failure(f"\"{obj.name}\" has no faces")
        if self.modifiers == "SHOWN" and len(mesh.vertices) != len(obj.data.vertices) and self.result == "VERTICES":
            raise Failure("The modifiers make other vertices than the object's own, which cannot keep the coat: choose "
                          "Images or a New Mesh, or leave the modifiers out or apply them")
        self.needs_uv = self.result == "IMAGES" and not mesh.uv_layers
        if self.needs_uv and self.modifiers == "SHOWN" and self.evaluated:
            raise Failure("The mesh has no uv for images, and cannot get one while it has modifiers: unwrap it, or "
                          "leave the modifiers out or apply them")

    def _write(self, obj, mesh, wanted: set):
        self.uv = ""
        if self.result == "IMAGES" and mesh.uv_layers:
            self.uv = mesh.uv_layers.active.name
        polygons = figure.polygons(mesh, self.frame, self.uv)
        if self.uv and figure.tiles(polygons) > 1:
            raise Failure(f"The uv \"{self.uv}\" lies in several tiles (UDIM), which the add-on does not load: move it "
                          "into one, or let pelage grow --maps write the images")
        polygons.columns, notes = figure.painted(obj, mesh, wanted)
        self.creases = not self.solid and 0 < obj.pelage.crease < figure.sharpest_bend(polygons)
        there = {column.lower() for column in polygons.columns}
        self._require(obj, {one for one in wanted if one.lower() not in there})
        self.sent = set(polygons.columns)
        self.notes += notes
        ply.write(os.path.join(self.job.folder, "figure.ply"), polygons)

    @staticmethod
    def _require(obj, missing: set):
        """The program knows only what it is sent; its word for what is missing would not fit here."""
        if missing:
            known = ", ".join(recipe_text.formula_name(name) for name in figure.readable_names(obj))
            raise Failure(f"Formulas read attribute({min(missing)}), and \"{obj.name}\" has no such vertex group or "
                          f"attribute; it has: {known or 'none'}")

    def _commands(self, context, obj, program: str) -> list:
        settings, shape, commands = obj.pelage, "figure.ply", []
        if self.needs_uv:
            shape = "unwrapped.ply"
            commands.append([program, "unwrap", "figure.ply", "-o", shape, "--resolution", str(settings.pixels)])
        form = {"VERTICES": ["--keep-shape", "-o", "coat.ply"], "MESH": ["-o", "coat.ply"],
                "IMAGES": ["--bake", str(settings.pixels), "--maps", "coat"]}[self.result]
        words = [*_pattern_words(context, obj, self.creases), *form, "--json"]
        return [*commands, [program, "grow", shape, "--recipe", "coat.toml", *words]]

    def finish(self, context) -> dict:
        """Puts the coat into the scene, and what there is to say into the object's settings."""
        told = self.job.result()
        obj = figure.find(self.name)
        if not figure.is_mesh(obj):
            raise Failure(f"\"{self.name}\" is no longer there, so its coat is dropped")
        was_edited = obj.mode == "EDIT"
        if was_edited:
            bpy.ops.object.mode_set(mode="OBJECT")
        if self.modifiers == "APPLY" and self.evaluated:
            self._apply_modifiers(context, obj)
        self._deliver(obj, told)
        if was_edited:
            bpy.ops.object.mode_set(mode="EDIT")
        self._tell(obj.pelage, told)
        return told

    def _apply_modifiers(self, context, obj):
        """Those that are shown; hidden ones stay."""
        graph = context.evaluated_depsgraph_get()
        applied = bpy.data.meshes.new_from_object(obj.evaluated_get(graph), preserve_all_data_layers=True,
                                                  depsgraph=graph)
        name = obj.data.name
        if obj.data.shape_keys:
            self.notes.append("The shape keys are applied with the modifiers, and are gone")
        obj.data = applied
        applied.name = name
        for modifier in [m for m in obj.modifiers if m.show_viewport]:
            obj.modifiers.remove(modifier)

    def _deliver(self, obj, told: dict):
        path = os.path.join(self.job.folder, "coat.ply")
        if self.result == "IMAGES":
            uv = self._make_uv(obj) if self.needs_uv else self.uv
            self.notes += results.as_images(obj, self.job.folder, told["files"], uv, self.displace)
        elif self.result == "MESH":
            beside, notes = results.new_mesh(obj, path, self.frame, self.displace)
            self.notes += [f"The coat is the object \"{beside.name}\"", *notes]
        else:
            self.notes += results.on_vertices(obj, path, self.sent, self.displace)

    def _make_uv(self, obj) -> str:
        atlas = ply.read(os.path.join(self.job.folder, "unwrapped.ply"))
        if len(atlas.corners) != len(obj.data.loops):
            raise Failure(f"\"{obj.name}\" was changed while its coat grew")
        uv = results.set_uv(obj.data, atlas.corner_lists["texcoord"], self.frame.mirrored)
        self.notes.append(f"The mesh had no uv and has got an atlas, the uv map \"{uv}\"")
        return uv

    def _tell(self, settings, told: dict):
        settings.messages.clear()
        for stage in told["stages"]:
            spacing = stage["size"] if stage["size_known"] else stage["length_unit"]
            kind = "spacing" if stage["size_known"] else "unit"
            name = f"{stage['name']}, " if len(told["stages"]) > 1 else ""
            settings.say("INFO", f"{name}{stage['model']}: {kind} {length(spacing)}"
                         + (f", along {stage['follows']}" if stage.get("follows") else ""))
        for finding in told["shape"]["findings"]:
            settings.say("INFO", finding["text"])
        for note in self.notes:
            settings.say("INFO", note)
        for warning in told.get("warnings", []):
            settings.say("WARNING", in_blender(warning))


def in_blender(text: str) -> str:
    """What the program advises, in the words of the panel."""
    for words, here in (("--flat instead of --keep-shape splits its triangles",
                         "subdivide the mesh, or choose Images or a New Mesh"), ("--bake", "Pixels")):
        text = text.replace(words, here)
    return text


def length(value: float) -> str:
    """A length of the scene in the scene's words."""
    unit = bpy.context.scene.unit_settings
    if unit.system == "NONE":
        return f"{value:.4g}"
    return bpy.utils.units.to_string(unit.system, "LENGTH", value * unit.scale_length, precision=4,
                                     split_unit=unit.use_separate)


class Fairing:
    """The noise off an object's mesh."""

    def __init__(self, context, obj, noise: float):
        if obj.data.shape_keys:
            raise Failure("Fairing moves the mesh and would leave its shape keys behind: apply or remove them first")
        self.name, self.job = obj.name, Job()
        try:
            self.frame = figure.Frame(obj, "X", "Z")
            ply.write(os.path.join(self.job.folder, "figure.ply"), figure.polygons(obj.data, self.frame, ""))
            words = ["--noise", f"{noise:.9g}"] if noise > 0 else []
            self.job.start([catalogue.program(), "fair", "figure.ply", "-o", "fair.ply", "--json", *words])
            self.job.task = "fairing"
        except BaseException:
            self.job.close()
            raise

    def finish(self, _context) -> dict:
        """Moves the vertices, and tells what was done."""
        told = self.job.result()
        obj = figure.find(self.name)
        if not figure.is_mesh(obj):
            raise Failure(f"\"{self.name}\" is no longer there")
        was_edited = obj.mode == "EDIT"
        if was_edited:
            bpy.ops.object.mode_set(mode="OBJECT")
        results.set_places(obj, os.path.join(self.job.folder, "fair.ply"), self.frame)
        if was_edited:
            bpy.ops.object.mode_set(mode="EDIT")
        settings = obj.pelage
        settings.messages.clear()
        settings.say("INFO", f"Noise of {told['noise_edges']:.3g} mean edges; moved by {told['moved_edges']:.3g}, in "
                     f"{told['steps']} steps")
        for finding in told["findings"]:
            settings.say("INFO", finding["text"])
        for warning in told.get("warnings") or []:
            settings.say("WARNING", warning)
        return told

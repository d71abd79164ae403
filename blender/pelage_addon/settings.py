"""What a user sets, kept with the object, so that a saved coat can be grown again."""
import math

import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty,
                       StringProperty)

from . import catalogue, figure, recipe_text
from .process import Failure

_AXES = [(name, name, f"The object's own {name} axis") for name in figure.AXES]
_MAP_HELP = "A vertex group or an attribute, by its name, or a formula as attribute(tail_1) + 0.5*bx"


def _search_names(settings, context, _):
    obj = settings.id_data
    return figure.readable_names(obj) if figure.is_mesh(obj) else []


def _choose(settings, index):
    settings.coat = catalogue.items()[index][0]


def _chosen(settings):
    return next((k for k, item in enumerate(catalogue.items()) if item[0] == settings.coat), 0)


def fill_parameters(settings, _context=None):
    """Those of the coat's models, with their ranges; what was set for another coat is left behind."""
    settings.parameters.clear()
    try:
        coat = catalogue.Coat(settings)
        models = [coat.model_of(k) for k in range(len(coat.stages))]
    except Failure:
        return  # the panel says what is wrong
    for k, (stage, model) in enumerate(zip(coat.stages, models)):
        given = recipe_text.stage_group(coat.text, k, "parameters")
        for described in model["parameters"] if model else []:
            settings.parameters.add().describe(stage, described, given.get(described["name"]))


class Parameter(bpy.types.PropertyGroup):
    """A parameter of a stage's model; its value is ["value"], which has the model's own range."""
    stage: StringProperty()
    usual: FloatProperty(precision=6)
    map: StringProperty(name="Map", description=_MAP_HELP, search=_search_names)
    at_one: FloatProperty(name="At 1", description="The parameter where the group or attribute is 1; where it is 0, "
                                                   "the value beside the name holds")

    def describe(self, stage: str, described: dict, given):
        """From the program's description, and what the recipe says instead of the model."""
        self.name, self.stage = described["name"], stage
        value = described["value"]
        try:
            value = float(given) if given else value
        except ValueError:
            self.map = given  # a formula
        self["value"] = self.at_one = self.usual = float(value)
        limits = {key: float(described[key]) for key in ("min", "max") if described[key] is not None}
        unit = f" [{described['unit']}]" if described["unit"] not in ("", "1") else ""
        self.id_properties_ui("value").update(description=described["help"] + unit, default=float(value), precision=4,
                                              **limits)

    def is_set(self) -> bool:
        """Whether it says something else than the coat does."""
        return abs(self["value"] - self.usual) > 1e-6 * max(1e-3, abs(self.usual))


class Message(bpy.types.PropertyGroup):
    """A line that the last run had to say."""
    kind: StringProperty()


class Settings(bpy.types.PropertyGroup):
    """Of one object."""
    coat: StringProperty(name="Coat", default="recipe:leopard", update=fill_parameters,
                         description="recipe:NAME or model:NAME, of those that the program knows")
    choice: EnumProperty(name="Coat", items=lambda self, context: catalogue.items(), get=_chosen, set=_choose,
                         options={"SKIP_SAVE"}, description="The coat to grow")
    file: StringProperty(name="Own File", subtype="FILE_PATH", update=fill_parameters,
                         description="A recipe or a model of your own (.toml), instead of the coat above")
    size: FloatProperty(name="Size", subtype="DISTANCE", unit="LENGTH", min=0, soft_min=0, precision=4,
                        description="Spacing of the pattern, of a coat with several stages that of the first one; the "
                                    "object's scale counts. 0: as the coat has it, for the object's size")
    seed: IntProperty(name="Seed", default=1, min=0, description="Number of the random pattern")
    quality: EnumProperty(name="Quality", default="normal", items=[
        ("draft", "Draft", "At once"), ("normal", "Normal", "As good as a picture shows"),
        ("fine", "Fine", "For measurements")])
    front: EnumProperty(name="Front", default="-Y", items=_AXES,
                        description="Where the figure looks: x of formulas, which recipes with haunches need")
    up: EnumProperty(name="Up", default="Z", items=_AXES, description="Its upper side: y of formulas")
    crease: FloatProperty(name="Sharp Edges", subtype="ANGLE", min=0, max=math.pi, default=math.radians(30),
                          description="Edges that bend by more than this angle are sharp for the coat, too; elsewhere, "
                                      "and with 0 everywhere, it grows on the smooth surface that the mesh stands for")
    modifiers: EnumProperty(name="Modifiers", default="SHOWN", items=[
        ("SHOWN", "As Shown", "The coat grows on what the modifiers make of the mesh, and they stay as they are"),
        ("IGNORE", "Left Out", "The coat grows on the mesh without them; they then carry it on"),
        ("APPLY", "Apply", "The modifiers are applied first, and are gone afterwards")])
    result: EnumProperty(name="Result", default="VERTICES", items=[
        ("VERTICES", "On Vertices", "A colour attribute, and attributes for geometry nodes, on the object's vertices"),
        ("IMAGES", "Images", "Images on the object's uv, of colour, and of relief and gloss where the coat has such"),
        ("MESH", "New Mesh", "A finer mesh of its own beside the object, with attributes")])
    pixels: IntProperty(name="Pixels", default=2048, min=16, max=16384, description="Along a side of the images")
    height: StringProperty(name="Height", description="Relief of the coat as a formula of its species, in spacings of "
                           "the pattern: 0.1*smoothstep(3.4, 2.4, b); empty: as the coat has it")
    displace: BoolProperty(name="Displace", description="The height moves the surface in renderers; otherwise a "
                           "normal map shows it")
    size_map: StringProperty(name="Size Map", description=_MAP_HELP + ". A factor on the size", search=_search_names)
    size_at_0: FloatProperty(name="At 0", default=1, min=0.01, soft_max=10,
                             description="Factor on the size where the group or attribute is 0")
    size_at_1: FloatProperty(name="At 1", default=2, min=0.01, soft_max=10,
                             description="Factor on the size where the group or attribute is 1")
    mask: StringProperty(name="Mask", description=_MAP_HELP + ". It masks where it is above one half, or true",
                         search=_search_names)
    inside: EnumProperty(name="In the Mask", default="excluded", items=[
        ("excluded", "Nothing Grows", "Nothing reacts and diffuses there, and nothing passes the border"),
        ("frozen", "As at the Start", "Concentrations stay what they are at the start, and diffuse outward")])
    strokes: PointerProperty(name="Directions", type=bpy.types.Object,
                             poll=lambda self, obj: obj.type in figure.STROKE_TYPES,
                             description="Curves or grease pencil strokes along which the coat's stripes run, for "
                                         "coats that follow directions")
    parameters: CollectionProperty(type=Parameter)
    messages: CollectionProperty(type=Message)

    def say(self, kind: str, text: str):
        """A line for the panel: INFO, WARNING or ERROR."""
        message = self.messages.add()
        message.kind, message.name = kind, text


CLASSES = (Parameter, Message, Settings)


def register():
    """On every object."""
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Object.pelage = PointerProperty(type=Settings)


def unregister():
    """Settings stay in files that hold them."""
    del bpy.types.Object.pelage
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)

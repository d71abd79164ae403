"""What the program can grow, asked from the program itself, with pictures."""
import json
import os
import shutil

import bpy
import bpy.utils.previews

from . import recipe_text
from .process import Failure, answer

PICTURES = os.path.join(os.path.dirname(__file__), "pictures")


def program() -> str:
    """The program's path: that of the preferences, or what the system finds by its name."""
    addon = bpy.context.preferences.addons.get(__package__)
    asked = bpy.path.abspath(addon.preferences.program) if addon and addon.preferences.program else "pelage"
    found = shutil.which(asked)
    if not found:
        raise Failure(f"The program \"{asked}\" is not there: say where pelage is in the add-on's preferences")
    return found


class Catalogue:
    """Recipes and models of one program."""

    def __init__(self, path: str):
        self.path = path
        self.models = {model["name"]: model for model in json.loads(answer(path, "models", "--json"))}
        self.recipes = {recipe["name"]: recipe for recipe in json.loads(answer(path, "recipes", "--json"))}
        self._texts = {}

    def coats(self) -> list:
        """(key, label, what it is) of all recipes, then of all models."""
        recipes = [(f"recipe:{name}", name, recipe["summary"]) for name, recipe in self.recipes.items()]
        return recipes + [(f"model:{name}", f"{name} (model)", model["title"]) for name, model in self.models.items()]

    def text(self, key: str) -> str:
        """The recipe that a coat is."""
        kind, _, name = key.partition(":")
        if kind == "model":
            return f"[stage]\nmodel = {recipe_text.quoted(name)}\n"
        if name not in self.recipes:
            raise Failure(f"This pelage has no recipe \"{name}\": choose another coat")
        if name not in self._texts:
            self._texts[name] = answer(self.path, "recipes", name)
        return self._texts[name]

    def model(self, name: str, folder: str):
        """What is known of a model of a stage, one of a file included; None of those that a recipe holds as a text."""
        if name in self.models or ".toml" not in name:
            return self.models.get(name)
        path = os.path.join(folder, name)
        key = path, os.stat(path).st_mtime if os.path.exists(path) else 0
        if key not in self._texts:
            self._texts[key] = json.loads(answer(self.path, "models", path, "--json"))[0]
        return self._texts[key]


class Coat:
    """One coat: the text of its recipe, the folder that it may name files in, and the models of its stages."""

    def __init__(self, settings):
        self.catalogue = catalogue()
        self.folder, self.name = "", settings.coat
        if settings.file:
            self.text = self._read(bpy.path.abspath(settings.file))
        else:
            self.text = self.catalogue.text(settings.coat)
        self.stages = recipe_text.stage_names(self.text)

    def _read(self, path: str) -> str:
        """Of a recipe its text; of a model a recipe that grows it."""
        self.folder, self.name = os.path.split(path)
        try:
            with open(path, encoding="utf-8") as file:
                text = file.read()
        except (OSError, UnicodeDecodeError) as error:
            raise Failure(f"{path} cannot be read: {getattr(error, 'strerror', None) or error}") from error
        return text if recipe_text.stages(text) else f"[stage]\nmodel = {recipe_text.quoted(self.name)}\n"

    def model_of(self, stage: int):
        """What the program says of the model of that stage, or None."""
        return self.catalogue.model(recipe_text.stage_value(self.text, stage, "model") or "", self.folder)

    def follows_directions(self, stage: int) -> bool:
        """Whether directions do anything there; of a model that nobody knows they may."""
        model = self.model_of(stage)
        return model is None or any(species["anisotropy"] for species in model["species"])

    def files(self) -> list:
        """What the recipe names beside itself, as far as it is there and in its folder."""
        named = recipe_text.files_named(self.text) if self.folder else []
        inside = [name for name in named if not os.path.isabs(name) and ".." not in name.split("/")]
        return [name for name in inside if os.path.isfile(os.path.join(self.folder, name))]


_known = {}


def catalogue() -> Catalogue:
    """Of the program that is set, asked once for each version of it."""
    path = program()
    key = path, os.stat(path).st_mtime
    if key not in _known:
        _known.clear()
        _known[key] = Catalogue(path)
    return _known[key]


def known() -> bool:
    """Whether `catalogue` answers at once."""
    path = program()
    return (path, os.stat(path).st_mtime) in _known


# --- pictures ----------------------------------------------------------------------------------------------------

_previews = None
_items = []  # Blender keeps no copy of the strings


def picture(key: str) -> int:
    """The number of a coat's icon, or 0."""
    global _previews
    kind, _, name = key.partition(":")
    path = os.path.join(PICTURES, kind + "s", name.replace(":", "-") + ".png")
    if not os.path.exists(path):
        return 0
    if _previews is None:
        _previews = bpy.utils.previews.new()
    if key not in _previews:
        _previews.load(key, path, "IMAGE")
    return _previews[key].icon_id


def items() -> list:
    """All coats for a menu of pictures; without the program none."""
    try:
        coats = catalogue().coats()
    except Failure:
        return []
    if len(_items) != len(coats) or any(item[0] != coat[0] for item, coat in zip(_items, coats)):
        _items[:] = [(key, label, about, picture(key), k) for k, (key, label, about) in enumerate(coats)]
    return _items


def forget():
    """At the end of the add-on."""
    global _previews
    if _previews is not None:
        bpy.utils.previews.remove(_previews)
    _previews = None
    _known.clear()
    _items.clear()

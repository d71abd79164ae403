"""Grows reaction-diffusion coats on meshes, by the program pelage."""
import bpy
from bpy.app.handlers import persistent
from bpy.props import StringProperty

from . import catalogue, operators, panel, settings

bl_info = {
    "name": "Pelage",
    "author": "The authors of Pelage",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Pelage",
    "description": "Grows coats of animals, and other patterns of reaction and diffusion, on meshes",
    "category": "Object",
}


class PelagePreferences(bpy.types.AddonPreferences):
    """Where the program is."""
    bl_idname = __package__

    program: StringProperty(name="Program", subtype="FILE_PATH",
                            description="The program pelage; empty: the one that the system finds by its name")

    def draw(self, _context):
        """One line."""
        self.layout.prop(self, "program")


@persistent
def _before_file(*_):
    operators.stop()


_CLASSES = (PelagePreferences, *operators.CLASSES, *panel.CLASSES)


def register():
    """All that Blender is to know."""
    settings.register()
    for one in _CLASSES:
        bpy.utils.register_class(one)
    bpy.app.handlers.load_pre.append(_before_file)


def unregister():
    """Nothing goes on, and nothing stays."""
    operators.stop()
    bpy.app.handlers.load_pre.remove(_before_file)
    for one in reversed(_CLASSES):
        bpy.utils.unregister_class(one)
    settings.unregister()
    catalogue.forget()

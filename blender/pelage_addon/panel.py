"""The tab "Pelage" in the sidebar of the 3D view."""
import bpy

from . import catalogue, figure, growth, operators, recipe_text
from .process import Failure

_ICONS = {"INFO": "INFO", "WARNING": "ERROR", "ERROR": "CANCEL"}
_LETTER = 7  # about the width of one, in pixels


def _lines(layout, context, text: str, icon: str):
    """A text that goes on in further lines where the sidebar ends."""
    room = max(20, int(context.region.width / (_LETTER * context.preferences.system.ui_scale)) - 8)
    column, line = layout.column(align=True), ""
    column.scale_y = 0.75
    for word in text.split():
        if line and len(line) + len(word) >= room:
            column.label(text=line, icon=icon)
            line, icon = "", "BLANK1"
        line += ("" if not line else " ") + word
    column.label(text=line, icon=icon)


class _Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Pelage"


class _Part(_Panel):
    """A part of the main panel, for meshes and with the program at hand."""
    bl_parent_id = "PELAGE_PT_coat"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        try:
            return figure.is_mesh(context.active_object) and catalogue.known()
        except Failure:
            return False


def _look_for_program():
    """Once, when the window is idle: the panel then has its menu."""
    try:
        catalogue.catalogue()
    except Failure:
        pass  # the panel says so
    operators.redraw(bpy.context)


def _draw_missing(layout, context, failure):
    _lines(layout, context, str(failure), "ERROR")
    layout.operator("preferences.addon_show", text="Open Preferences").module = __package__


def _draw_progress(layout, context, work):
    job = work.job
    text = f"{work.name}: {job.task}" + (f", {job.left} left" if job.left else "")
    if hasattr(layout, "progress"):  # from 4.0 on
        layout.progress(factor=job.fraction, text=text)
    else:
        _lines(layout, context, f"{text}, {round(100 * job.fraction)} %", "SORTTIME")
    layout.operator("pelage.cancel", icon="CANCEL")


def _size_in_words(obj) -> str:
    """The spacing beside the object."""
    settings, diagonal = obj.pelage, obj.dimensions.length
    size = settings.size
    if not size:
        share = None if settings.file else recipe_text.size_of(catalogue.Coat(settings).text)
        size = (share or 0.04) * diagonal if not settings.file else 0
    if not size or not diagonal:
        return ""
    across = max(obj.dimensions) / size
    return f"{growth.length(size)}: {across:.3g} along the longest side of {growth.length(max(obj.dimensions))}"


class PELAGE_PT_coat(_Panel, bpy.types.Panel):
    """Coat, size, and the button that grows it."""
    bl_label = "Coat"

    def draw(self, context):
        layout, obj = self.layout, context.active_object
        layout.use_property_split, layout.use_property_decorate = True, False
        try:
            if not catalogue.known():
                layout.label(text="Asking pelage for its coats ...")
                if not bpy.app.timers.is_registered(_look_for_program):
                    bpy.app.timers.register(_look_for_program, first_interval=0.05)
                return
        except Failure as failure:
            return _draw_missing(layout, context, failure)
        if not figure.is_mesh(obj):
            _lines(layout, context, "Make a mesh the active object", "INFO")
        else:
            self._draw_settings(layout, context, obj)
        if operators.current():
            _draw_progress(layout, context, operators.current())
        elif figure.is_mesh(obj):
            layout.operator("pelage.grow", icon="BRUSHES_ALL")
            for message in obj.pelage.messages:
                _lines(layout, context, message.name, _ICONS[message.kind])

    @staticmethod
    def _draw_settings(layout, context, obj):
        settings = obj.pelage
        if not settings.file:
            layout.template_icon_view(settings, "choice", show_labels=True, scale=7, scale_popup=5)
            layout.prop(settings, "choice", text="Coat")
        layout.prop(settings, "file")
        layout.prop(settings, "size")
        try:
            if words := _size_in_words(obj):
                _lines(layout, context, words, "DRIVER_DISTANCE")
        except Failure as failure:
            _lines(layout, context, str(failure), "ERROR")
        layout.prop(settings, "seed")
        layout.prop(settings, "quality")
        layout.prop(settings, "result")
        if settings.result == "IMAGES":
            layout.prop(settings, "pixels")
        layout.prop(settings, "modifiers")


class PELAGE_PT_maps(_Part, bpy.types.Panel):
    """What is painted and drawn, and what it does."""
    bl_label = "Maps and Directions"

    def draw(self, context):
        layout, settings = self.layout, context.active_object.pelage
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(settings, "size_map")
        if settings.size_map in figure.readable_names(context.active_object):
            layout.prop(settings, "size_at_0")
            layout.prop(settings, "size_at_1")
        layout.prop(settings, "mask")
        if settings.mask:
            layout.prop(settings, "inside")
        layout.prop(settings, "strokes")


class PELAGE_PT_parameters(_Part, bpy.types.Panel):
    """Those of the models, with their ranges."""
    bl_label = "Parameters"

    def draw(self, context):
        layout, settings = self.layout, context.active_object.pelage
        layout.use_property_split, layout.use_property_decorate = True, False
        names = figure.readable_names(context.active_object)
        stage, several = "", len({parameter.stage for parameter in settings.parameters}) > 1
        for parameter in settings.parameters:
            if several and parameter.stage != stage:
                stage = parameter.stage
                layout.label(text=stage)
            layout.prop(parameter, '["value"]', text=parameter.name)
            layout.prop(parameter, "map")
            if parameter.map in names:
                layout.prop(parameter, "at_one")
        layout.operator("pelage.parameters", icon="LOOP_BACK")


class PELAGE_PT_figure(_Part, bpy.types.Panel):
    """How the object stands, its edges, and its relief."""
    bl_label = "Figure and Relief"

    def draw(self, context):
        layout, settings = self.layout, context.active_object.pelage
        layout.use_property_split, layout.use_property_decorate = True, False
        layout.prop(settings, "front")
        layout.prop(settings, "up")
        layout.prop(settings, "crease")
        layout.prop(settings, "height")
        layout.prop(settings, "displace")
        layout.operator("pelage.fair", icon="MOD_SMOOTH")


CLASSES = (PELAGE_PT_coat, PELAGE_PT_maps, PELAGE_PT_parameters, PELAGE_PT_figure)

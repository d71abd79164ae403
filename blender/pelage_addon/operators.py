"""What buttons and scripts call: grow, cancel, fair, and the coat's own parameters."""
import time

import bpy
from bpy.props import FloatProperty

from . import catalogue, figure, settings as object_settings
from .growth import Fairing, Growth, in_blender
from .process import Failure

_SECONDS_BETWEEN_LOOKS = 0.1
_current = None  # the operator whose program is running


def current():
    """What is being done now, as Growth or Fairing; None if nothing is."""
    return _current


def stop():
    """At the end of the add-on, of the file or of Blender: the program ends, its files go."""
    global _current
    if _current:
        _current.job.close()
    _current = None


def redraw(context):
    """The sidebars that show how far it is."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def _hindrance(obj) -> str:
    """Why nothing can be begun on the object; empty where it can."""
    if _current:
        return f"The program is at work on \"{_current.name}\""
    if not figure.is_mesh(obj):
        return "Make a mesh the active object"
    if obj.library or obj.data.library:
        return "The mesh is linked from another file: make it local first"
    return "Leave Edit Mode first" if obj.mode == "EDIT" else ""


class _Run:
    """Of operators that let the program work: a user goes on meanwhile, a script waits."""

    @classmethod
    def poll(cls, context):
        hindrance = _hindrance(context.active_object)
        if hindrance:
            cls.poll_message_set(hindrance)
        return not hindrance

    def _start(self, context):
        global _current
        obj = context.active_object
        obj.pelage.messages.clear()
        try:
            _current = self.begin(context, obj)
        except Failure as failure:
            self._fail(obj, failure)
        return _current is not None

    def _fail(self, obj, failure):
        if obj:
            obj.pelage.say("ERROR", str(failure))
        self.report({"ERROR"}, str(failure))

    def _end(self, context):
        """What came of it."""
        work = _current
        try:
            told = work.finish(context)
            for warning in told.get("warnings") or []:
                self.report({"WARNING"}, in_blender(warning))
            return {"FINISHED"}
        except Failure as failure:
            if not work.job.cancelled:
                self._fail(figure.find(work.name), failure)
            return {"CANCELLED"}
        finally:
            stop()
            redraw(context)

    def execute(self, context):
        """For scripts: until it is done."""
        if not self._start(context):
            return {"CANCELLED"}
        try:
            while _current.job.running():
                time.sleep(0.02)
        except BaseException:
            stop()
            raise
        return self._end(context)

    def invoke(self, context, _event):
        """In the background of the window."""
        if not self._start(context):
            return {"CANCELLED"}
        self._timer = context.window_manager.event_timer_add(_SECONDS_BETWEEN_LOOKS, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """All events but the timer's are for others."""
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        if _current and _current.job.running():
            redraw(context)
            return {"PASS_THROUGH"}
        context.window_manager.event_timer_remove(self._timer)
        return self._end(context) if _current else {"CANCELLED"}

    def cancel(self, context):
        """The window or the file is closed."""
        context.window_manager.event_timer_remove(self._timer)
        stop()


class PELAGE_OT_grow(_Run, bpy.types.Operator):
    """Grow the coat on the active object, with the settings that it has"""
    bl_idname = "pelage.grow"
    bl_label = "Grow Coat"
    bl_options = {"UNDO"}

    begin = staticmethod(Growth)


class PELAGE_OT_fair(_Run, bpy.types.Operator):
    """Take the noise off the active object's mesh and keep its edges: its vertices move, all else stays"""
    bl_idname = "pelage.fair"
    bl_label = "Fair Mesh"
    bl_options = {"UNDO"}

    noise: FloatProperty(name="Noise", min=0, max=1, description="Standard deviation of the noise in mean edges; 0: "
                         "estimated")

    def begin(self, context, obj):
        """With the noise that is asked for."""
        return Fairing(context, obj, self.noise)


class PELAGE_OT_cancel(bpy.types.Operator):
    """End the growth; the object stays as it was"""
    bl_idname = "pelage.cancel"
    bl_label = "Cancel"

    @classmethod
    def poll(cls, _context):
        return _current is not None

    def execute(self, _context):
        """The operator that waits for the program finds it ended."""
        _current.job.cancel()
        return {"FINISHED"}


class PELAGE_OT_parameters(bpy.types.Operator):
    """Give all parameters of the coat's models the values that the coat has them at"""
    bl_idname = "pelage.parameters"
    bl_label = "The Coat's Own Parameters"
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context):
        return figure.is_mesh(context.active_object)

    def execute(self, context):
        """Also fills the list of an object whose coat has never been changed."""
        try:
            catalogue.catalogue()
        except Failure as failure:
            self.report({"ERROR"}, str(failure))
            return {"CANCELLED"}
        object_settings.fill_parameters(context.active_object.pelage)
        return {"FINISHED"}


CLASSES = (PELAGE_OT_grow, PELAGE_OT_fair, PELAGE_OT_cancel, PELAGE_OT_parameters)

# blender --factory-startup --python-exit-code 3 -P blender_window.py -- PELAGE ZIP FOLDER
# The add-on in a Blender with a window: its panels draw, a coat grows while the window goes on, is cancelled, undone,
# and ended with the file. Leaves FOLDER/panel.png. Needs a display, and BLENDER_USER_SCRIPTS and BLENDER_USER_CONFIG.
import os
import sys
import tempfile
import time
import traceback

import bpy

PELAGE, ZIP, FOLDER = (os.path.abspath(path) for path in sys.argv[sys.argv.index("--") + 1:][:3])
TEMPORARY = os.path.join(FOLDER, "temporary")
os.makedirs(TEMPORARY, exist_ok=True)
tempfile.tempdir = TEMPORARY
bpy.ops.preferences.addon_install(filepath=ZIP, overwrite=True)
bpy.ops.preferences.addon_enable(module="pelage_addon")
from pelage_addon import catalogue, operators, panel, results  # noqa: E402

MOST_SECONDS = 240
drawn, faults, ticks = {}, [], [0]


def watched(part):
    """Its draw, counted; what goes wrong in it Blender would only print."""
    draw = part.draw

    def draw_and_count(self, context):
        try:
            draw(self, context)
            drawn[part.__name__] = drawn.get(part.__name__, 0) + 1
        except Exception:
            faults.append(traceback.format_exc())
            raise
    return draw_and_count


def into_first_tab():
    """No script chooses a tab, so the panels go into the one that is open, all of them unfolded."""
    for part in reversed(panel.CLASSES):
        bpy.utils.unregister_class(part)
    for part in panel.CLASSES:
        part.bl_category, part.bl_options, part.draw, part.bl_order = "Item", set(), watched(part), 0
        bpy.utils.register_class(part)


def view():
    return next(a for a in bpy.context.window_manager.windows[0].screen.areas if a.type == "VIEW_3D")


def in_view(call, *words, **options):
    region = next(r for r in view().regions if r.type == "WINDOW")
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0], area=view(), region=region):
        return call(*words, **options)


def until(condition, what):
    end = time.time() + MOST_SECONDS
    while not condition():
        assert time.time() < end, f"waited in vain until {what}"
        yield 0.1


def tick():
    ticks[0] += 1
    return 0.05


def nothing_left():
    return operators.current() is None and not os.listdir(TEMPORARY)


def make_figure():
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)
    in_view(bpy.ops.mesh.primitive_ico_sphere_add, subdivisions=6)
    in_view(bpy.ops.object.shade_smooth)
    figure = bpy.context.active_object
    figure.name = "Figure"
    figure.vertex_groups.new(name="Tail")
    return figure


def panels():
    view().spaces[0].show_region_ui = True
    bpy.context.preferences.addons["pelage_addon"].preferences.program = "no such program"
    into_first_tab()
    yield from until(lambda: drawn.get("PELAGE_PT_coat"), "the panel says that the program is missing")
    assert "PELAGE_PT_maps" not in drawn
    bpy.context.preferences.addons["pelage_addon"].preferences.program = PELAGE
    view().tag_redraw()
    figure = bpy.data.objects["Figure"]
    yield from until(catalogue.known, "the panel knows the coats")
    figure.pelage.coat = "recipe:cheetah"
    figure.pelage.size_map, figure.pelage.mask = "Tail", "nz < -0.9"
    view().tag_redraw()
    yield from until(lambda: len(drawn) == len(panel.CLASSES), "all panels are drawn")
    figure.pelage.size_map = figure.pelage.mask = ""


def cancelled():
    figure = bpy.data.objects["Figure"]
    figure.pelage.coat, figure.pelage.size = "recipe:leopard", 0.15
    assert in_view(bpy.ops.pelage.grow, "INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    assert not in_view(bpy.ops.pelage.grow.poll), "two coats at a time"
    tasks, before = set(), ticks[0]
    for pause in until(lambda: "growing" in tasks, "the growth begins"):
        tasks.add(operators.current().job.task.split()[0])
        yield pause
    assert ticks[0] > before + 5, "the window stood still"
    number = operators.current().job._process.pid
    assert in_view(bpy.ops.pelage.cancel) == {"FINISHED"}
    yield from until(nothing_left, "the cancelled growth is gone")
    assert not os.path.exists(f"/proc/{number}") and results.COLOR not in figure.data.attributes
    assert not figure.pelage.messages


def grown_and_undone():
    figure = bpy.data.objects["Figure"]
    figure.pelage.coat, figure.pelage.size, figure.pelage.seed = "model:turing", 0.25, 3
    in_view(bpy.ops.ed.undo_push, message="before")
    assert in_view(bpy.ops.pelage.grow, "INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    figure.pelage.result = "IMAGES"  # for the next time
    yield from until(nothing_left, "the coat has grown")
    figure.pelage.result = "VERTICES"
    assert results.COLOR in figure.data.attributes, [m.name for m in figure.pelage.messages]
    view().spaces[0].shading.color_type = "VERTEX"
    yield 1.0
    in_view(bpy.ops.screen.screenshot, filepath=os.path.join(FOLDER, "panel.png"))
    in_view(bpy.ops.ed.undo)
    assert results.COLOR not in bpy.data.objects["Figure"].data.attributes, "one step does not take it off"
    assert bpy.data.objects["Figure"].pelage.seed == 3, "undo takes more than the coat"
    in_view(bpy.ops.ed.redo)
    assert results.COLOR in bpy.data.objects["Figure"].data.attributes


def edited_meanwhile():
    """A coat that comes while its object is edited is not lost."""
    figure = bpy.data.objects["Figure"]
    figure.pelage.result = "VERTICES"  # redo has brought the other one
    figure.data.attributes.remove(figure.data.attributes[results.COLOR])
    assert in_view(bpy.ops.pelage.grow, "INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    in_view(bpy.ops.object.mode_set, mode="EDIT")
    assert not in_view(bpy.ops.pelage.fair.poll)
    yield from until(nothing_left, "the coat has grown")
    assert figure.mode == "EDIT"
    in_view(bpy.ops.object.mode_set, mode="OBJECT")
    assert results.COLOR in figure.data.attributes, [m.name for m in figure.pelage.messages]


def ended_with_the_file():
    figure = bpy.data.objects["Figure"]
    figure.pelage.quality, figure.pelage.size = "fine", 0.1
    assert in_view(bpy.ops.pelage.grow, "INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield 0.5
    number = operators.current().job._process.pid
    in_view(bpy.ops.wm.read_homefile)
    assert nothing_left() and not os.path.exists(f"/proc/{number}"), "the program goes on without its file"
    yield 0.2


def steps():
    make_figure()
    bpy.app.timers.register(tick, persistent=True)
    yield 0.5
    for part in (panels, cancelled, grown_and_undone, edited_meanwhile, ended_with_the_file):
        yield from part()
        assert not faults, faults[0]
    print(f"ok panels drawn {sum(drawn.values())} times; grown, cancelled, undone and ended", flush=True)


def go_on(todo=steps()):
    try:
        return next(todo)
    except StopIteration:
        code = 0
    except BaseException:
        traceback.print_exc()
        code = 3
    operators.stop()
    sys.stdout.flush()
    os._exit(code)  # Blender's own end would write a recovery file outside of the test's folder


bpy.context.preferences.view.show_splash = False  # it would hide the figure
bpy.app.timers.register(go_on, first_interval=1, persistent=True)

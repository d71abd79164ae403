# blender -b --factory-startup --python-exit-code 3 -P blender_addon.py -- PELAGE ZIP FOLDER
# The add-on in a Blender without windows, from its installation to coats that are measured on the objects. Needs
# BLENDER_USER_SCRIPTS and BLENDER_USER_CONFIG in a folder of the test, as tests/clients/run.sh sets them.
import json
import math
import os
import subprocess
import sys
import tempfile
import time

import bpy
import numpy as np
from mathutils import Vector, noise

PELAGE, ZIP, FOLDER = sys.argv[sys.argv.index("--") + 1:][:3]
PELAGE, ZIP = os.path.abspath(PELAGE), os.path.abspath(ZIP)
os.makedirs(FOLDER, exist_ok=True)
os.chdir(FOLDER)
TEMPORARY = os.path.join(os.getcwd(), "temporary")  # where the add-on makes its folders
os.makedirs(TEMPORARY, exist_ok=True)
tempfile.tempdir = TEMPORARY
told = []


def run(*words):
    done = subprocess.run([PELAGE, *words], capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(words)}: {done.stderr}"
    return done.stdout


def install():
    """From the zip into the test's own folder."""
    scripts = os.path.realpath(os.environ["BLENDER_USER_SCRIPTS"])
    bpy.ops.preferences.addon_install(filepath=ZIP, overwrite=True)
    bpy.ops.preferences.addon_enable(module="pelage_addon")
    import pelage_addon
    assert os.path.realpath(pelage_addon.__file__).startswith(scripts), f"{pelage_addon.__file__} is not in {scripts}"
    return pelage_addon


addon = install()
from pelage_addon import catalogue, figure, growth, operators, ply, process, results  # noqa: E402


# --- what the tests need -----------------------------------------------------------------------------------------
def clear():
    for old in list(bpy.data.objects):
        bpy.data.objects.remove(old)
    bpy.ops.outliner.orphans_purge(do_recursive=True)


def active(obj):
    bpy.ops.object.select_all(action="DESELECT")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj
    bpy.context.view_layer.update()
    return obj


def grid(cells=100, side=2.0):
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=cells, y_subdivisions=cells, size=side)
    return active(bpy.context.object)


def ball(subdivisions=6, radius=1.0):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions, radius=radius)
    return active(bpy.context.object)


def cube(levels=6):
    """Its faces stay flat."""
    bpy.ops.mesh.primitive_cube_add(size=2)
    obj = active(bpy.context.object)
    divide(obj, levels, "SIMPLE")
    bpy.ops.object.modifier_apply(modifier=obj.modifiers[-1].name)
    return obj


def divide(obj, levels, kind="CATMULL_CLARK"):
    modifier = obj.modifiers.new("Divided", "SUBSURF")
    modifier.subdivision_type, modifier.levels, modifier.render_levels = kind, levels, levels
    return modifier


def grow(obj, **settings):
    """With these settings; a new coat first, since its parameters come with it."""
    active(obj)
    if "coat" in settings:
        obj.pelage.coat = settings.pop("coat")
    for name, value in settings.items():
        setattr(obj.pelage, name, value)
    assert bpy.ops.pelage.grow() == {"FINISHED"}
    assert os.listdir(TEMPORARY) == [], f"left behind: {os.listdir(TEMPORARY)}"
    return obj


def refused(obj, part, **settings):
    """Growing fails with these words, in the panel, too, and the mesh stays as it was."""
    before = list(obj.data.attributes.keys())
    try:
        grow(obj, **settings)
    except RuntimeError as error:
        assert part in str(error) and "Traceback" not in str(error), f"{error} instead of ... {part} ..."
        assert any(m.kind == "ERROR" and part in m.name for m in obj.pelage.messages), "the panel does not say it"
        assert list(obj.data.attributes.keys()) == before and os.listdir(TEMPORARY) == []
        return
    raise AssertionError(f"was not refused: {settings}")


def attribute(obj, name):
    return figure.numbers(obj.data.attributes[name].data, "value").astype(np.float64)


def colors(obj):
    """As shown, per vertex."""
    return figure.numbers(obj.data.attributes[results.COLOR].data, "color_srgb", 4)[:, :3].astype(np.float64)


def places(obj):
    """In the scene."""
    local = figure.numbers(obj.data.vertices, "co", 3).astype(np.float64)
    return local @ np.array(obj.matrix_world)[:3, :3].T + np.array(obj.matrix_world)[:3, 3]


def measure(obj, field, where=lambda middle: np.ones(len(middle), bool)):
    """What pelage measure says of the part of the object whose faces' middles are there, in lengths of the scene."""
    points, mesh = places(obj), figure.polygons(obj.data, figure.Frame(obj, "X", "Z"), None)
    first = np.cumsum(mesh.sizes) - mesh.sizes
    assert len(set(mesh.sizes.tolist())) == 1, "faces of one kind only"
    faces = mesh.corners[first[:, None] + np.arange(mesh.sizes[0])]
    faces = faces[where(points[faces].mean(axis=1))]
    used, numbers = np.unique(faces, return_inverse=True)
    part = ply.Mesh(points[used], np.full(len(faces), faces.shape[1]), numbers.reshape(-1).astype(np.int32),
                    {"field": attribute(obj, field)[used]})
    ply.write("part.ply", part)
    return json.loads(run("measure", "part.ply", "--field", "field", "--json"))


def wavelength(obj, field, *where):
    return measure(obj, field, *where)["spectrum"]["wavelength"]


def near(value, wanted, share, what):
    told.append(f"{what} {value:.3g} (asked {wanted:.3g})")
    assert abs(value / wanted - 1) <= share, f"{what}: {value:.4g} instead of {wanted:.4g} within {100 * share:.0f} %"


# --- the rows ----------------------------------------------------------------------------------------------------
def without_program():
    """What is missing is said, with what to do."""
    clear()
    refused(cube(1), "add-on's preferences")
    bpy.context.preferences.addons["pelage_addon"].preferences.program = PELAGE


def coats():
    """The menu is the program's own list, with a picture of each."""
    models = json.loads(run("models", "--json"))
    recipes = json.loads(run("recipes", "--json"))
    keys = [item[0] for item in catalogue.items()]
    assert keys == ["recipe:" + r["name"] for r in recipes] + ["model:" + m["name"] for m in models]
    missing = [k for k in keys if not os.path.exists(os.path.join(
        catalogue.PICTURES, k.split(":", 1)[0] + "s", k.split(":", 1)[1].replace(":", "-") + ".png"))]
    assert not missing, f"no picture of {missing}"
    told.append(f"{len(keys)} coats with pictures")


def parameters():
    """Those of the coat's models, with their ranges; what is set reaches the program."""
    clear()
    obj = grid(20)
    obj.pelage.coat = "recipe:cheetah"
    stages = {p.stage for p in obj.pelage.parameters}
    assert len(stages) == 2, stages
    obj.pelage.coat = "model:gray-scott"
    described = json.loads(run("models", "gray-scott", "--json"))[0]["parameters"]
    assert [p.name for p in obj.pelage.parameters] == [d["name"] for d in described]
    for p, d in zip(obj.pelage.parameters, described):
        shown = p.id_properties_ui("value").as_dict()
        assert math.isclose(p["value"], d["value"], rel_tol=1e-6)
        assert d["min"] is None or math.isclose(shown["min"], d["min"]), (p.name, shown, d)
    obj.pelage.coat = "model:turing"
    obj.pelage.parameters["Da"]["value"] = 1e9
    refused(obj, "Da")
    bpy.ops.pelage.parameters()
    assert not any(p.is_set() for p in obj.pelage.parameters)


def divided_cube():
    """On the object's own vertices: size in lengths of the scene, whatever the object's scale and turn."""
    clear()
    obj = cube()
    grow(obj, coat="model:turing", size=0.3)
    assert len(np.unique(colors(obj).round(2), axis=0)) > 8, "no coat"
    near(wavelength(obj, "pelage_b"), 0.3, 0.12, "cube: wavelength")
    at_rest = attribute(obj, "pelage_b")
    obj.location, obj.rotation_euler = (5, -3, 2), (0.3, 1.1, -0.7)
    grow(obj)
    assert np.array_equal(attribute(obj, "pelage_b"), at_rest), "a moved and turned object has another coat"
    obj.scale = (2, 2, 2)
    grow(obj, size=0.6)
    scaled = np.abs(attribute(obj, "pelage_b") - at_rest).max() / np.ptp(at_rest)
    assert scaled < 0.02, f"twice the object with twice the size is another coat, by {scaled} of its range"
    grow(obj, seed=2)
    assert np.abs(attribute(obj, "pelage_b") - at_rest).max() > 0.1 * np.ptp(at_rest), "the seed changes nothing"


def plain_cube():
    """Eight vertices: the finer mesh beside is a cube, with sharp edges, and the size is that of its faces."""
    clear()
    bpy.ops.mesh.primitive_cube_add(size=2)
    obj = active(bpy.context.object)
    sent = figure.polygons(obj.data, figure.Frame(obj, "X", "Z"), None)
    assert math.isclose(figure.sharpest_bend(sent), math.pi / 2)
    grow(obj, coat="model:turing", size=0.4, result="MESH", quality="draft")
    beside = bpy.data.objects[f"{obj.name} coat"]
    assert np.abs(np.abs(places(beside)).max(axis=0) - 1).max() < 1e-4, "the coat is no cube"
    near(wavelength(beside, "pelage_b"), 0.4, 0.12, "plain cube: wavelength")


def every_recipe():
    """All of them go through the add-on, in a few steps."""
    clear()
    obj, start = ball(3), process.Job.start
    process.Job.start = lambda job, *commands: start(job, *[
        [*words, "--steps", "2"] if words[1] == "grow" else words for words in commands])
    try:
        obj.pelage.crease = 0
        for key in [item[0] for item in catalogue.items() if item[0].startswith("recipe:")]:
            grow(obj, coat=key, quality="draft", result="VERTICES", size=0.5)
            assert results.COLOR in obj.data.attributes and len(results_of(obj)) > 0, key
            if 'solid = true' in catalogue.catalogue().text(key):
                refused(obj, "volume", result="IMAGES", pixels=32)
        grow(obj, coat="recipe:demo", result="IMAGES", pixels=32)  # whose look says how finely its mesh is split
    finally:
        process.Job.start = start


def results_of(obj):
    """The species at its vertices."""
    return [a.name for a in obj.data.attributes if a.name.startswith(results.PREFIX)]


def undo():
    """One step takes the coat off, and one step back brings it."""
    clear()
    obj = ball(4)
    obj.name = "Undone"
    obj.pelage.coat = "model:turing"
    obj.pelage.quality = "draft"
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.pelage.grow("EXEC_DEFAULT", True) == {"FINISHED"}
    assert results.COLOR in obj.data.attributes and obj.material_slots
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Undone"]
    assert results.COLOR not in obj.data.attributes and not obj.material_slots, "undo leaves something"
    bpy.ops.ed.redo()
    obj = bpy.data.objects["Undone"]
    assert results.COLOR in obj.data.attributes and obj.material_slots, "redo brings nothing"


def cancel():
    """The program ends at once, its folder goes, and the object stays as it was."""
    clear()
    obj = ball(7)
    obj.pelage.coat, obj.pelage.quality, obj.pelage.size = "recipe:leopard", "normal", 0.12
    work = growth.Growth(bpy.context, obj)
    end = time.time() + 120
    while work.job.running() and "growing" not in work.job.task and time.time() < end:
        time.sleep(0.05)
    assert work.job.running(), f"it ended before it could be cancelled, while {work.job.task}: {work.job._errors}"
    assert os.listdir(TEMPORARY), "the folder is elsewhere"
    number = work.job._process.pid
    work.job.cancel()
    try:
        work.finish(bpy.context)
        raise AssertionError("a cancelled growth came to an end")
    except process.Failure as failure:
        assert str(failure) == "Cancelled", failure
    work.job.close()
    assert os.listdir(TEMPORARY) == []
    assert not os.path.exists(f"/proc/{number}"), "the program still runs"
    assert work.job._process.returncode != -9, "it had to be killed"
    assert results.COLOR not in obj.data.attributes
    operators.stop()


def animal(name, size=2000):
    """The program's own, with uv, as Blender imports it: standing on its feet."""
    run("unwrap", f"builtin:animal?n={size}", "-o", f"{name}.glb")
    for kind, old in (("bool", bool), ("int", int), ("float", float), ("object", object)):
        if kind not in np.__dict__:  # the glTF importer of Blender 3.4 uses names that numpy 1.24 dropped
            setattr(np, kind, old)
    before = set(bpy.data.objects)
    bpy.ops.import_scene.gltf(filepath=f"{name}.glb")
    obj = next(o for o in set(bpy.data.objects) - before if o.type == "MESH")
    obj.name = name
    return active(obj)


def pixels_at(image, uv):
    """Of the nearest texels, as stored."""
    width, height = image.size
    pixels = np.empty(width * height * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    x, y = (np.clip((uv[:, k] * n).astype(int), 0, n - 1) for k, n in ((0, width), (1, height)))
    return pixels.reshape(height, width, image.channels)[y, x]


def corner_uv(obj):
    return figure.numbers(obj.data.uv_layers.active.data, "uv", 2)


def principled(obj):
    return next(n for n in obj.active_material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")


def comes_from(socket):
    """The names of all nodes that a socket sees."""
    names = []
    for link in socket.links:
        names.append(link.from_node.name)
        for more in link.from_node.inputs:
            names += comes_from(more)
    return names


def image_of(obj, channel):
    return obj.active_material.node_tree.nodes[f"Pelage {channel}"].image


def animal_with_uv():
    """Images on its uv: they show what the vertices show, are packed, and are wired into the material it had."""
    clear()
    obj = animal("Cub")
    own = bpy.data.materials.new("Fur")
    own.use_nodes = True
    obj.data.materials.clear()
    obj.data.materials.append(own)
    axes = {"front": "X", "up": "Y"}  # the importer turns the object, not its mesh
    if abs((obj.matrix_world.to_3x3() @ Vector((0, 0, 1))).z) > 0.9:
        axes = {"front": "X", "up": "Z"}
    grow(obj, coat="recipe:leopard", **axes)
    at_vertices = colors(obj)
    assert obj.active_material == own and "Pelage color" in comes_from(principled(obj).inputs["Base Color"])
    grow(obj, result="IMAGES", pixels=1024)
    assert obj.active_material == own and principled(obj).inputs["Base Color"].links[0].from_node.type == "TEX_IMAGE"
    image = image_of(obj, "color")
    assert image.packed_file and tuple(image.size) == (1024, 1024)
    seen = pixels_at(image, corner_uv(obj))[:, :3]
    asked = at_vertices[figure.numbers(obj.data.loops, "vertex_index", kind=np.int32)]
    apart = np.abs(seen - asked).max(axis=1)
    told.append(f"animal: image and vertices differ by {255 * apart.mean():.1f} of 255")
    assert np.median(apart) < 6 / 255, f"the image shows something else: {255 * np.median(apart)}"
    assert np.median(np.abs(seen - asked[::-1]).max(axis=1)) > 20 / 255, "any image would do"
    return obj


def relief():
    """A coat with relief and gloss: normal map, roughness and metalness are wired; displaced it is the height."""
    clear()
    obj = animal("Idol", 1000)
    grow(obj, coat="recipe:gilded-zebra", result="IMAGES", pixels=512, up="Z", front="X")
    shader = principled(obj)
    assert "Pelage normal" in comes_from(shader.inputs["Normal"]) and not shader.inputs["Normal"].links[0].is_muted
    assert "Pelage roughness" in comes_from(shader.inputs["Roughness"])
    assert "Pelage metalness" in comes_from(shader.inputs["Metallic"])
    assert image_of(obj, "normal").colorspace_settings.name == "Non-Color"
    normal = pixels_at(image_of(obj, "normal"), corner_uv(obj))[:, :3]
    assert normal[:, 2].mean() > 0.9 and normal[:, 0].std() > 0.005, "no normal map"
    grow(obj, result="VERTICES")
    assert obj.active_material.node_tree.nodes["Pelage roughness"].attribute_name == "pelage_material_roughness"
    assert np.ptp(attribute(obj, "pelage_material_roughness")) > 0.05
    assert {"Pelage relief", "Pelage height"} <= set(comes_from(principled(obj).inputs["Normal"]))
    grow(obj, result="IMAGES", displace=True, height="0.1*bx")  # spacings, from end to end twice as many
    output = next(n for n in obj.active_material.node_tree.nodes if n.type == "OUTPUT_MATERIAL")
    assert "Pelage height" in comes_from(output.inputs["Displacement"])
    assert not principled(obj).inputs["Normal"].links, "relief twice"
    assert obj.active_material.node_tree.nodes["Pelage relief"].space == "WORLD", "heights are lengths of the scene"
    height = pixels_at(image_of(obj, "height"), corner_uv(obj))[:, 0]
    near(np.ptp(height), 0.2 * 0.055 * obj.dimensions.length, 0.05, "relief: height")
    grow(obj, coat="recipe:leopard", displace=False, height="")
    names = obj.active_material.node_tree.nodes.keys()
    assert "Pelage roughness" not in names and "Pelage height" not in names, "nodes of the coat before are left"
    assert "Pelage color" in comes_from(principled(obj).inputs["Base Color"])
    grow(obj, height="0.1*smoothstep(3.4, 2.4, b)")
    assert "Pelage normal" in comes_from(principled(obj).inputs["Normal"])


def without_uv():
    """A mesh without uv gets an atlas; mirrored by its scale it gets the right one, too."""
    for scale in (1, -1):
        clear()
        obj = ball(4)
        obj.data.uv_layers.remove(obj.data.uv_layers[0])
        obj.scale = (scale, 1, 1)
        bpy.context.view_layer.update()
        sent = figure.polygons(obj.data, figure.Frame(obj, "X", "Z"), None)
        corners = sent.points[sent.corners.reshape(-1, 3)]
        volume = np.linalg.det(corners).sum() / 6
        assert abs(volume / (4 / 3 * math.pi) - 1) < 0.05, f"scale {scale}: the shape is sent inside out"
        grow(obj, coat="model:turing", size=0.4)
        asked = colors(obj)[figure.numbers(obj.data.loops, "vertex_index", kind=np.int32)]
        grow(obj, result="IMAGES", pixels=512)
        assert any("atlas" in m.name for m in obj.pelage.messages)
        apart = np.abs(pixels_at(image_of(obj, "color"), corner_uv(obj))[:, :3] - asked).max(axis=1)
        assert np.median(apart) < 6 / 255, f"scale {scale}: {255 * np.median(apart)} of 255"


def tiles():
    """Of uv in several tiles only one image would be loaded, so it is refused; uv across a border repeats."""
    clear()
    obj = grid(10)
    uv = corner_uv(obj)
    obj.data.uv_layers.active.data.foreach_set("uv", (uv * (2, 1)).astype(np.float32).reshape(-1))
    refused(obj, "UDIM", coat="model:turing", size=0.5, result="IMAGES", pixels=64)
    obj.data.uv_layers.active.data.foreach_set("uv", (uv * (2, 1) + (0.05, 0)).astype(np.float32).reshape(-1))
    grow(obj)
    obj.data.uv_layers.active.data.foreach_set("uv", (uv + (3, 1)).astype(np.float32).reshape(-1))
    grow(obj)
    assert image_of(obj, "color").packed_file


def modifiers_and_scale():
    """What is measured is what is shown: modifiers and uneven scale included."""
    clear()
    bpy.ops.mesh.primitive_monkey_add(size=1)
    obj = active(bpy.context.object)
    obj.scale, obj.rotation_euler, obj.location = (1, 2, 1.5), (0.2, 0.4, 1), (1, 2, 3)
    obj.vertex_groups.new(name="Ear").add([3, 4, 5], 0.5, "REPLACE")
    divide(obj, 3)
    bpy.ops.object.modifier_add(type="SOLIDIFY")
    refused(obj, "modifiers", coat="model:turing", size=0.15)
    grow(obj, result="MESH")
    beside = bpy.data.objects[f"{obj.name} coat"]
    shown = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    box = np.array([obj.matrix_world @ v.co for v in mesh.vertices])
    shown.to_mesh_clear()
    coat = places(beside)
    away = max(np.abs(coat.min(axis=0) - box.min(axis=0)).max(), np.abs(coat.max(axis=0) - box.max(axis=0)).max())
    assert away < 0.03, f"the coat is off by {away}"
    near(wavelength(beside, "pelage_b"), 0.15, 0.15, "scaled with modifiers: wavelength")
    before = len(bpy.data.objects)
    beside.active_material.node_tree.nodes.new("ShaderNodeBrightContrast").name = "Mine"
    grow(obj, seed=2)
    assert len(bpy.data.objects) == before and "Mine" in beside.active_material.node_tree.nodes
    grow(obj, result="IMAGES", pixels=512)
    assert len(obj.modifiers) == 2 and image_of(obj, "color").packed_file
    grow(obj, result="VERTICES", modifiers="APPLY")
    assert len(obj.modifiers) == 0 and math.isclose(obj.vertex_groups["Ear"].weight(3), 0.5, abs_tol=0.1)
    near(wavelength(obj, "pelage_b"), 0.15, 0.15, "modifiers applied: wavelength")


def saved_and_grown_again():
    """Settings are saved with the object; the same coat comes again, and the material keeps what was changed."""
    clear()
    obj = grow(ball(5), coat="model:turing", size=0.4, seed=7, result="IMAGES", pixels=256)
    obj.name = "Kept"
    tree = obj.active_material.node_tree
    between = tree.nodes.new("ShaderNodeHueSaturation")
    tree.links.new(tree.nodes["Pelage color"].outputs["Color"], between.inputs["Color"])
    tree.links.new(between.outputs["Color"], principled(obj).inputs["Base Color"])
    principled(obj).inputs["Roughness"].default_value = 0.125
    before = pixels_at(image_of(obj, "color"), corner_uv(obj))
    images = len(bpy.data.images)
    path = os.path.abspath("kept.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.wm.open_mainfile(filepath=path)
    obj = bpy.data.objects["Kept"]
    assert (obj.pelage.coat, obj.pelage.seed) == ("model:turing", 7)
    assert np.array_equal(pixels_at(image_of(obj, "color"), corner_uv(obj)), before), "the image was not saved"
    grow(obj)
    assert np.array_equal(pixels_at(image_of(obj, "color"), corner_uv(obj)), before), "another coat"
    assert "Hue Saturation Value" in comes_from(principled(obj).inputs["Base Color"]), "the user's link is gone"
    assert principled(obj).inputs["Roughness"].default_value == 0.125
    assert len(bpy.data.images) == images, "images pile up"
    other_looks(obj, before)


def other_looks(obj, before):
    """Another seed is another image; from images to attributes the node is another one at its place in the chain."""
    grow(obj, seed=8)
    assert not np.array_equal(pixels_at(image_of(obj, "color"), corner_uv(obj)), before)
    grow(obj, result="VERTICES")
    assert "Pelage color" in comes_from(principled(obj).inputs["Base Color"])
    assert "Hue Saturation Value" in comes_from(principled(obj).inputs["Base Color"])


def shared_material():
    """A material that another object shows, too, stays as it is there."""
    clear()
    one, other = ball(3), ball(3)
    material = bpy.data.materials.new("Both")
    material.use_nodes = True
    for obj in (one, other):
        obj.data.materials.append(material)
    grow(one, coat="model:turing", quality="draft")
    assert other.active_material == material and "Pelage color" not in material.node_tree.nodes
    assert one.active_material != material and "Pelage color" in one.active_material.node_tree.nodes


def painted_weights():
    """A vertex group as the size map: twice the spacing where it is 1."""
    clear()
    obj = grid(160, 4)
    group = obj.vertex_groups.new(name="Fat half.L")
    for vertex in obj.data.vertices:
        group.add([vertex.index], 1.0 if vertex.co.x > 0 else 0.0, "REPLACE")
    grow(obj, coat="model:turing", size=0.15, size_map="Fat half.L", size_at_0=1, size_at_1=2, modifiers="IGNORE")
    assert any("attribute(Fat_half_L)" in m.name for m in obj.pelage.messages), "the mapped name is not said"
    near(wavelength(obj, "pelage_b", lambda p: p[:, 0] < -0.3), 0.15, 0.12, "weight 0: wavelength")
    near(wavelength(obj, "pelage_b", lambda p: p[:, 0] > 0.3), 0.30, 0.12, "weight 1: wavelength")
    # A formula says the same.
    by_name = attribute(obj, "pelage_b")
    grow(obj, size_map="1 + attribute(fat_half_l)")
    assert np.array_equal(attribute(obj, "pelage_b"), by_name)
    refused(obj, "Fat_hal", size_map="1 + attribute(Fat_hal)")


def painted_mask():
    """A colour attribute of corners as a mask: nothing grows where it is white."""
    clear()
    obj = grid(80)
    paint = obj.data.color_attributes.new("Bald", "BYTE_COLOR", "CORNER")
    for loop, color in zip(obj.data.loops, paint.data):
        white = 1.0 if obj.data.vertices[loop.vertex_index].co.x > 0 else 0.0
        color.color_srgb = (white, white, white, 1)
    grow(obj, coat="model:turing", size=0.15, mask="Bald", inside="excluded")
    field, x = attribute(obj, "pelage_b"), places(obj)[:, 0]
    inside, outside = np.std(field[x > 0.2]), np.std(field[x < -0.2])
    told.append(f"mask: deviation {inside:.2g} inside, {outside:.2g} outside")
    assert inside < 0.15 * outside, f"{inside} inside the mask, {outside} outside"
    grow(obj, mask="attribute(Bald_1) < 0.5")
    field = attribute(obj, "pelage_b")
    assert np.std(field[x < -0.2]) < 0.15 * np.std(field[x > 0.2]), "the formula's mask is not the other half"


def painted_parameter():
    """A float attribute as a parameter map changes the pattern where it is."""
    clear()
    obj = grid(60)
    values = obj.data.attributes.new("Heat", "FLOAT", "POINT")
    values.data.foreach_set("value", (places(obj)[:, 0] > 0).astype(np.float32))
    grow(obj, coat="model:gray-scott:spots", size=0.15)
    before = attribute(obj, "pelage_v")
    heat = obj.pelage.parameters["k"]
    heat.map, heat.at_one = "Heat", heat["value"] + 0.02  # beyond what the pattern bears
    grow(obj)
    x, after = places(obj)[:, 0], attribute(obj, "pelage_v")
    assert np.ptp(after[x > 0.3]) < 0.2 * np.ptp(after[x < -0.3]), "the parameter is not another there"
    assert np.ptp(before[x > 0.3]) > 0.5 * np.ptp(before[x < -0.3])


def line(name, points):
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new("POLY")
    spline.points.add(len(points) - 1)
    for knot, point in zip(spline.points, points):
        knot.co = (*point, 1)
    obj = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(obj)
    return obj


def pencil(name, points):
    data = bpy.data.grease_pencils.new(name)
    stroke = data.layers.new("Lines").frames.new(1).strokes.new()
    stroke.points.add(len(points))
    for knot, point in zip(stroke.points, points):
        knot.co = point
    obj = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(obj)
    return obj


def bow(name):
    """A quarter of a circle by a Bezier spline."""
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new("BEZIER")
    spline.bezier_points.add(1)
    k = 0.5523  # of handles: the circle's
    for knot, co, left, right in zip(spline.bezier_points, ((1, 0), (0, 1)), ((1, -k), (k, 1)), ((1, k), (-k, 1))):
        knot.co, knot.handle_left, knot.handle_right = (*co, 0), (*left, 0), (*right, 0)
    obj = bpy.data.objects.new(name, data)
    bpy.context.collection.objects.link(obj)
    return obj


def along(obj, k):
    return measure(obj, "pelage_" + field_of(obj))["along"][k]


def field_of(obj):
    names = [a.name for a in obj.data.attributes if a.name.startswith("pelage_")]
    return names[-1].removeprefix("pelage_")


def drawn_directions():
    """Stripes run along curves and strokes, wherever these objects and the figure are."""
    clear()
    obj = grid(100)
    obj.location, obj.rotation_euler = (3, 1, 2), (0, 0, 0)
    bpy.context.view_layer.update()
    makers = (("curve", lambda points: line("Way", points)), ("pencil", lambda points: pencil("Way", points)))
    for kind, make in makers:
        for k, axis in ((0, "x"), (1, "y")):
            ends = [(3 - 0.9 * (k == 0), 1 - 0.9 * (k == 1), 2), (3 + 0.9 * (k == 0), 1 + 0.9 * (k == 1), 2)]
            way = make([Vector(ends[0]).lerp(Vector(ends[1]), t) - Vector((7, 0, 0)) for t in (0, 0.25, 0.5, 0.75, 1)])
            way.location = (7, 0, 0)
            grow(obj, coat="model:witkin-kass-stripes", size=0.15, strokes=way)
            share = along(obj, k)
            told.append(f"{kind} along {axis}: {share:.3f} of the stripes")
            assert share > 0.9, f"{kind} along {axis}: only {share} of the stripes run along it"
            bpy.data.objects.remove(way)
    assert obj.pelage.strokes is None
    grow(obj, strokes=bow("Bow"), coat="model:turing", size=0.3)
    assert any("follows no directions" in m.name for m in obj.pelage.messages), "unused strokes are not said"


def bent_directions():
    """Along a bow of a Bezier curve stripes bend with it, far from the origin and turned: by the slopes near it."""
    clear()
    obj, way = grid(120, 3), bow("Bow")
    obj.location, obj.rotation_euler = (3, 1, 2), (0.3, 0.2, 0.7)
    bpy.context.view_layer.update()
    way.matrix_world = obj.matrix_world
    grow(obj, coat="model:witkin-kass-stripes", size=0.12, strokes=way)
    field, points = attribute(obj, "pelage_" + field_of(obj)), figure.numbers(obj.data.vertices, "co", 3)
    n = 121
    at = np.lexsort((points[:, 0].round(6), points[:, 1].round(6)))
    dy, dx = np.gradient(field[at].reshape(n, n), 3 / 120)
    x, y = (points[at][:, k].reshape(n, n) for k in (0, 1))
    radius = np.hypot(x, y)
    near_it = (np.abs(radius - 1) < 0.15) & (x > 0.1) & (y > 0.1)
    radial = ((dx * x + dy * y) / np.maximum(radius, 1e-9)) ** 2  # across the bow
    share = radial[near_it].sum() / (dx ** 2 + dy ** 2)[near_it].sum()
    told.append(f"bow: {share:.3f} of the slopes across it")
    assert share > 0.9, f"only {share} of the slopes are across the bow"


def fairing():
    """The noise goes, all else stays, and undo brings it back."""
    clear()
    obj = ball(5)
    obj.name = "Rough"
    obj.scale = (2, 2, 2)
    bpy.context.view_layer.update()
    group = obj.vertex_groups.new(name="Part")
    group.add(list(range(100)), 0.5, "REPLACE")
    modifier = divide(obj, 1)
    for vertex in obj.data.vertices:
        vertex.co += vertex.co * 0.012 * (noise.random() - 0.5)
    places_before, uv = places(obj), corner_uv(obj).copy()
    rough = np.std(np.linalg.norm(places_before, axis=1))
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.pelage.fair("EXEC_DEFAULT", True) == {"FINISHED"}
    fair = np.std(np.linalg.norm(places(obj), axis=1))
    told.append(f"fairing: noise {rough:.4f} to {fair:.4f}")
    assert fair < 0.5 * rough and abs(np.mean(np.linalg.norm(places(obj), axis=1)) - 2) < 0.01
    assert np.array_equal(corner_uv(obj), uv) and obj.modifiers[0] == modifier
    assert math.isclose(obj.vertex_groups["Part"].weight(5), 0.5)
    assert os.listdir(TEMPORARY) == []
    bpy.ops.ed.undo()
    again = places(bpy.data.objects["Rough"])
    assert np.abs(again - places_before).max() < 1e-6, "undo does not bring the noise back"


def own_files():
    """A recipe and a model of one's own, with the image beside the recipe."""
    clear()
    run("models", "--new", "own")
    obj = grid(40)
    grow(obj, file=os.path.abspath("own.toml"), quality="draft")
    assert len(obj.pelage.parameters) > 0, "no parameters of one's own model"
    image = bpy.data.images.new("age", 16, 16)
    image.pixels.foreach_set(np.tile(np.repeat([0.0, 1.0], 8)[:, None].repeat(4, 1).reshape(-1), 16).astype(np.float32))
    image.filepath_raw, image.file_format = os.path.abspath("age.png"), "PNG"
    image.save()
    with open("recipe.toml", "w") as file:
        file.write("[[texture]]\nname = \"age\"\nfile = \"age.png\"\n[stage]\nmodel = \"turing\"\nsize = 0.05\n"
                   "size-map = \"1 + attribute(age)\"\n")
    grow(obj, file=os.path.abspath("recipe.toml"), result="IMAGES", pixels=256)
    os.remove("age.png")
    refused(obj, "age.png")


def loose_parts():
    """Vertices and edges without faces stay, and n-gons and triangles beside quadrangles, too."""
    clear()
    bpy.ops.mesh.primitive_cylinder_add(vertices=24)
    obj = active(bpy.context.object)
    mesh = obj.data
    mesh.vertices.add(2)
    mesh.vertices[-1].co, mesh.vertices[-2].co = (0, 0, 0.2), (0, 0, 0.4)
    mesh.edges.add(1)
    mesh.edges[-1].vertices = (len(mesh.vertices) - 2, len(mesh.vertices) - 1)
    grow(obj, coat="model:turing", size=0.5, quality="draft", crease=math.radians(40))
    assert len(colors(obj)) == len(mesh.vertices) == 50


def main():
    rows = (without_program, coats, parameters, divided_cube, plain_cube, every_recipe, undo, cancel, animal_with_uv,
            relief, without_uv, tiles, modifiers_and_scale, saved_and_grown_again, shared_material, painted_weights,
            painted_mask, painted_parameter, drawn_directions, bent_directions, fairing, own_files, loose_parts)
    asked = sys.argv[sys.argv.index("--") + 4:]
    for row in rows:
        if row in rows[:1] or not asked or row.__name__ in asked:
            begun = time.time()
            row()
            print(f"{row.__name__}: {time.time() - begun:.0f} s", flush=True)
    print("ok " + "; ".join(told))


main()

"""The nodes that show a coat in the materials of an object: known by their names, and for the rest the user's."""
from dataclasses import dataclass

import bpy

# By channel the names of the sockets of the Principled BSDF, newer Blenders' first.
_SOCKETS = {"color": ("Base Color",), "roughness": ("Roughness",), "metalness": ("Metallic",), "opacity": ("Alpha",),
            "emission": ("Emission Color", "Emission"), "transmission": ("Transmission Weight", "Transmission")}
CHANNELS = (*_SOCKETS, "normal", "height")
_COLORS = ("color", "emission")
_STEP = 280  # between nodes


@dataclass
class Source:
    """Where a channel comes from: an image, or an attribute of that name."""
    image: object = None
    attribute: str = ""
    strength: float = 1  # of light, where the image holds a share of the brightest


def is_color(channel: str) -> bool:
    """Whether its numbers are encoded as sRGB in images."""
    return channel in _COLORS


class _Wiring:
    """The nodes of one material."""

    def __init__(self, material):
        if not material.use_nodes:
            material.use_nodes = True
        self.tree, self.fresh = material.node_tree, False
        outputs = [n for n in self.tree.nodes if n.type == "OUTPUT_MATERIAL"]
        self.output = next((n for n in outputs if n.is_active_output), None)
        self.shader = self._shader()

    def _shader(self):
        """The one that the output shows, or any."""
        shaders = [n for n in self.tree.nodes if n.type == "BSDF_PRINCIPLED"]
        surface = self.output and self.output.inputs["Surface"]
        shown = surface.links[0].from_node if surface and surface.links else None
        return shown if shown in shaders else next(iter(shaders), None)

    def node(self, name: str, kind: str):
        """The node of that name; one of another kind hands its links over."""
        nodes, old = self.tree.nodes, self.tree.nodes.get(name)
        if old and old.bl_idname == kind:
            self.fresh = False
            return old
        new = nodes.new(kind)
        self.fresh = old is None
        if old:
            new.location = old.location
            for link in [link for output in old.outputs for link in output.links]:
                self.tree.links.new(_out(new), link.to_socket)
            nodes.remove(old)
        new.name = new.label = name
        return new

    def link(self, node, sockets: tuple, target=None):
        """To the first of these inputs that there is, if the node is new: later on links are the user's."""
        target = target or self.shader
        socket = target and next((target.inputs[s] for s in sockets if s in target.inputs), None)
        if self.fresh and socket:
            self.tree.links.new(_out(node), socket)

    def place(self, node, column: int, row: int):
        """Beside the shader, where nobody has put it yet."""
        if self.fresh and self.shader:
            x, y = self.shader.location
            node.location = (x - _STEP * column, y + 100 - _STEP * row)

    def source(self, channel: str, source: Source, row: int):
        """The node that reads the channel."""
        if source.image:
            node = self.node(f"Pelage {channel}", "ShaderNodeTexImage")
            node.image = source.image
        else:
            node = self.node(f"Pelage {channel}", "ShaderNodeAttribute")
            node.attribute_name = source.attribute
        self.place(node, 2, row)
        return node

    def take_away(self, channels):
        """Nodes of a coat before, which had more."""
        more = {"normal": "Pelage normal map", "height": "Pelage relief"}
        for channel in channels:
            for name in (f"Pelage {channel}", more.get(channel)):
                if name and (node := self.tree.nodes.get(name)):
                    self.tree.nodes.remove(node)


def _out(node):
    """What of a node is to be linked: of attributes that are numbers the factor is the same as the colour."""
    return node.outputs[0]


def _wire_uv(wiring, uv: str):
    """Images are on this uv, whichever the mesh shows."""
    node = wiring.node("Pelage uv", "ShaderNodeUVMap")
    node.uv_map = uv
    wiring.place(node, 3, 0)
    for name in ("Pelage " + channel for channel in CHANNELS):
        image = wiring.tree.nodes.get(name)
        if image and image.bl_idname == "ShaderNodeTexImage" and not image.inputs["Vector"].links:
            wiring.tree.links.new(node.outputs["UV"], image.inputs["Vector"])


def _wire_normal(wiring, uv: str):
    """From the image by a normal map to the shader."""
    image = wiring.tree.nodes["Pelage normal"]
    node = wiring.node("Pelage normal map", "ShaderNodeNormalMap")
    node.uv_map = uv
    wiring.place(node, 1, 5)
    wiring.link(node, ("Normal",))
    if wiring.fresh:
        wiring.tree.links.new(_out(image), node.inputs["Color"])


def _wire_height(wiring, displace: bool):
    """Displacement, or where nothing else shows the relief a bump; heights are lengths of the scene."""
    source = wiring.tree.nodes["Pelage height"]
    kind = "ShaderNodeDisplacement" if displace else "ShaderNodeBump"
    old = wiring.tree.nodes.get("Pelage relief")
    if old and old.bl_idname != kind:  # what its output means is another thing: its links are not handed over
        wiring.tree.nodes.remove(old)
    node = wiring.node("Pelage relief", kind)
    wiring.place(node, 1, 6)
    if wiring.fresh:
        wiring.tree.links.new(_out(source), node.inputs["Height"])
    if displace:
        node.space = "WORLD"
        node.inputs["Midlevel"].default_value = 0
        wiring.link(node, ("Displacement",), wiring.output)
    else:
        node.inputs["Distance"].default_value = 1
        wiring.link(node, ("Normal",))


def _settle(material, channels, displace: bool):
    """What no node says."""
    if displace:
        holder = material if hasattr(material, "displacement_method") else material.cycles
        holder.displacement_method = "DISPLACEMENT"
    if "opacity" in channels and getattr(material, "blend_method", "") == "OPAQUE":
        material.blend_method = "HASHED"


def _wire(material, sources: dict, uv: str, displace: bool):
    wiring = _Wiring(material)
    relief = "height" in sources and (displace or "normal" not in sources)
    shown = {c: s for c, s in sources.items() if c not in ("normal", "height")}
    if "normal" in sources and not displace:
        shown["normal"] = sources["normal"]
    if relief:
        shown["height"] = sources["height"]
    wiring.take_away(channel for channel in CHANNELS if channel not in shown)
    for row, (channel, source) in enumerate(shown.items()):
        node = wiring.source(channel, source, row)
        wiring.link(node, _SOCKETS.get(channel, ()))
        if channel == "emission" and wiring.fresh and wiring.shader:
            wiring.shader.inputs["Emission Strength"].default_value = source.strength
    if "normal" in shown:
        _wire_normal(wiring, uv)
    if relief:
        _wire_height(wiring, displace)
    if uv:
        _wire_uv(wiring, uv)
    _settle(material, shown, relief and displace)
    return wiring.shader is not None


def _own_materials(obj) -> list:
    """One for each slot: where other objects show the same material without a coat, a copy."""
    if not any(slot.material for slot in obj.material_slots):
        material = bpy.data.materials.new(f"{obj.name} coat")
        if obj.material_slots:
            obj.material_slots[0].material = material
        else:
            obj.data.materials.append(material)
    copies = {}
    for slot in obj.material_slots:
        material = slot.material
        if material and _is_shared(material, obj):
            copies.setdefault(material, material.copy())
            slot.material = copies[material]
    return list(dict.fromkeys(slot.material for slot in obj.material_slots if slot.material))


def _is_shared(material, obj) -> bool:
    if material.node_tree and "Pelage color" in material.node_tree.nodes:
        return False
    return any(slot.material is material for other in bpy.data.objects if other.data is not obj.data
               for slot in other.material_slots)


def dress(obj, sources: dict, uv: str, displace: bool) -> list:
    """Shows the channels in all materials of an object; returns lines about what could not be linked."""
    notes = []
    for material in _own_materials(obj):
        if not _wire(material, sources, uv, displace):
            notes.append(f"Material \"{material.name}\" has no Principled BSDF: link its nodes called Pelage yourself")
    return notes

"""Edits of a recipe's text (TOML) that leave all else as it is, and the names that formulas can hold.

Knows nothing of Blender. It is no parser of TOML: it finds tables and keys, and where their values end.
"""
import json
import re
from dataclasses import dataclass, field

_PART = r"""(?:[\w-]+|"[^"\n]*"|'[^'\n]*')"""
_KEY = re.compile(rf"[ \t]*({_PART}(?:[ \t]*\.[ \t]*{_PART})*)[ \t]*=[ \t]*")
_HEADER = re.compile(r"[ \t]*\[\[?([^\]\n]*)\]")
_ATTRIBUTE = re.compile(r"\battribute\(\s*([A-Za-z_]\w*)\s*\)")
_LENGTH = re.compile(r"[+-]?\d[\d_]*(\.\d+)?([eE][+-]?\d+)?$")

# Names that a PLY file gives another meaning.
RESERVED = frozenset("x y z nx ny nz s t u v r g b a red green blue alpha texture_u texture_v".split())


@dataclass
class Table:
    """A table of the text: its dotted name, where its header begins, where its entries do, and these."""
    name: str
    start: int
    body: int
    entries: dict = field(default_factory=dict)  # key: (start of its line, start of its value, end of its value)


def _string_end(text: str, at: int) -> int:
    quote = text[at:at + 3] if text[at:at + 3] in ('"""', "'''") else text[at]
    i = at + len(quote)
    while i < len(text) and not text.startswith(quote, i):
        i += 2 if text[i] == "\\" and quote[0] == '"' else 1
    return min(len(text), i + len(quote))


def _value_end(text: str, at: int, inline: bool = False) -> int:
    """Without blanks and comments behind it; `inline`: within braces."""
    depth, end, i = 0, at, at
    while i < len(text):
        c = text[i]
        if c in "\"'":
            i = end = _string_end(text, i)
            continue
        if c == "#" and depth:
            i = (text.find("\n", i) + 1 or len(text) + 1) - 1
            continue
        if depth == 0 and (c in "\n#" or (inline and c in ",}")):
            break
        depth += (c in "[{") - (c in "]}")
        i += 1
        if not c.isspace():
            end = i
    return end


def _next_line(text: str, at: int) -> int:
    return text.find("\n", at) + 1 or len(text)


def _plain(key: str) -> str:
    return re.sub(r"[\"'\s]", "", key)


def tables(text: str) -> list:
    """The tables of a text in their order; the first one is what stands above all headers."""
    found, at = [Table("", 0, 0)], 0
    while at < len(text):
        if header := _HEADER.match(text, at):
            found.append(Table(_plain(header[1]), at, _next_line(text, at)))
        elif key := _KEY.match(text, at):
            end = _value_end(text, key.end())
            found[-1].entries[_plain(key[1])] = (at, key.end(), end)
            at = end
        at = _next_line(text, at)
    return found


def stages(text: str) -> list:
    """Per stage its own table and, behind it, those that belong to it."""
    result = []
    for table in tables(text):
        if table.name == "stage":
            result.append([table])
        elif table.name.startswith("stage.") and result:
            result[-1].append(table)
    return result


def _value(text: str, table: Table, key: str):
    """A string without its quotes, or the text of anything else; None where there is no such key."""
    if key not in table.entries:
        return None
    raw = text[slice(*table.entries[key][1:])]
    if raw.startswith(('"""', "'''")):
        return raw[3:-3].replace("\\\n", "")
    if raw.startswith('"'):
        return json.loads(raw)
    return raw[1:-1] if raw.startswith("'") else raw


def stage_value(text: str, stage: int, key: str):
    """What a key of a stage says, or None."""
    return _value(text, stages(text)[stage][0], key)


def stage_names(text: str) -> list:
    """By which the program knows the stages."""
    return [stage_value(text, k, "name") or f"stage{k + 1}" for k in range(len(stages(text)))]


def stage_group(text: str, stage: int, group: str) -> dict:
    """The entries of a table of a stage, as `parameters`: in a table of its own, in braces or with dotted names."""
    own, *others = stages(text)[stage]
    for table in others:
        if table.name == f"stage.{group}":
            return {key: _value(text, table, key) for key in table.entries}
    if group not in own.entries:
        dotted = [key for key in own.entries if key.startswith(group + ".")]
        return {key[len(group) + 1:]: _value(text, own, key) for key in dotted}
    inline, (_, at, end) = Table(group, 0, 0), own.entries[group]
    at += 1
    while at < end and (key := _KEY.match(text, at)):
        value_end = _value_end(text, key.end(), inline=True)
        inline.entries[_plain(key[1])] = (at, key.end(), value_end)
        at = text.find(",", value_end) + 1 or end
    return {key: _value(text, inline, key) for key in inline.entries}


def without_stage_key(text: str, stage: int, key: str) -> str:
    """Takes a key, or the table of that name, out of a stage."""
    own, *others = stages(text)[stage]
    for table in others:
        if table.name == f"stage.{key}":
            ends = [other.start for other in tables(text) if other.start > table.start]
            return text[:table.start] + text[min(ends, default=len(text)):]
    return _without_entries(text, own, key)


def _without_entries(text: str, table: Table, key: str) -> str:
    for name, (start, _, end) in reversed(table.entries.items()):
        if name == key or name.startswith(key + "."):
            text = text[:start] + text[_next_line(text, end):]
    return text


def without_form(text: str) -> str:
    """Leaves out what the look says of the mesh that is written: another does that."""
    for key in ("detail", "flat", "keep-shape"):
        for look in [table for table in tables(text) if table.name == "look"]:
            text = _without_entries(text, look, key)
    return text


def is_solid(text: str) -> bool:
    """Whether the coat grows in the volume of the shape."""
    return _value(text, tables(text)[0], "solid") == "true" or any(
        stage_value(text, k, "method") == "tets" for k in range(len(stages(text))))


def with_stage_key(text: str, stage: int, key: str, value: str) -> str:
    """Sets a key of a stage to a value as TOML writes it."""
    text = without_stage_key(text, stage, key)
    body = stages(text)[stage][0].body
    return f"{text[:body].rstrip(chr(10))}\n{key} = {value}\n{text[body:]}"


def quoted(text: str) -> str:
    """A string as TOML writes it."""
    return json.dumps(text)


def with_size_map(text: str, formula: str) -> str:
    """Every stage's size gets the factor, too."""
    for k in range(len(stages(text))):
        old = stage_value(text, k, "size-map")
        text = with_stage_key(text, k, "size-map", quoted(f"({old})*({formula})" if old else formula))
    return text


def with_mask(text: str, formula: str, inside: str) -> tuple:
    """Masks every stage. A stage that has a mask of its own keeps it and what is done inside; their names come back."""
    joined = []
    for k, name in enumerate(stage_names(text)):
        if old := stage_value(text, k, "mask"):
            joined.append(name)
            text = with_stage_key(text, k, "mask", quoted(f"({old}) or ({formula})"))
        else:
            text = with_stage_key(text, k, "mask", quoted(formula))
            text = with_stage_key(text, k, "inside", quoted(inside))
    return text, joined


def with_strokes(text: str, stage: int, strokes: list) -> str:
    """The directions of a stage follow these polylines, and nothing else."""
    lines = ["[" + ", ".join("[" + ", ".join(f"{x:.9g}" for x in point) + "]" for point in stroke) + "]"
             for stroke in strokes]
    return with_stage_key(text, stage, "directions", "{ strokes = [" + ", ".join(lines) + "] }")


def size_of(text: str):
    """The size of the first stage as a fraction of the diagonal, or None where it is something else."""
    size = stage_value(text, 0, "size")
    return float(size.replace("_", "")) if size and _LENGTH.match(size) else None


def attributes_in(*formulas: str) -> set:
    """The names in attribute(NAME)."""
    return {name for formula in formulas for name in _ATTRIBUTE.findall(formula)}


def painted_names(text: str) -> list:
    """What a recipe brings along for attribute(NAME): its images and brushes."""
    return [_value(text, table, "name") for table in tables(text) if table.name in ("texture", "brush")]


def files_named(text: str) -> list:
    """What a recipe may name beside itself: images and models."""
    found = []
    for table in tables(text):
        key = {"texture": "file", "stage": "model"}.get(table.name)
        value = key and _value(text, table, key)
        if value and (key == "file" or ".toml" in value):
            found.append(re.sub(r"(\.toml):.*", r"\1", value))
    return found


def is_part_of(wanted: str, name: str) -> bool:
    """Whether a formula's name is that of a thing or of its component: tail, tail_1, tail_linear_2, in any case."""
    wanted, name = wanted.lower(), name.lower()
    return wanted.startswith(name) and re.fullmatch("(_[1-4]|_linear_[1-3])?", wanted[len(name):]) is not None


def formula_name(name: str) -> str:
    """A name that formulas can hold: letters, digits and underscores."""
    plain = re.sub(r"[^A-Za-z0-9_]", "_", name) or "_"
    if plain[0].isdigit():
        plain = "_" + plain
    return plain + "_" if plain.lower() in RESERVED else plain

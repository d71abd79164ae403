#!/usr/bin/env python3
"""Finds what is defined twice under one name: two different things of which a program that links both takes either.

Usage: check_twins.py [ROOT]    prints each class, enum, function and inline constant that has two definitions outside
of unnamed namespaces, with both places, and exits 1 if there is one.

Sources of src, include and apps make one program; each folder of tests makes a program with those and tests/support.
Functions are told apart by the types of their parameters.
"""
import collections
import pathlib
import re
import sys

# What must not be looked into.
HIDDEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\''
                    r'|^[ \t]*#[ \t]*el(?:se|if)\b.*?#[ \t]*endif|^[ \t]*#(?:\\\n|[^\n])*', re.S | re.M)
TOKEN = re.compile(r'[A-Za-z_]\w*|::|\S')
SPECIFIERS = {"static", "inline", "constexpr", "const", "extern", "explicit", "consteval", "friend", "typename"}
KINDS = {"class", "struct", "enum", "union"}
CLOSING = {"(": ")", "[": "]", "{": "}"}


def tokens(text):
    """The tokens of a source with their lines; comments, literals, directives and what an #else guards are left out."""
    def blank(match):
        return ('""' if match[0][0] in "R\"'" else "") + "\n" * match[0].count("\n")
    line, end, visible = 1, 0, HIDDEN.sub(blank, text)
    for match in TOKEN.finditer(visible):
        line += visible.count("\n", end, match.start())
        end = match.start()
        yield match[0], line


def skip_to_close(list_, i):
    """The index after the bracket that closes the one at i."""
    depth, opening = 0, list_[i][0]
    while i < len(list_):
        depth += (list_[i][0] == opening) - (list_[i][0] == CLOSING[opening])
        i += 1
        if depth == 0:
            break
    return i


def parameter_types(words):
    """The types of a list of parameters, without names and defaults."""
    types, current, depth = [], [], 0
    for word in words + [","]:
        if word == "," and depth == 0:
            if "=" in current:
                current = current[:current.index("=")]
            named = len(current) > 1 and re.match(r"\w", current[-1]) and current[-2] not in ("::", "const", "unsigned")
            types.append(" ".join(current[:-1] if named and current[:-1] != ["const"] else current))
            current = []
            continue
        depth += (word in "(<[{") - (word in ")>]}")
        current.append(word)
    return ", ".join(types)


def without_template_head(words):
    while words[:1] == ["template"]:
        depth, i = 0, 1
        while True:
            depth += (words[i] == "<") - (words[i] == ">")
            i += 1
            if depth == 0:
                break
        words = words[i:]
    return words


def definition(head):
    """What the words before a brace or a semicolon define, or None."""
    words = without_template_head(head)
    kind = next((w for w in words if w not in SPECIFIERS), "")
    if kind in KINDS:
        rest = [w for w in words[words.index(kind) + 1:] if w not in KINDS]
        name = rest[:rest.index(":")] if ":" in rest else rest
        return "type " + "".join(w for w in name if w != "final") if name else None
    if "operator" in words:
        opening = words.index("(", words.index("operator") + 2)
    elif "(" in words and ("=" not in words or words.index("=") > words.index("(")):
        opening = words.index("(")
    else:
        return None
    start = opening - 1
    if "operator" in words:
        start = words.index("operator")
    while start >= 2 and words[start - 1] == "::":
        start -= 2
    closing, depth = opening, 0
    for closing in range(opening, len(words)):
        depth += (words[closing] == "(") - (words[closing] == ")")
        if depth == 0:
            break
    suffix = " const" if "const" in words[closing:closing + 2] else ""
    return f'function {"".join(words[start:opening])}({parameter_types(words[opening + 1:closing])}){suffix}'


def definitions(text):
    """Yields (scope, what, line) for every definition outside of unnamed namespaces, classes and functions."""
    list_ = list(tokens(text))
    scopes, head, line, i = [], [], 1, 0
    while i < len(list_):
        word, at = list_[i]
        if not head:
            line = at
        if word == "{" and head.count("(") > head.count(")"):  # the value of a parameter
            i = skip_to_close(list_, i)
        elif word == "{":
            namespace = [w for w in head if w != "inline"][:1] == ["namespace"]
            if namespace and head[-1] != "namespace":
                scopes.append("".join(head[head.index("namespace") + 1:]))
                head, i = [], i + 1
                continue
            what = None if namespace else definition(head)
            if what and "static" not in head and not what.startswith("function main("):  # one in every program
                yield "::".join(scopes), what, line
            i = skip_to_close(list_, i)
            if namespace or (what or "").startswith("function"):  # all else goes on to a semicolon
                head = []
        elif word == "}":
            scopes, head, i = scopes[:-1], [], i + 1
        elif word == ";":
            if "inline" in head and "=" in head and "(" not in head[:head.index("=")]:
                yield "::".join(scopes), "constant " + head[head.index("=") - 1], line
            head, i = [], i + 1
        else:
            head, i = head + [word], i + 1


def program(file):
    return file.parts[1] if file.parts[0] == "tests" and file.parts[1] != "support" else ""


def twins(root):
    places = collections.defaultdict(list)
    for top in "src", "include", "apps", "tests":
        for file in sorted(f for f in (root / top).rglob("*") if f.suffix in (".h", ".cpp")):
            for scope, what, line in definitions(file.read_text()):
                places[scope, what].append((file.relative_to(root), line))
    for (scope, what), found in sorted(places.items()):
        for k, (file, line) in enumerate(found):
            other = next((p for p in found[:k] if "" in (program(p[0]), program(file)) or program(p[0]) == program(file)), None)
            if other:
                kind, name = what.split(" ", 1)
                yield f"{file}:{line}: {kind} {scope + '::' if scope else ''}{name} is defined in {other[0]}:{other[1]}, too"


if __name__ == "__main__":
    found = list(twins(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) or "twins: every name is defined once")
    sys.exit(1 if found else 0)

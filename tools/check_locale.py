#!/usr/bin/env python3
"""Finds calls in src/ whose results depend on the locale: characters, numbers to text, text to numbers.

A mesh must have the same bytes, and a recipe the same meaning, on a computer with decimal commas. Use base/ascii.h,
base/number.h, std::to_chars and std::from_chars. std::to_string is for integers.

Usage: check_locale.py [ROOT]    prints each call as FILE:LINE and exits 1 if there is one.
"""
import pathlib
import re
import sys

FORBIDDEN = re.compile(
    r"\b(is(al(pha|num)|digit|xdigit|space|blank|punct|print|graph|cntrl|upper|lower)|(std::|(?<!_)\b)to(upper|lower)"
    r"|v?(s|sn|f)?printf|v?f?s?scanf|(std::)?sto[dfil]|(std::)?stold|(std::)?stou?ll?|strto\w+|ato[fil]|atoll"
    r"|setlocale|localeconv|strftime|put_time|setprecision|std::format|std::regex\w*|std::(i|o)?fstream"
    r"|std::(cout|cerr|clog|cin))\s*[(<{ ]")
STREAM = re.compile(r"\bstd::[io]?stringstream\s+(\w+)")
COMMENT = re.compile(r"//.*")
TEXT = re.compile(r'"(\\.|[^"\\])*"')


def faults(root):
    for file in sorted(f for f in (root / "src").glob("**/*") if f.suffix in (".h", ".cpp")):
        lines = [COMMENT.sub("", TEXT.sub('""', line)) for line in file.read_text().splitlines()]
        for number, line in enumerate(lines, 1):
            where = f"{file.relative_to(root)}:{number}: "
            if match := FORBIDDEN.search(line):
                yield where + match[1] + " depends on the locale"
            stream = STREAM.search(line)
            if stream and f"{stream[1]}.imbue(std::locale::classic());" not in "".join(lines[number:number + 1]):
                yield where + f"{stream[1]} follows the locale; imbue it with the classic one in the next line"


if __name__ == "__main__":
    found = list(faults(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
    print("\n".join(found) or "locale: nothing in src/ depends on it")
    sys.exit(1 if found else 0)

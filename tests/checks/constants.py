#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numeric literals in the sources of the half-space solver, outside comments, strings and #include lines; 0, 1, 2 and 0.5 are
free. A tuned constant is a debt: tests/checks/constants.txt holds the number of literals, which may only fall.

usage: constants.py [--write] [FOLDER]     the project's folder (default: the one this file stands in); --write records the number
"""
import pathlib
import re
import sys

ROOM = "engine/contact/elasticity/half_space/solver"
TEXT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"|^\s*#[^\n]*', re.DOTALL | re.MULTILINE)
NUMBER = re.compile(r"(?<![\w.])(?:0x[\da-f.]+(?:p[+-]?\d+)?|(?:\d[\d']*\.?\d*|\.\d+)(?:e[+-]?\d+)?)[uflz]*(?![\w.])", re.IGNORECASE)
FREE = {"0", "1", "2", ".5", "0.5", "0.0", "1.0", "2.0"}


def literals(folder):
    for path in sorted((folder / ROOM).glob("*.[ch]pp")):
        text = TEXT.sub(lambda found: "\n" * found.group().count("\n") + " ", path.read_text(encoding="utf-8"))
        # Template arguments such as over_nodes<5, 4> count values and tune nothing.
        text = re.sub(r"\b\w+<[\d, ]+>", " ", text)
        for number, line in enumerate(text.split("\n"), 1):
            for literal in NUMBER.findall(line):
                if literal not in FREE:
                    yield f"{path.name}:{number}: {literal}"


if __name__ == "__main__":
    arguments = [argument for argument in sys.argv[1:] if argument != "--write"]
    root = pathlib.Path(arguments[0]) if arguments else pathlib.Path(__file__).resolve().parents[2]
    record, found = root / "tests/checks/constants.txt", list(literals(root))
    if "--write" in sys.argv:
        record.write_text(f"# Numeric literals in {ROOM}: constants.py --write records them.\n{len(found)}\n", encoding="utf-8")
    allowed = int(record.read_text(encoding="utf-8").split()[-1])
    if len(found) > allowed:
        print("\n".join(found))
        print(f"{len(found)} numeric literals, {allowed} in tests/checks/constants.txt; remove as many")
    else:
        print(f"{len(found)} numeric literals in {ROOM}, at most {allowed}")
    sys.exit(1 if len(found) > allowed or not found else 0)

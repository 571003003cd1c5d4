#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plants one mistake in a C++ source, chosen by a seed, for tests/mistakes/run.sh.

    plant.py SEED FILE N           print mistake N (from 0) of FILE as a patch
    plant.py SEED FILE N --apply   write it, and print its kind, its line and both texts, parted by tabs

The kinds alternate: a comparison turned, an edge moved by one ulp, a sign, a factor 1 ± 1e-4, a dropped line. FILE.cpp
includes FILE.hpp, if there is one. Comments, strings, includes, declarations and messages are left alone. A hash
of the seed and of the line orders the mistakes, so a change elsewhere in the file alters few of them."""
import difflib
import hashlib
import pathlib
import re
import sys

BLANK = "\0"
MESSAGE = re.compile(r"\b(?:throw |throw_file_error\(|refuse\w*\(|monitor_\.warn\(|problems_\.add\(|(?:damaged|note_)\(|static_assert)")
TURNED = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "==": "!=", "!=": "=="}
MOVED = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
SIGNS = {"+": "-", "-": "+", "+=": "-=", "-=": "+="}
WHOLE = re.compile(r"static_cast<(?!double)[^()]*>\(")  # a cast to a whole number absorbs a factor near one
# A statement of one line: an assignment, a call, a jump, perhaps under a condition.
STATEMENT = re.compile(r"\s*(?:(?:if|for) \(.*|[\w.\[\]()*>:+-]+ [-+*/]?= .*|(?:\+\+|--)[\w.]+|[\w.:]+\(.*\)|continue|break);\s*$")
NEVER_DROPPED = re.compile(r".*(?:reserve|" + BLANK + "{12})")


def blanked(text, pattern):
    return re.sub(pattern, lambda m: re.sub(r"[^\n]", BLANK, m.group()), text, flags=re.S | re.M)


def closed(text, start):
    """The place after the bracket that closes the one before `start`."""
    depth = 1
    while depth and start < len(text):
        depth += {"(": 1, ")": -1}.get(text[start], 0)
        start += 1
    return start


def code_of(text):
    """The text with everything that is no code to plant in blanked, at the same places."""
    text = blanked(text, r'//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\])\'|^#[^\n]*|^using [^\n]*')
    for message in list(MESSAGE.finditer(text)):
        end = text.find(";", message.start())
        text = text[: message.start()] + blanked(text[message.start() : end], r".+") + text[end:]
    return text


def mistakes(text):
    """Each kind with its mistakes: where, how many characters, and what takes their place."""
    code = code_of(text)
    kinds = {kind: [] for kind in ("turned", "edge", "sign", "factor", "dropped")}

    def swap(kind, pattern, table):
        for m in re.finditer(pattern, code):
            kinds[kind].append((m.start(), len(m.group()), table[m.group()]))

    swap("turned", r"(?<= )(?:[<>]=?|[=!]=)(?=\s)", TURNED)
    swap("edge", r"(?<= )[<>]=?(?=\s)", MOVED)
    swap("sign", r"(?<= )[-+]=?(?=\s)(?![^;]*" + BLANK + ")", SIGNS)
    kinds["sign"] += [(m.start(), 1, "") for m in re.finditer(r"(?<=[(\[ ])-(?=[\w(*])(?!1\b)", code)]
    whole = [(m.end(), closed(code, m.end())) for m in WHOLE.finditer(code)]
    for m in re.finditer(r"(?<=[\w)\]]) [*/](?=\s[\w(*])", code):
        if not any(a <= m.start() < b for a, b in whole):
            kinds["factor"].append((m.start(), 2, (" * 1.0001", " * 0.9999")[len(kinds["factor"]) % 2] + m.group()))
    begin = 0
    for line in code.splitlines(keepends=True):
        before = code[:begin].rstrip()
        if STATEMENT.match(line) and not NEVER_DROPPED.match(line) and before[-1:] in ";{})e:":
            indent = len(line) - len(line.lstrip())
            kinds["dropped"].append((begin + indent, len(line.strip()), "{}"))
        begin += len(line)
    return kinds


def ordered(seed, sources):
    """All mistakes of the sources, kinds in turn, in the order of a hash of their lines."""
    queues = []
    for number, kind in enumerate(("turned", "edge", "sign", "factor", "dropped")):
        queue = []
        for path in sources:
            text, seen = path.read_text(), {}
            for where, length, instead in mistakes(text)[kind]:
                begin, end = text.rfind("\n", 0, where) + 1, text.find("\n", where)
                old = text[begin:end]
                new = old[: where - begin] + instead + old[where - begin + length :]
                seen[old, new] = seen.get((old, new), 0) + 1
                key = hashlib.sha256(f"{seed} {kind} {old.strip()} {new.strip()} {seen[old, new]}".encode()).hexdigest()
                queue.append((key, kind, path, where, length, instead, old.strip(), new.strip()))
        queues.append(sorted(queue))
    most = max(map(len, queues))
    return [queue[k] for k in range(most) for queue in queues if k < len(queue)]


def main():
    seed, name, n = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3])
    sources = [path for path in dict.fromkeys((name, name.with_suffix(".hpp"))) if path.exists()]
    _, kind, path, where, length, instead, old, new = ordered(seed, sources)[n]
    text = path.read_text()
    planted = text[:where] + instead + text[where + length :]
    if sys.argv[4:] == ["--apply"]:
        path.write_text(planted)
        print(kind, f"{path.name}:{text.count(chr(10), 0, where) + 1}", old, new, sep="\t")
    else:
        lines = [t.splitlines(keepends=True) for t in (text, planted)]
        sys.stdout.writelines(difflib.unified_diff(*lines, f"a/{path}", f"b/{path}"))


if __name__ == "__main__":
    main()

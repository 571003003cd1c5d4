#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One concept, one file: in engine/ and bindings/ no folder holds more than 40 files and no file more than 600 lines. A source and
its header are one file of a concept in two: where both together have fewer than 60 lines, a file of fewer than 40 is named in
tests/checks/small_files.txt with the reason why it stands alone. tests/checks/budget.txt holds the lines and files of each
room: a room may become smaller. A commit that raises a number says what users get for it.

usage: sizes.py [--write] [FOLDER]     the project's folder (default: the one this file stands in); --write records the budget
"""
import collections
import pathlib
import re
import sys

MOST_FILES, MOST_LINES, SMALL, PAIR = 40, 600, 40, 60
CODE = (".cpp", ".hpp", ".h", ".ts")


def budget_of(folder, lines):
    """Lines and files of sources per room, and of the tests, benches, scripts and examples together."""
    rooms = collections.defaultdict(lambda: [0, 0])
    for name, count in lines.items():
        room = "/".join(name.split("/")[:2])
        for key in (room if "." not in room else name.split("/")[0], "engine + bindings"):
            rooms[key][0] += count
            rooms[key][1] += 1
    for top in ("tests", "bench", "scripts", "examples"):
        for path in (folder / top).rglob("*"):
            if path.suffix in CODE + (".lua", ".sh", ".py") and not {"node_modules", "corpus"} & set(path.parts):
                rooms[top][0] += len(path.read_text(encoding="utf-8").splitlines())
                rooms[top][1] += 1
    return rooms


def over_budget(folder, lines, write):
    path, rooms = folder / "tests/checks/budget.txt", budget_of(folder, lines)
    if write:
        rows = [f"{room}: {count} {files}" for room, (count, files) in sorted(rooms.items())]
        path.write_text("# Lines and files per room: sizes.py --write records them.\n" + "\n".join(rows) + "\n", encoding="utf-8")
    allowed = {}
    for row in path.read_text(encoding="utf-8").splitlines():
        if row and not row.startswith("#"):
            room, _, numbers = row.rpartition(": ")
            allowed[room] = [int(number) for number in numbers.split()]
    return [f"{room}: {now} {what}, {allowed.get(room, [0, 0])[k]} in tests/checks/budget.txt; remove as many, or record the number"
            f" and say in the commit what users get for it"
            for room, counts in rooms.items() for k, (what, now) in enumerate(zip(("lines", "files"), counts))
            if now > allowed.get(room, [0, 0])[k]]


def main(arguments):
    write = "--write" in arguments
    arguments = [argument for argument in arguments if argument != "--write"]
    folder = pathlib.Path(arguments[0]) if arguments else pathlib.Path(__file__).resolve().parents[2]
    paths = [path for top in ("engine", "bindings") for path in sorted((folder / top).rglob("*"))
             if path.is_file() and not {"node_modules", "dist"} & set(path.parts)]
    lines = {path.relative_to(folder).as_posix(): len(path.read_text(encoding="utf-8").splitlines())
             for path in paths if path.suffix in CODE}
    if not lines:
        print("no file of engine/ or bindings/ was found")
        return 1
    listed = {}
    text = (folder / "tests/checks/small_files.txt").read_text(encoding="utf-8")
    for line in text.splitlines():
        if line and not line.startswith("#"):
            name, _, reason = line.partition(": ")
            listed[name] = reason
    wrong = [f"{name}: {count} lines, over {MOST_LINES}" for name, count in lines.items() if count > MOST_LINES]
    in_folder = collections.Counter(path.parent.relative_to(folder).as_posix() for path in paths)
    wrong += [f"{name}/: {count} files, over {MOST_FILES}" for name, count in in_folder.items() if count > MOST_FILES]
    concepts = collections.Counter()
    for name, count in lines.items():
        concepts[re.sub(r"\.\w+$", "", name)] += count
    alone = {name for name, count in lines.items()
             if count < SMALL and not name.endswith(".ts") and concepts[re.sub(r"\.\w+$", "", name)] < PAIR}
    wrong += [f"{name}: {lines[name]} lines; put it where it belongs, or say why it stands alone in tests/checks/small_files.txt"
              for name in sorted(alone) if not listed.get(name)]
    wrong += [f"tests/checks/small_files.txt: {name} is not there, or not small any more" for name in listed if name not in alone]
    wrong += over_budget(folder, lines, write)
    print("\n".join(wrong) if wrong else
          f"{len(paths)} files in {len(in_folder)} folders, at most {max(in_folder.values())} in one; {len(lines)} sources of "
          f"{sum(lines.values())} lines, {sum(count < SMALL for count in lines.values())} of them under {SMALL}, "
          f"{len(alone)} by a reason of their own")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One concept, one file: in engine/ and bindings/ no folder holds more than 40 files and no file more than 600 lines. A source and
its header are one file of a concept in two: where both together have fewer than 60 lines, a file of fewer than 40 is named in
tests/checks/small_files.txt with the reason why it stands alone.

usage: sizes.py [FOLDER]     the project's folder (default: the one this file stands in)
"""
import collections
import pathlib
import re
import sys

MOST_FILES, MOST_LINES, SMALL, PAIR = 40, 600, 40, 60
CODE = (".cpp", ".hpp", ".h", ".ts")


def main(arguments):
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
    print("\n".join(wrong) if wrong else
          f"{len(paths)} files in {len(in_folder)} folders, at most {max(in_folder.values())} in one; {len(lines)} sources of "
          f"{sum(lines.values())} lines, {sum(count < SMALL for count in lines.values())} of them under {SMALL}, "
          f"{len(alone)} by a reason of their own")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

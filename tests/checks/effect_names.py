#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""An effect is known by its record alone: outside engine/contact/effects and the rooms of friction, no source names one in
quotes, no sentence of the engine or of an error names one in backquotes, and no solver includes anything of effects/.

usage: effect_names.py [FOLDER]
"""
import pathlib
import re
import sys

# Who walks the list of effects.
WALKERS = {"engine/contact/plan.cpp", "engine/contact/scene/scene.cpp", "engine/contact/quantities.cpp"}


def main(arguments):
    folder = pathlib.Path(arguments[0]) if arguments else pathlib.Path(__file__).resolve().parents[2]
    listed = (folder / "engine/contact/effects/list.cpp").read_text(encoding="utf-8")
    names = re.findall(r"^  effect\((\w+)\)", listed, re.M)
    if not names:
        print("engine/contact/effects/list.cpp: no effect is listed")
        return 1
    # In quotes; in backquotes within a sentence.
    quoted = re.compile("\"(?:{0})\"|\"[^\"]*`(?:{0})`".format("|".join(names)))
    wrong = []
    for top in ("engine", "bindings"):
        for path in sorted((folder / top).rglob("*.[ch]pp")):
            relative = path.relative_to(folder).as_posix()
            if relative.startswith("engine/contact/effects/") or "/friction/" in relative:
                continue
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                if quoted.search(line) and not line.lstrip().startswith("//"):
                    wrong.append(f"{relative}:{number}: names the effect {quoted.search(line).group(0)}")
                if relative.startswith("engine/contact/") and relative not in WALKERS and \
                        re.match(r'#include "engine/contact/effects/', line):
                    wrong.append(f"{relative}:{number}: includes an effect")
    for line in wrong:
        print(line)
    print(f"{len(names)} effects, known by their records" if not wrong else f"{len(wrong)} places know an effect by name")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

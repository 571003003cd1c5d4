#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# A lesson accepted a wrong prediction as near. Each lesson refuses the predictions under "Wrong" in docs/teacher.md and
# accepts those under "Accepted". A lesson runs once: a wrapper of its guess module tries all predictions.
import re
from pathlib import Path

import reproduction

root = Path(__file__).resolve().parents[2]
listed = re.compile(r"^- \*\*(Accepted|Wrong):\*\* ((?:`[^`]+`(?:, | to )?)*)", re.M)
wrapper = """local guess = require "asperity.guess"
local tried = setmetatable({ names=guess.names, choices=guess.choices }, { __call=function(_, given)
  for _, one in ipairs{ %s } do
    if one[1] == (given.name or "") then
      print(one[3] .. " " .. one[1] .. "=" .. one[2])
      given.said = one[2]
      guess(given)
    end
  end
end })
"""
accepted = re.compile(r"which is near\.$|, and so it is\.$")

reproduction.begin()
parts = re.split(r"^<!-- lesson: (\w+) -->$", (root / "docs/teacher.md").read_text(encoding="utf-8"), flags=re.M)
told = dict(zip(parts[1::2], parts[2::2]))
for path in sorted((root / "scripts/lessons").glob("*.lua")):
    name = path.stem[3:]
    wanted = []
    for kind, answers in listed.findall(told[name]):
        assert answers, f"docs/teacher.md: a prediction of the lesson {name} under {kind} is not in backquotes"
        for answer in re.findall("`([^`]+)`", answers):
            key, _, value = answer.rpartition("=")
            wanted.append((kind, key, value))
    assert {kind for kind, _, _ in wanted} == {"Accepted", "Wrong"}, (name, wanted)
    # Each tolerance is tested on both sides.
    keys = {side: {key for kind, key, _ in wanted if kind == side} for side in ("Accepted", "Wrong")}
    assert keys["Accepted"] == keys["Wrong"], (name, keys)
    table = ", ".join(f'{{ "{key}", {value}, "{kind}" }}' for kind, key, value in wanted)
    lesson = path.read_text(encoding="utf-8")
    assert lesson.count('require "asperity.guess"') == 1, name
    script = wrapper % table + lesson.replace('require "asperity.guess"', "tried")
    lines = reproduction.printed(script, "--out", name).splitlines()
    tries = [k for k, line in enumerate(lines) if re.match("(Accepted|Wrong) ", line)]
    assert len(tries) == len(wanted), (name, len(tries), len(wanted))
    for k in tries:
        assert lines[k + 1].startswith("You said "), (name, lines[k : k + 2])
        assert bool(accepted.search(lines[k + 1])) == lines[k].startswith("Accepted"), (name, lines[k], lines[k + 1])

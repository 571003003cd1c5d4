#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# docs/accuracy.md calls only one of several ways with the same answer "cheapest", the first one listed. Ways with
# overlapping ranges of time are named next to it, and the arguments of each study are printed below it.
import os
import re

here = os.path.dirname(os.path.abspath(__file__))
with open(os.path.join(here, "../../docs/accuracy.md"), encoding="utf-8") as page:
    text = page.read()
units = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1}
rows, wrong, right = {}, [], 0


def seconds(words):
    number, unit = words.split()
    return float(number) * units[unit]


def settle(name):
    """Each recommended setting of a study against those listed before it that give its digits in its time, unnamed."""
    global right
    for target, setting, line in name:
        if setting not in rows:
            continue
        value, low, high = rows[setting]
        before = list(rows)[:list(rows).index(setting)]
        same = [s for s in before if rows[s][0] == value and rows[s][1] <= high and low <= rows[s][2]
                and s not in line]
        if same:
            wrong.append((target, setting, same))
        else:
            right += 1


chosen = []
for line in text.splitlines():
    if line.startswith("#"):
        settle(chosen)
        rows, chosen = {}, []
    row = re.search(r"(\{ .*? \})\s+([0-9.e+-]+)\s+\S+ %\s+\S+ \S+ \(([^()]+) to ([^()]+)\)", line)
    if row:
        rows[row[1]] = (row[2], seconds(row[3]), seconds(row[4]))
    best = re.match(r"cheapest for (\S+ %): .*?(\{ .*? \})", line)
    if best:
        chosen.append((best[1], best[2], line))
settle(chosen)
assert right + len(wrong) > 5, "the page was not understood"
assert not wrong, wrong
assert text.count("Again: `asperity run examples/accuracy/") == text.count("Script: `examples/accuracy/") > 5, "arguments"

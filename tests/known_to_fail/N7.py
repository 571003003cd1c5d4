#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# N7: docs/accuracy.md recommends ways whose answer is that of another way in the same time. Wanted: "cheapest" only where
# ranges of time do not overlap, of ways whose answers are the same bits one alone, and the arguments of each study
# printed under it. The work on the whole error owns it.
import os
import re

here = os.path.dirname(os.path.abspath(__file__))
with open(os.path.join(here, "../../docs/accuracy.md"), encoding="utf-8") as page:
    text = page.read()
units = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1}
rows, overlapping, alone = {}, [], 0


def seconds(words):
    number, unit = words.split()
    return float(number) * units[unit]


def settle(name):
    """Each recommended setting of a study against all others of the same answer."""
    global alone
    for target, setting in name:
        if setting not in rows:
            continue
        value, low, high = rows[setting]
        same = [s for s, (v, lo, hi) in rows.items() if s != setting and v == value and lo <= high and low <= hi]
        if same:
            overlapping.append((target, setting, same))
        else:
            alone += 1


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
        chosen.append((best[1], best[2]))
settle(chosen)
assert alone + len(overlapping) > 5, "the page was not understood"
print("does not hold:" if overlapping else "holds:", "cheapest is what no other way matches in the same time", overlapping)

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What an addition touches, counted from the worked examples of docs/contributor.md: new files, and places in files that are
there (`<!-- row: PATH -->`, `<!-- place: PATH -->`). `<!-- there: PATH -->` is a file of an addition that the project has. The table
stands in that page.

usage: places.py [FOLDER]           say whether the table is what is counted
       places.py --write [FOLDER]   write it
"""
import pathlib
import re
import sys

BEGIN, END = "<!-- places: tests/contributor/places.py --write -->\n", "<!-- /places -->\n"


def table(text):
    rows = ["| addition | new files | of these tests | places in others |", "| --- | ---: | ---: | ---: |"]
    for title, body in re.findall(r"^## A worked example: a new (.*?)\n(.*?)(?=^## |\Z)", text, re.M | re.S):
        files = re.findall(r"^<!-- (?:file|there): (\S+) -->", body, re.M)
        places = re.findall(r"^<!-- (?:row|place): (\S+) -->", body, re.M)
        tests = sum(path.startswith("tests/") for path in files)
        rows.append(f"| {title} | {len(files)} | {tests} | {len(places)} in {len(set(places))} file{'s' * (len(set(places)) != 1)} |")
    return "\n".join(rows) + "\n"


def main(arguments):
    given = [argument for argument in arguments if argument != "--write"]
    folder = pathlib.Path(given[0]) if given else pathlib.Path(__file__).resolve().parents[2]
    page = folder / "docs" / "contributor.md"
    text = page.read_text(encoding="utf-8")
    before, begin, rest = text.partition(BEGIN)
    old, end, after = rest.partition(END)
    if "--write" in arguments:
        page.write_text(before + begin + table(text) + end + after, encoding="utf-8")
        return 0
    for path in re.findall(r"^<!-- (?:there|row|place): (\S+) -->", text, re.M):
        if not (folder / path).exists():
            print(f"docs/contributor.md: {path} is not there")
            return 1
    if not begin or not end or old != table(text):
        print("docs/contributor.md: the table of places is old: tests/contributor/places.py --write")
        return 1
    print(table(text), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

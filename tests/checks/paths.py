#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that documents name are there: paths in backquotes below engine/, bindings/, scripts/, tests/, examples/, bench/,
docs/, cmake/ or .ci/, in README.md, docs/ and the README.md files of the engine. A name in capitals stands for any.

usage: paths.py [FOLDER]     the project's folder (default: the one this file stands in)
"""
import pathlib
import re
import sys

PATH = re.compile(r"`((?:engine|bindings|scripts|tests|examples|bench|docs|cmake|\.ci)/[\w./-]*\w)`")


def missing(folder):
    pages = [folder / "README.md", *sorted((folder / "docs").glob("*.md")), *sorted((folder / "engine").rglob("README.md"))]
    for page in pages:
        for number, line in enumerate(page.read_text(encoding="utf-8").split("\n"), 1):
            for path in PATH.findall(line):
                if not re.search(r"[A-Z]{2}", path.replace("README", "")) and not (folder / path).exists():
                    yield f"{page.relative_to(folder)}:{number}: there is no {path}"


if __name__ == "__main__":
    root = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2]
    found = list(missing(root))
    print("\n".join(found) if found else "every file that a document names is there")
    sys.exit(1 if found else 0)

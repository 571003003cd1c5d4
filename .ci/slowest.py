#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The twenty slowest tests of the reports that CTest and GoogleTest left in folders.

usage: slowest.py FOLDER..
"""
import pathlib
import sys
import xml.etree.ElementTree as xml


def cases(folder):
    for path in sorted(pathlib.Path(folder).rglob("*.xml")):
        try:
            root = xml.parse(path).getroot()
        except xml.ParseError:
            continue  # of a test that was killed
        # build/reports/release.xml, build/sanitize/reports/test_core-0.xml
        build = path.stem if path.parent.parent.name == "build" else path.parent.parent.name
        for case in root.iter("testcase"):
            name = case.get("name", "")
            if ": shard " in name:
                continue  # its cases stand in reports of their own
            suite = case.get("classname", "")
            yield float(case.get("time") or 0), build, name if suite in ("", name) else f"{suite}.{name}"


found = sorted((case for folder in sys.argv[1:] for case in cases(folder)), reverse=True)
print(f"\n== the twenty slowest of {len(found)} tests")
for seconds, build, name in found[:20]:
    print(f"{seconds:8.2f} s  {build:9} {name.split('  # GetParam')[0]}")

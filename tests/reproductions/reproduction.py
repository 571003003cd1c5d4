# SPDX-License-Identifier: GPL-3.0-or-later
# How each reproduction in Python begins: `begin()` from a file that was called with PROGRAM FOLDER. It stands in the
# emptied folder then, and runs scripts by the program.
import os
import shutil
import subprocess
import sys
import zipfile

program = ""


def begin():
    global program
    program = os.path.abspath(sys.argv[1])
    shutil.rmtree(sys.argv[2], ignore_errors=True)
    os.makedirs(sys.argv[2])
    os.chdir(sys.argv[2])


def run(script, *arguments, name="s.lua"):
    """Runs a script, whose first line is added; what it printed, its complaints and its exit status."""
    with open(name, "w", encoding="utf-8") as file:
        file.write('local lab = require "asperity"\n' + script)
    return subprocess.run([program, "run", name, *arguments], capture_output=True, text=True, timeout=1200, check=False)


def printed(script, *arguments):
    done = run(script, *arguments)
    assert done.returncode == 0, done
    return done.stdout


def refused(script, *words):
    done = run(script)
    assert done.returncode == 1, done
    for word in words:
        assert word in done.stderr, (word, done.stderr)


def write(name, data):
    with open(name, "wb") as file:
        file.write(data if isinstance(data, bytes) else data.encode())


def write_zip(name, entries):
    with zipfile.ZipFile(name, "w") as file:
        for entry, data in entries.items():
            file.writestr(entry, data)


def x3p(points, mask=None, mask_sum="", z="<DataType>D</DataType>", columns=3, rows=2):
    """main.xml of a map of 1 um cells, by ISO 25178-72."""
    axis = "<AxisType>I</AxisType><DataType>D</DataType><Increment>1e-6</Increment>"
    valid = ""
    if mask:
        valid = ("<ValidPointsLink>bindata/valid.bin</ValidPointsLink>"
                 f"<MD5ChecksumValidPoints>{mask_sum}</MD5ChecksumValidPoints>")
    main = ('<?xml version="1.0"?><p:ISO5436_2 xmlns:p="x"><Record1><FeatureType>SUR</FeatureType>'
            f"<Axes><CX>{axis}</CX><CY>{axis}</CY><CZ><AxisType>A</AxisType>{z}</CZ></Axes></Record1>"
            f"<Record3><MatrixDimension><SizeX>{columns}</SizeX><SizeY>{rows}</SizeY><SizeZ>1</SizeZ></MatrixDimension>"
            f"<DataLink><PointDataLink>bindata/data.bin</PointDataLink>{valid}</DataLink></Record3></p:ISO5436_2>")
    entries = {"main.xml": main, "bindata/data.bin": points}
    if mask:
        entries["bindata/valid.bin"] = mask
    return entries

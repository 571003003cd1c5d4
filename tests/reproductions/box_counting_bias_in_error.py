#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# Box counting of fractional Brownian profiles, fractals at all steps (by the method of Davies and Harte). Its bias is part
# of `error`, or the result is unresolved with a reason. The madogram confirms the D of the profiles.
import cmath
import math
import os
import random
import shutil
import struct
import subprocess
import sys

program = os.path.abspath(sys.argv[1])
shutil.rmtree(sys.argv[2], ignore_errors=True)
os.makedirs(sys.argv[2])
os.chdir(sys.argv[2])
points, count = 4096, 8


def fft(values):
    n = len(values)
    if n == 1:
        return values
    even, odd = fft(values[::2]), fft(values[1::2])
    turned = [cmath.exp(-2j * math.pi * k / n) * odd[k] for k in range(n // 2)]
    return [e + t for e, t in zip(even, turned)] + [e - t for e, t in zip(even, turned)]


def profiles(hurst):
    r = [0.5 * (abs(k + 1) ** (2 * hurst) - 2 * k ** (2 * hurst) + abs(k - 1) ** (2 * hurst)) for k in range(points + 1)]
    spectrum = [max(0.0, value.real) for value in fft(r + r[-2:0:-1])]
    made = random.Random(1)
    for _ in range(count):
        noise = fft([math.sqrt(s / (2 * points)) * complex(made.gauss(0, 1), made.gauss(0, 1)) for s in spectrum])
        height = 0.0
        for step in noise[:points]:
            height += step.real
            yield 1e-6 * height


def write_npy(values):
    head = f"{{'descr': '<f8', 'fortran_order': False, 'shape': ({count}, {points}), }}"
    with open("fbm.npy", "wb") as file:
        file.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", 118) + head.ljust(117).encode() + b"\n")
        file.write(struct.pack(f"<{points * count}d", *values))


script = """local lab = require "asperity"
local s = lab.surface.read("fbm.npy", { size={ "4096 um", "8 um" }, unit="m" })
for _, method in ipairs{ "madogram", "box" } do
  local d = s:fractal_dimension{ method=method, along="x" }
  print(d.D, d.error, d.resolved)
end
"""
with open("s.lua", "w", encoding="utf-8") as file:
    file.write(script)
for D in (1.8, 1.7, 1.5):
    write_npy(profiles(2 - D))
    done = subprocess.run([program, "run", "s.lua", "--out", f"R{D}"], capture_output=True, text=True, check=True)
    known, box = (line.split("\t") for line in done.stdout.splitlines())
    assert abs(float(known[0]) - D) < 0.05, (D, known)
    assert box[2] == "false" or abs(float(box[0]) - D) <= 2 * float(box[1]), (D, box)

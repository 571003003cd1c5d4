#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# A SUR with 555 points a line in its head and 563 in its data is refused: its map would be sheared. A size of 1e-43 m and a
# table cut within its last number cause warnings.
import struct

from reproduction import begin, printed, refused, run, write

begin()


def sur(nx, ny, dx=1.0):
    """A file of Digital Surf: a head of 512 bytes, nx at byte 108."""
    text = lambda words, width: words.encode().ljust(width, b"\0")  # noqa: E731
    head = b"DIGITAL SURF" + struct.pack("<hhhh", 0, 1, 1, 2) + text("object", 30) + text("operator", 30)
    head += struct.pack("<hhhhh", 0, 0, 0, 0, 0) + bytes(8) + struct.pack("<hiiiii", 16, 0, 0, nx, ny, nx * ny)
    head += struct.pack("<3f", dx, 1, 1) + text("X", 16) + text("Y", 16) + text("Z", 16)
    head += (text("um", 16) + text("um", 16) + text("nm", 16)) * 2 + struct.pack("<3f", 1, 1, 1)
    assert head[108:112] == struct.pack("<i", nx)
    return head.ljust(512, b"\0") + struct.pack(f"<{nx * ny}h", *(k % 251 for k in range(nx * ny)))


whole = sur(563, 16)
write("f.sur", whole)
assert printed('local s = lab.surface.read "f.sur" print(s.cells[1], s.cells[2])') == "563\t16\n"
write("f.sur", whole[:108] + struct.pack("<i", 555) + whole[112:])
refused('lab.surface.read "f.sur"', "f.sur", "256 too many")

write("cut.txt", "1 2\n3 4\n5 6.2")
assert "no line end" in run('lab.surface.read("cut.txt", { size=1e-3, unit="um" })').stderr
write("tiny.txt", "h=2 w=2\npixel size=1e-43 m\n1 2\n3 4\n")
assert "1e-43 m apart" in run('lab.surface.read("tiny.txt", { size=2e-43, unit=1e-60 })').stderr

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# Height maps are read from SPIP with a head in UTF-16, X3P by Alicona with infinite heights for missing points, X3P zipped
# with its folder, and tables of two columns under a head with units. An unsupported kind is named with a way to convert it,
# and the error of a damaged file names its kind.
import math
import struct

from reproduction import begin, printed, refused, write, write_zip, x3p

begin()
head = ("fileformat = bcrf_unicode\nheadersize = 2048\nxpixels = 3\nypixels = 2\nxlength = 3000\nylength = 2000\n"
        "intelmode = 1\n")
write("a.bcrf", head.ljust(2048, "%").encode("utf-16-le") + struct.pack("<6f", 1, 2, 3, 4, 5, 6))
# The file stores its top line first; the lowest line has j = 0.
assert printed('print(lab.surface.read("a.bcrf"):height(2, 0) / 1e-9)').startswith("6.0")

heights = [1e-6, 2e-6, math.inf, 4e-6, 5e-6, 6e-6]
write_zip("alicona.x3p", x3p(struct.pack("<6d", *heights)))
assert printed('local s = lab.surface.read "alicona.x3p" print(s:height(2, 0), s:height(1, 0))') == "nan\t2e-06\n"
assert printed('print(lab.surface.read("alicona.x3p", { fill=0 }):height(2, 0))').strip() == "0.0"

heights[2] = 3e-6
plain = x3p(struct.pack("<6d", *heights))
write_zip("plain.x3p", plain)
write_zip("folder.x3p", {"My Map/" + name: data for name, data in plain.items()})
assert printed('print(lab.surface.read "folder.x3p" == lab.surface.read "plain.x3p")') == "true\n"

write("utf16.txt", "1 2\n3 4\n".encode("utf-16"))
assert printed('print(lab.surface.read("utf16.txt", { size=1e-3, unit="um" }):height(1, 1) / 1e-6)').strip() == "4.0"

write("trace.csv", "x [mm],z [um]\n0,1\n0.1,2\n0.2,4\n")
assert printed('print(lab.profile.read("trace.csv"):heights()[3] / 1e-6)').startswith("4.0")

rest = bytes(64)
for name, data, what in [
    ("trace.prf", "Stylus profiler\nOperator Li\n\n0.0 1.2\n0.1 1.3\n0.2 1.1\n", "has a head in lines 1 "),
    ("map.al3d", b"AliconaImaging\0\r\n" + rest, "Alicona"),
    ("map.vk4", b"VK4_" + rest, "Keyence"),
    ("map.opdx", b"VCA DATA\x01\0\0U" + rest, "Bruker"),
    ("map.nc", b"CDF\x01\0" + rest, "NetCDF"),
]:
    write(name, data)
    refused(f'lab.surface.read("{name}", {{ size=1e-3, unit="um" }})', name, what)

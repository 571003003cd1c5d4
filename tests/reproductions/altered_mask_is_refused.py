#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# An X3P whose mask of valid points differs from its checksum by one byte is refused, like altered heights.
import hashlib
import struct

from reproduction import begin, printed, refused, write_zip, x3p

begin()
mask = b"\x3b"
read = 'print(lab.surface.read("NAME", { fill=0 }):roughness().Rq)'
entries = x3p(struct.pack("<6d", 0, 1e-6, 2e-6, 3e-6, 4e-6, 5e-6), mask, hashlib.md5(mask).hexdigest())
write_zip("in.x3p", entries)
printed(read.replace("NAME", "in.x3p"))
entries["bindata/valid.bin"] = bytes([mask[0] ^ 255])
write_zip("out.x3p", entries)
refused(read.replace("NAME", "out.x3p"), "is damaged", "valid points")

-- SPDX-License-Identifier: GPL-3.0-or-later
-- A height map packed with gzip is read.
local lab = require "asperity"
local file <close> = assert(io.open("map.txt.gz", "wb"))
file:write "\x1F\x8B\x08\x00\x00\x00\x00\x00\x02\x03\x33\x54\x30\xE2\x32\x56\x30\xE1\x02\x00\x57\x00\xD6\x61\x08\x00\x00\x00"
file:close()
local s = lab.surface.read("map.txt.gz", { size=1e-3, unit="um" })
assert(s.cells[1] == 2 and s.cells[2] == 2 and math.abs(s.peak_to_valley - 3e-6) < 1e-18, s)

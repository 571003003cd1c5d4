-- SPDX-License-Identifier: GPL-3.0-or-later
-- Points whose head names millimetres and micrometres have this size and these heights; a contradicting `unit` of the call
-- is refused.
local lab = require "asperity"
local file <close> = assert(io.open("own.txt", "w"))
file:write "x [mm];y [mm];z [um]\n0;0;1,2\n0,1;0;1,5\n0,2;0;1,1\n0;0,1;0,9\n0,1;0,1;2,0\n0,2;0,1;1,7\n"
file:flush()
local s = lab.surface.read "own.txt"
assert(s.cells[1] == 3 and s.cells[2] == 2)
assert(math.abs(s.size[1] - 0.3e-3) < 1e-12 and math.abs(s.size[2] - 0.2e-3) < 1e-12, s.size[1])
assert(math.abs(s:height(1, 1) - 2e-6) < 1e-15)
assert(lab.surface.read("own.txt", { unit="um" }) == s)
assert(not pcall(lab.surface.read, "own.txt", { unit="mm" }))

-- SPDX-License-Identifier: GPL-3.0-or-later
-- A string joined to a surface runs a function of the sandbox; the error names the line of the script.
--! exit: 1
--! error: error_in_sandbox.lua:7: a * 2: the sides are the string "2" and a surface
--! not error: asperity: sandbox
local lab = require "asperity"
print("2" * lab.surface.sine{ cells=16, size="1 mm", amplitude="1 um" })

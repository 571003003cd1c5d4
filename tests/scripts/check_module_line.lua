-- SPDX-License-Identifier: GPL-3.0-or-later
-- How far a script was followed is said by its own line, also where a module is the one that cannot go on.
--! command: check
--! output: checked to line 9: the script's path depends on a result
local lab = require "asperity"
local s = lab.surface.sine{ cells=64, size=1, amplitude="1 um" }
local larger = require "runner.larger"
local function compare(a) return larger(a, 2) end
print(compare(s:roughness().Ra))

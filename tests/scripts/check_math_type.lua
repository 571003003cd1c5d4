-- SPDX-License-Identifier: GPL-3.0-or-later
-- math.type of a number that is known is Lua's own answer; of a placeholder it is not known.
--! command: check
--! output: checked to line 8
local lab = require "asperity"
if math.type(3) ~= "integer" or math.type("x") or type(2) ~= "number" then error("math.type is not itself") end
local Ra = lab.surface.flat{ cells=4096, size=1 }:roughness().Ra
if math.type(Ra) == "integer" then error("not a float") end

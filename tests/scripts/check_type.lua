-- SPDX-License-Identifier: GPL-3.0-or-later
-- What type() says of a placeholder is not what it says of the number in a run.
--! command: check
--! output: checked to line 8
local lab = require "asperity"
local s = lab.surface.flat{ cells=4096, size=1 }
local Ra = s:roughness().Ra
if type(Ra) ~= "number" then error("not a number") end

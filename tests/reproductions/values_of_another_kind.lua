-- SPDX-License-Identifier: GPL-3.0-or-later
-- Values of another kind are refused, converted or named, never ignored.
--! error: too large to draw
local lab = require "asperity"
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").with
refused("given nothing", function() lab.material(nil) end)
refused("rows of numbers", function() lab.surface.from_table{ size=1, heights={ 1, 2, 3 } } end)
local b = lab.notebook "z"
b:write{ ["z [m]"]="1 um" }
assert(b:rows()[1].z == 1e-6)
local n = lab.notebook "n"
for k, a in ipairs{ 1, 2e300, 3 } do n:write{ a=a, b=k } end
n:chart{ x="b", y="a" }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Heights whose square exceeds the range of a double are refused by name.
local lab = require "asperity"
local ok, message = pcall(function()
  local s = lab.surface.sine{ cells=8, size=1, amplitude=1e154, material=lab.material{ young=1e11, poisson=0 } }
  lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }:press{ pressure=1e165 }
end)
assert(not ok and message:find("range of a double", 1, true) and message:find("unit", 1, true), message)

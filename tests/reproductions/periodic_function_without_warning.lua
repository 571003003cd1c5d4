-- SPDX-License-Identifier: GPL-3.0-or-later
-- A periodic surface from a function causes no warning of a step at the rim.
--! not error: warning
--! not error: rim
local lab = require "asperity"
local s = lab.surface.from_function{ cells=32, size=1e-3, material=lab.material "Al-2011",
  height=function(x, y) return 1e-6 * math.cos(2e3 * math.pi * x) * math.sin(2e3 * math.pi * y) end }
lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }:press{ pressure=1e6 }

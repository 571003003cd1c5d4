-- SPDX-License-Identifier: GPL-3.0-or-later
-- Texts under heads of their own are read: a matrix whose head does not describe it, and a trace whose last line of the head
-- names its columns.
local lab = require "asperity"
local function written(name, data)
  local file <close> = assert(io.open(name, "wb"))
  file:write(data)
  return name
end
local map = lab.surface.read(written("head.txt", "Stylus profiler\nOperator Li\nSpeed 0.5 mm/s\n\n1 2\n3 4\n"), { size=1e-3, unit="um" })
assert(map.cells[1] == 2 and math.abs(map:height(0, 1) - 3e-6) < 1e-18, map)
local trace = lab.profile.read(written("trace.prf", "Stylus profiler\nOperator Li\nx [mm],z [um]\n0,1\n0.1,2\n0.2,4\n"))
assert(math.abs(trace.spacing - 1e-4) < 1e-16 and math.abs(trace:heights()[3] - 4e-6) < 1e-18, trace)

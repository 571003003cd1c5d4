-- SPDX-License-Identifier: GPL-3.0-or-later
-- F7: forms of height maps that are named and not read. Wanted: text with a head of its own is read as it is. The work
-- on measurements owns it.
local lab = require "asperity"
local function claim(name, data, call)
  local file <close> = assert(io.open(name, "wb"))
  file:write(data)
  file:close()
  local ok, found = pcall(call, name)
  print((ok and "holds: " or "does not hold: ") .. name, found)
end
local function map(name) return lab.surface.read(name, { size=1e-3, unit="um" }) end
claim("head.txt", "Stylus profiler\nOperator Li\nSpeed 0.5 mm/s\n\n1 2\n3 4\n", map)
claim("trace.prf", "Stylus profiler\nOperator Li\nx [mm],z [um]\n0,1\n0.1,2\n0.2,4\n", function(name) return lab.profile.read(name) end)

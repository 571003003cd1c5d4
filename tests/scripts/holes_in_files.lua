-- SPDX-License-Identifier: GPL-3.0-or-later
-- Points that were not measured stay missing: through files of each kind, the cases of an ensemble and their store.
--! output: as they were measured
local lab = require "asperity"
local function file_of(name, text)
  local file <close> = assert(io.open(name, "w"))
  file:write(text)
  return name
end
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
local function missing(height) return height ~= height end

local text = file_of("map.txt", "1 2 nan 4\n5 bad 7 8\n9 10 11 12\n")
local um = { size={ "4 um", "3 um" }, unit="um" }
local s = lab.surface.read(text, um)
assert(missing(s:height(2, 0)) and missing(s:height(1, 1)) and s:height(1, 0) == 2e-6)
assert(s.peak_to_valley == 11e-6)
um.fill = 0
assert(lab.surface.read(text, um):height(2, 0) == 0)
um.fill = "interpolate"
assert(lab.surface.read(text, um):height(2, 0) > 0)

for _, name in ipairs{ "s.x3p", "s.h5", "s.gwy", "s.txt", "s.csv" } do
  local back = lab.surface.read(s:write(name))
  assert(back == s and back.digest == s.digest, name)
  assert(lab.surface.read(name, { fill="interpolate" }) ~= s)
end
assert(lab.surface.read(s:write "s.npy", { size=s.size, unit="m" }) == s)
local steps = lab.surface.read(s:write "s.sur")
assert(missing(steps:height(2, 0)) and math.abs(steps:height(3, 2) - 12e-6) < 1e-13)

local p = lab.profile.read(file_of("trace.csv", "x [um],z [nm]\n0,1\n1,\n2,3\n3,5\n"))
assert(lab.profile.read(p:write "p.csv") == p)

-- Calls that need every point are refused, with a missing node.
refused(function() lab.spread.read("s.npy", { size=s.size }) end, "has no height at node (2, 0)", "`fill`")

-- Cases of an ensemble hand them over as they are.
local rows = lab.ensemble{ over={ k={ 1, 2 } }, run=function() return { s=s, p=p } end }
for k = 1, 2 do assert(rows[k].s == s and rows[k].p == p and missing(rows[k].s:height(2, 0))) end

-- An ambiguous lattice stays an error.
refused(function() lab.surface.read(file_of("three.txt", "0 0 1\n1 0 2\n0 1 3\n"), { unit="um", unit_xy="um" }) end,
  '`format` = "xyz"', '`format` = "text"')
local three = lab.surface.read("three.txt", { unit="um", unit_xy="um", format="xyz" })
assert(missing(three:height(1, 1)) and three:height(0, 1) == 3e-6)
refused(function() lab.surface.read(file_of("void.txt", "nan nan\nnan nan\n"), { size=1, unit="um" }) end,
  "holds no height, only missing points")
print "as they were measured"

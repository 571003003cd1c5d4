-- SPDX-License-Identifier: GPL-3.0-or-later
-- Tables of points: the units of their heads, points missing, and profiles of two columns.
--! output: as they were measured
local lab = require "asperity"
local function file_of(name, text)
  local file <close> = assert(io.open(name, "w"))
  file:write(text)
  return name
end
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
local function near(a, b) assert(math.abs(a - b) <= 1e-12 * math.abs(b), a .. " is not " .. b) end

local own = file_of("own.txt", "x [mm];y [mm];z [um]\n0;0;1,2\n0,1;0;1,5\n0,2;0;1,1\n0;0,1;0,9\n0,1;0,1;2,0\n0,2;0,1;1,7\n")
local s = lab.surface.read(own)
assert(s.cells[1] == 3 and s.cells[2] == 2)
near(s.size[1], 0.3e-3)
near(s.size[2], 0.2e-3)
near(s:height(1, 1), 2e-6)
assert(lab.surface.read(own, { unit="um", unit_xy="mm" }) == s)
refused(function() lab.surface.read(own, { unit="mm" }) end, "heights in units of 1 um, and `unit` is 1 mm")
refused(function() lab.surface.read(own, { unit_xy="um" }) end, "positions in units of 1 mm, and `unit_xy` is 1 um")

local bare = file_of("bare.txt", "0 0 1\n0.5 0 2\n0 0.5 3\n0.5 0.5 4\n")
refused(function() lab.surface.read(bare, { unit="um" }) end, "does not say the unit of its positions", "`unit_xy`")
near(lab.surface.read(bare, { unit="um", unit_xy="mm" }).size[1], 1e-3)
near(lab.surface.read(bare, { unit="um", size="2 mm" }).size[1], 2e-3)

local three = file_of("hx3.txt", "0\t0\t1\n1\t0\t2\n0\t1\t3\n")
refused(function() lab.surface.read(three, { unit="um" }) end, '`format` = "xyz"', '`format` = "text"')
refused(function() lab.surface.read(three, { unit="um", size="1 mm" }) end, '`format` = "xyz"')
local filled = lab.surface.read(three, { unit="um", unit_xy="mm", format="xyz", fill=0 })
assert(filled.cells[1] == 2 and filled:height(1, 1) == 0)
local matrix = lab.surface.read(three, { unit="um", size="1 mm", format="text" })
assert(matrix.cells[1] == 3 and matrix.cells[2] == 3)
refused(function() lab.surface.read(file_of("m.txt", "1 2\n3 4\n"), { unit="um", size=1, unit_xy="mm" }) end, "holds no positions")

local trace = lab.profile.read(file_of("trace.csv", "x [mm],z [um]\n0,1\n0.1,2\n0.2,4\n"))
near(trace.length, 0.3e-3)
near(trace:heights()[3], 4e-6)
refused(function() lab.profile.read(file_of("two.csv", "0,1\n0.1,2\n0.2,4\n"), { unit="um" }) end, "`unit_xy`")

for name, what in pairs{ ["map.gz"]="packed with gzip", ["map.xls"]="a compound document" } do
  local marks = { ["map.gz"]="\x1f\x8b\8\0\0\0", ["map.xls"]="\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1\0\0" }
  refused(function() lab.surface.read(file_of(name, marks[name])) end, name .. '" is ' .. what)
end
print "as they were measured"

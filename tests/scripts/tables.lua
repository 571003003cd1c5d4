-- SPDX-License-Identifier: GPL-3.0-or-later
-- Tables as values: read from a file, chosen from, joined, written and read back; a notebook is one too.
--! exit: 0
--! output: scans/angles.txt": 4 rows of 3 columns
--! output:   N angle [°]  tag
--! output: all held
local lab = require "asperity"
local function near(a, b) assert(math.abs(a - b) <= 1e-12 * math.abs(b), tostring(a) .. " is not " .. tostring(b)) end
local function write(path, text)
  local file <close> = assert(io.open(path, "w"))
  file:write(text)
end
write("scans/angles.txt", "Versuch;Winkel [\u{b0}];tag\n1;30;new\n2;33,5;new\n4;36;worn\n8;;worn\n")
local t = lab.table.read("scans/angles.txt", { columns={ angle="Winkel", N="Versuch" } })
print(t)
assert(#t == 4 and table.concat(t.columns, " ") == "N angle tag")
assert(t.units.angle == "\u{b0}" and t.units.N == nil)
local rows = t:rows()
assert(math.type(rows[3].N) == "integer" and rows[4].angle == nil and rows[4].tag == "worn")
near(rows[2].angle, math.rad(33.5))
assert(#t:where{ tag="new" } == 2 and #t:where{ angle={ "30 deg", "36 deg" } } == 2)
local angles = t:column "angle"
assert(#angles == 4 and angles[4] ~= angles[4])
-- A written table reads back the same.
local again = lab.table.read(t:write "copy.csv")
assert(again == t and again.digest == t.digest and again ~= t:where{ tag="new" })
-- Joined to computed rows in a notebook.
local book = lab.notebook("computed", { columns={ "N", "mu" } })
for _, N in ipairs{ 1, 2, 4 } do book:write{ N=N, mu=0.5 + 0.01 * N } end
assert(#book:where{ N={ 1, 4 } } == 2 and book:column "mu"[2] == 0.52 and #book:table() == 3)
local both = t:joined(book, { by="N", unmatched="leave out" })
assert(#both == 3 and table.concat(both.columns, " ") == "N angle tag mu")
assert(both:rows()[3].mu == 0.54)
assert(#book:joined(t, { by="N" }) == 3)
assert(both == lab.table.from(both:rows(), { columns=both.columns }) == false) -- the unit is not in the rows
local made = lab.table.from({ { N=1, ["angle [deg]"]=30 }, { N=2, angle="33.5 deg" } }, { columns={ "N" } })
assert(made.units.angle == "deg")
near(made:rows()[2].angle, math.rad(33.5))
-- A folder, in alphabetical order.
write("scans/b10.txt", "x\n1\n")
write("scans/b9.txt", "x\n1\n")
local files = lab.files "scans/*.txt"
assert(table.concat(files, " ") == "scans/angles.txt scans/b10.txt scans/b9.txt", table.concat(files, " "))
assert(#lab.files "scans/b?.txt" == 1 and #lab.table.read(files[3]) == 1)
-- Quantities.
assert(lab.quantity "250 um" == 2.5e-4 and lab.quantity(3) == 3)
assert(lab.quantity("640 HV", "pressure") == 640 * 9806650 and lab.quantity("37 deg", "rad") == math.rad(37))
print "all held"

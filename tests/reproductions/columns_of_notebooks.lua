-- SPDX-License-Identifier: GPL-3.0-or-later
-- Columns of a table came in alphabetical order, and rows() turned 1 into 1.0. They come in the given order, else in the
-- order of their names, because Lua has no order; integers stay integers.
local lab = require "asperity"
local b = lab.notebook("n", { columns={ "z", "a", "share [%]" } })
b:write{ b=true, a=2, z=1, ["share [%]"]=10 }
b:write{ z=100000, c=0.5, a=1e6 }
local lines = {}
for line in io.lines "n.csv" do lines[#lines + 1] = line end
assert(table.concat(lines, "|") == "z,a,share [%],b,c|1,2,10,true,|100000,1000000,,,0.5", table.concat(lines, "|"))
assert(math.type(b:rows()[1].z) == "integer" and math.type(b:rows()[2].a) == "float")
assert(tostring(b:rows()[2].z) == "100000")
local other = lab.notebook "n"
assert(select(2, pcall(lab.notebook, "n", { columns={ "a", "z" } })):find("already have another order", 1, true))
assert(lab.notebook("n", { columns={ "z", "a", "share [%]" } }).name == other.name)
local plain = lab.notebook "plain"
plain:write{ z=1, a=2 }
assert(assert(io.open "plain.csv"):read "l" == "a,z")

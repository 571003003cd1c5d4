-- SPDX-License-Identifier: GPL-3.0-or-later
-- Columns of a table come in alphabetical order, and rows() turns 1 into 1.0. Wanted: columns in the order in which they were
-- first written, where it can be known or is given, on the page too; integers stay integers. The work on measurements
-- owns it.
local lab = require "asperity"
local function claim(name, holds, ...) print((holds and "holds: " or "does not hold: ") .. name, ...) end
local b = lab.notebook "n"
b:write{ z=1, a=2, ["share [%]"]=10 }
local head = assert(io.open "n.csv"):read "l"
claim("columns in the order of writing", head == "z,a,share [%]", head)
claim("integers stay", math.type(b:rows()[1].z) == "integer", b:rows()[1].z)

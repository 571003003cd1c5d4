-- SPDX-License-Identifier: GPL-3.0-or-later
-- A string with a unit is compared in the unit of the column; another dimension is refused.
local lab = require "asperity"
local b = lab.notebook "n"
b:write{ ["p [MPa]"]=10 }
assert(b:expect("p", { near="10 MPa", rel=0.1 }))
assert(b:expect("p", { at_least="5 MPa" }))
local ok, message = pcall(b.expect, b, "p", { near="10 N", rel=0.1 })
assert(not ok and message:find("a force", 1, true), message)

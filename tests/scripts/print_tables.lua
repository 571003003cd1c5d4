-- SPDX-License-Identifier: GPL-3.0-or-later
-- A table is printed by its content: an address would differ in every run.
--! output: { 1, 2, 3 }	{ a = 1, b = "x" }	{}
--! output: { "first", { 2, 3 } }	nil	true
--! output: a sphere
--! output: trials:	{ 1, 2 }
--! output: { 2.8, nan, 3 } um	{ 1, 2 }
--! not output: 0x
local lab = require "asperity"
print({ 1, 2, 3 }, { b="x", a=1 }, {})
print({ "first", { 2, 3 } }, nil, true)
print(setmetatable({}, { __tostring=function() return "a sphere" end }))
lab.ensemble{ over={ k={ 1 } }, run=function() print("trials:", { 1, 2 }) return { a=1 } end }
local events = lab.table.from{ { N=1, ["Ra [um]"]=2.8 }, { N=2 }, { ["Ra [um]"]=3 } }
print(events:column "Ra", lab.table.from{ { N=1 }, { N=2 } }:column "N")

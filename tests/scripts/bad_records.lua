-- SPDX-License-Identifier: GPL-3.0-or-later
-- Rows, charts and names that a notebook refuses; what was written before is on disk.
--! output: all refused
--! file: kept.csv: 41
--! file: kept.csv: 42
local lab = require "asperity"
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
local book = lab.notebook "kept"
book:write{ a=41 }
refused(function() lab.notebook "" end, "a notebook has an empty name")
refused(function() lab.notebook() end, "`name` is nothing (nil)")
refused(function() book:write{} end, "a notebook row has no columns")
refused(function() book:write(3) end, "a row is a table of columns, and was given as the number 3")
refused(function() book:write{ 1, 2 } end, "a column is named by the number 1")
refused(function() book:write{ a={} } end, "column `a` is an empty table")
refused(function() book:expect("a") end, "has no condition")
refused(function() book:expect("a", { near=1 }) end, "`near` needs a width")
refused(function() book:chart{ x="a" } end, "`y` is missing")
refused(function() book:chart{ x="a", y="q" } end, "`y` names `q`, which is no column")
refused(function() book:chart{ x="a", y="a", file="../x.svg" } end, "is outside the run directory")
refused(function() book:chart{ x="a", y="a", file="x.gif" } end, "pictures are .svg, .png or .pdf")
book:write{ a=42 }
print "all refused"

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Heights that are no numbers, from tables, functions and phases.
--! output: all refused
local lab = require "asperity"
local S = lab.surface
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
refused(function() S.from_table{ size=1, heights={ { 1, 0/0 } } } end, "finite")
refused(function() S.from_table{ size=1, heights={ { 1, math.huge } } } end, "finite")
refused(function() S.from_table{ size=1, heights={ { 1, "2" } } } end, 'heights[1][2] is the string "2"')
refused(function() S.from_table{ size=1, heights={ { 1, 2 }, { 3 } } } end, "row 2 of `heights` is a table of 1")
refused(function() S.from_table{ size=1, heights={} } end, "a table of rows of numbers")
refused(function() S.from_table{ size=1, heights={ {} } } end, "its first row is empty")
refused(function() S.from_function{ cells=4, size=1, height=function() return 0/0 end } end, "finite")
refused(function() S.from_function{ cells=4, size=1, height=function() return "1" end } end, "returned the string \"1\"")
refused(function() S.from_function{ cells=4, size=1, height=function() error "no" end } end, "the function `height` failed", "no")
refused(function() S.from_function{ cells=4, size=1, height=function() coroutine.yield() end } end, "outside a coroutine")
refused(function() S.weierstrass_mandelbrot{ cells=4, D=2.5, phases=function() return 0/0 end } end, "phases")
refused(function() S.weierstrass_mandelbrot{ cells=4, D=2.5, phases=function() end } end, "returned nothing (nil)")
print "all refused"

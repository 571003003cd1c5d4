-- SPDX-License-Identifier: GPL-3.0-or-later
-- A log with mistakes: the run ends with the script's line, the file's name, and every line and column.
--! exit: 1
--! error: bad_press_log.lua:14: 
--! error: log.txt" has 3 problems
--! error:   line 2, column 2 (pressure): "-3" is negative
--! error:   line 3, column 1 (time): the time 5 s runs backwards, after 10 s
--! error:   line 4: there are 3 cells under 2 heads
--! not output: accepted
local lab = require "asperity"
local file = assert(io.open("log.txt", "w"))
file:write "time [s],pressure [MPa]\n10,-3\n5,1\n20,1,1\n"
file:close()
lab.protocol.read "log.txt"
print "accepted"

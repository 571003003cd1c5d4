-- SPDX-License-Identifier: GPL-3.0-or-later
-- Standard output is the script's own: nothing of the program's is on it.
--! output: only this
--! not output: results in
--! error: results in
--! error: to standard error
local lab = require "asperity"
io.stderr:write "to standard error\n"
local s = lab.surface.flat{ cells=8, size=1 }
print "only this"

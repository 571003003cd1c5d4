-- SPDX-License-Identifier: GPL-3.0-or-later
--! stop at: ready
--! exit: 130
--! error: interrupted
local lab = require "asperity"
io.stdout:setvbuf "no"
print "ready"
lab.surface.from_function{ cells=8192, size=1, height=function() return 0 end }

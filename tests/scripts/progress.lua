-- SPDX-License-Identifier: GPL-3.0-or-later
-- Work of over a second says how far it is and how long it will take, on standard error.
--! flags: --limit-time 5s
--! exit: 1
--! error:  %, about 
--! error:  left
--! not output: %
local lab = require "asperity"
lab.surface.from_function{ cells=8192, size=1, height=function() return 0 end }

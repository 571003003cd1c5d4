-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --limit-time 500ms
--! exit: 1
--! error: the time limit
local lab = require "asperity"
lab.surface.from_function{ cells=8192, size=1, height=function() return 0 end }

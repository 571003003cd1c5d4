-- SPDX-License-Identifier: GPL-3.0-or-later
-- A coroutine that catches its own end is ended from outside.
--! flags: --limit-time 2s
--! exit: 1
--! error: the time limit
--! file: rows.csv: 1
local lab = require "asperity"
lab.notebook "rows":write{ a=1 }
coroutine.wrap(function() while true do pcall(function() while true do end end) end end)()

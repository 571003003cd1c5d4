-- SPDX-License-Identifier: GPL-3.0-or-later
-- The line that ran, with a traceback.
--! flags: --limit-time 2s --trace
--! exit: 1
--! error: the time limit
--! error: limit_loop.lua:12: the time limit of the run is reached
--! error: limit_loop.lua:12: in main chunk
--! file: manifest.json: "status": "failed"
--! file: rows.csv: 1
local lab = require "asperity"
lab.notebook "rows":write{ a=1 }
while true do end

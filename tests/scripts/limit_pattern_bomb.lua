-- SPDX-License-Identifier: GPL-3.0-or-later
-- Inside a C function of Lua no hook runs: the watchdog ends the process, and rows are safe.
--! flags: --limit-time 2s
--! exit: 1
--! error: the time limit
--! file: rows.csv: 1
--! file: manifest.json: "status": "killed"
local lab = require "asperity"
lab.notebook "rows":write{ a=1 }
string.rep("a", 1e5):find((".-"):rep(60) .. "b")

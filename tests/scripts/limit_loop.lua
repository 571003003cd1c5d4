-- SPDX-License-Identifier: GPL-3.0-or-later
--! flags: --limit-time 500ms
--! exit: 1
--! error: the time limit
--! file: manifest.json: "status": "failed"
--! file: rows.csv: 1
local lab = require "asperity"
lab.notebook "rows":write{ a=1 }
while true do end

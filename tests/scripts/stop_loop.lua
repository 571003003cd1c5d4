-- SPDX-License-Identifier: GPL-3.0-or-later
-- Ctrl-C in Lua: the run ends with 130 and its records are whole.
--! stop at: ready
--! exit: 130
--! error: interrupted
--! file: manifest.json: "status": "interrupted"
--! file: journal.jsonl: "event":"end","status":"interrupted"
--! file: rows.csv: 400
local lab = require "asperity"
local book = lab.notebook "rows"
for k = 1, 400 do book:write{ k=k, square=k * k, name="row, " .. k } end
io.stdout:setvbuf "no"
print "ready"
while true do end

-- SPDX-License-Identifier: GPL-3.0-or-later
--! stop at: ready
--! exit: 130
--! error: interrupted
--! file: manifest.json: "status": "interrupted"
local lab = require "asperity"
local book = lab.notebook "rows"
io.stdout:setvbuf "no"
print "ready"
local k = 0
while true do
  k = k + 1
  book:write{ k=k, text="row " .. k }
end

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Ctrl-C between the first run and the end of a repeated one, which never comes.
--! command: accuracy
--! stop at: as written
--! exit: 130
--! error: interrupted
--! file: manifest.json: "status": "interrupted"
local lab = require "asperity"
local n = lab.surface.flat{ cells=64, size=1 }.cells[1]
if n == 64 then print "as written" end
while n ~= 64 do end
return n

-- SPDX-License-Identifier: GPL-3.0-or-later
-- A chart of more points than a vector drawing should hold is drawn, with a word; as PNG without.
--! error: 100001 points are drawn and stored in the file; a .png is smaller
local lab = require "asperity"
local rows = {}
for k = 1, 100001 do rows[k] = { x = k, y = k % 7 } end
local t = lab.table.from(rows)
t:chart{ x = "x", y = "y", file = "many.svg" }
t:chart{ x = "x", y = "y", file = "many.png" }

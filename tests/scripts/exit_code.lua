-- SPDX-License-Identifier: GPL-3.0-or-later
-- os.exit keeps what was written, and its code is that of the program.
--! exit: 3
--! output: before
--! not output: after
--! file: rows.csv: 7
--! file: manifest.json: "reason": "os.exit(3)"
local lab = require "asperity"
local book = lab.notebook "rows"
book:write{ a=7 }
print "before"
os.exit(3)
print "after"

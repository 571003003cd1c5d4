-- SPDX-License-Identifier: GPL-3.0-or-later
-- Where nothing can be asked, the process is ended after a grace period.
--! stop at: ready
--! exit: 130
--! error: interrupted
--! file: rows.csv: 1
--! file: manifest.json: "status": "interrupted"
local lab = require "asperity"
lab.notebook "rows":write{ a=1 }
io.stdout:setvbuf "no"
print "ready"
string.rep("a", 1e5):find((".-"):rep(60) .. "b")

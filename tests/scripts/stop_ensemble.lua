-- SPDX-License-Identifier: GPL-3.0-or-later
-- Ctrl-C in the cases of an ensemble.
--! stop at: ready
--! exit: 130
--! error: interrupted
--! file: manifest.json: "status": "interrupted"
--! file: rows.csv: 1
local lab = require "asperity"
lab.notebook "rows":write{ a=1 }
io.stdout:setvbuf "no"
print "ready"
lab.ensemble{ over={ seed={ 1, 2, 3, 4 } }, run=function(case)
  while true do end
end }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Ctrl-C in a study: what was measured is kept.
--! stop at: ready
--! exit: 130
--! error: interrupted
--! file: manifest.json: "status": "interrupted"
--! file: journal.jsonl: "knobs":{"n":1},"round":0,"value":1
--! file: work_precision.csv: a,1,measured,1,
local lab = require "asperity"
io.stdout:setvbuf "no"
lab.work_precision{ truth=2, try={ { name="a", n={ 1, 2 } } }, ask=function(knobs)
  if knobs.n == 2 then
    print "ready"
    while true do end
  end
  return 1
end }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- An exact truth: twice the cells are then a setting like the others. Nothing but the grid can be varied here;
-- a factor of 1/4 makes 5 cells of 20 and 5 of 21, and resampling follows.
--! command: accuracy
--! flags: --truth 1 --repeats 1 --at-most 20min
--! output: truth 1
--! output: { cells_factor=2
--! not output: tolerance
--! file: journal.jsonl: "knobs":{"cells_factor":0.25},"round":0,"value":5.25
--! file: journal.jsonl: "knobs":{"cells_factor":2.0},"round":0,"value":42
local lab = require "asperity"
local s = lab.surface.sine{ cells={ 20, 21 }, size={ 1, 1.05 }, amplitude="1 mm" }
local cells = s:resampled{ cells={ 21, 20 } }.cells
assert(math.abs(cells[1] - s.cells[2]) <= 1)
local rows = lab.ensemble{ over={ n={ 1, 2 } }, run=function(case)
  return { cells=lab.surface.flat{ cells=21, size=1 }.cells[1] }
end }
assert(rows[1].cells == cells[1])
return cells[1] + (cells[1] == 5 and 0.25 or 0)

-- SPDX-License-Identifier: GPL-3.0-or-later
-- What accuracy costs a script that returns a number: its output is shown once, what it writes is kept once.
--! command: accuracy
--! flags: --repeats 2
--! args: 48
--! error: work and precision: 8 settings, each timed 2 times after a first run: about 
--! error: the truth { cells_factor=2, tolerance=1e-08 } takes about 
--! output: pressed on 48 cells
--! not output: pressed on 96 cells
--! output: { cells_factor=0.25 }
--! output: { tolerance=1e-04 }
--! output: cells_factor multiplies every `cells` that the script gives
--! output: the script's own is 1e-05 at the tightest
--! file: accuracy.csv: way,cells_factor,tolerance,end,value,error
--! file: accuracy.svg: tighter tolerance
--! file: presses.csv: 48
--! file: journal.jsonl: "event":"study run"
local lab = require "asperity"
local cells = tonumber(...)
local ball = lab.surface.sphere{ cells=cells, size="40 um", radius="100 um", material=lab.material "steel" }
local c = lab.contact{ lower=ball, upper=lab.rigid, boundary="free", effects={ elasticity="half_space" },
                       accuracy={ tolerance=1e-5 } }
lab.notebook "presses":write{ cells=ball.cells[1] }
print("pressed on " .. ball.cells[1] .. " cells")
return c:press{ load="50 mN" }.approach

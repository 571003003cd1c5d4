-- SPDX-License-Identifier: GPL-3.0-or-later
-- A case that fails is told at once, the others run on and are kept, and the run does not pass for done.
--! exit: 1
--! error: warning: case load = 2000, seed = 1 failed: 
--! error: 2 of 6 cases failed, and the other 4 ran (their results are in ensemble_kept.csv)
--! error:   case load = 2000, seed = 2: 
--! output: reported 2 of 6
--! output: first failed at seed 1
--! file: ensemble_kept.csv: area,load,seed
--! file: ensemble_kept.csv: ,1000,2
--! file: journal.jsonl: "failed":[{"index":3,"case":"case load = 2000, seed = 1"
--! file: manifest.json: "status": "failed"
--! again: --threads 1
local lab = require "asperity"
local function run(case)
  local s = lab.surface.sine{ cells=16, size="1 mm", amplitude="1 um", material=lab.material "Al-2011" }
  local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
  assert(case.load ~= 2000.0, "the load cell is out of order")
  return { area=c:press{ load=case.load }.area_fraction }
end
local over = { load={ 1000.0, 2000.0, 3000.0 }, seed={ 1, 2 } }
local rows = lab.ensemble{ over=over, run=run, on_failure="report" }
assert(#rows == 4 and rows[3].load == 3000.0)
print("reported " .. #rows.failed .. " of 6")
print("first failed at seed " .. rows.failed[1].case.seed)
assert(rows.failed[2].index == 4 and rows.failed[2].message:find "out of order")
lab.ensemble{ over=over, run=run }

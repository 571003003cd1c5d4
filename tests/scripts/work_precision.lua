-- SPDX-License-Identifier: GPL-3.0-or-later
-- A study of a real contact: what it will take is said first, and rows, chart and journal are kept.
--! error: work and precision: 6 settings, each timed 3 times after a first run: about 
--! error: the truth { cells=128, tolerance=1e-08 } takes about 
--! output: cheapest for 10 %: 
--! output: * nothing measured is both faster and closer
--! output: calls as counted
--! output: pasted
--! file: work_precision.csv: way,cells,tolerance,end,value,error
--! file: work_precision.csv: finer grid,32,
--! file: journal.jsonl: "event":"study run"
--! file: cost.svg: finer grid
--! file: cost.svg: nothing beats these
local lab = require "asperity"
local steel = lab.material "steel"
local calls = 0

local function ask(knobs)
  calls = calls + 1
  local ball = lab.surface.sphere{ cells=knobs.cells, size="40 um", radius="100 um", material=steel }
  local c <close> = lab.contact{ lower=ball, upper=lab.rigid, boundary="free", effects={ elasticity="half_space" },
                                 accuracy={ tolerance=knobs.tolerance } }
  return c:press{ load="50 mN" }.approach
end

local study = lab.work_precision{
  ask = ask,
  truth = { cells=128, tolerance=1e-8 },
  try = { { name="finer grid", cells={ 16, 32, 64 }, tolerance=1e-6 },
          { name="tighter", cells=64, tolerance={ 1e-1, 1e-2, 1e-4 } } },
  repeats = 3,
}
print(study)
if calls == 1 + 6 * (1 + 3) and study.calls == calls then print "calls as counted" end
for _, row in ipairs(study:rows()) do assert(row.steady and row.runs == 3, row.way) end
study:chart "cost.svg"
local best = study:cheapest{ error=0.1 }
local pasted = load("return " .. tostring(best))()
if pasted.cells == best.knobs.cells and pasted.tolerance == best.knobs.tolerance then print "pasted" end
assert(math.abs(ask(pasted) - study.truth) <= 0.1 * study.truth)

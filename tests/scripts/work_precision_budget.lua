-- SPDX-License-Identifier: GPL-3.0-or-later
-- A budget is quoted and obeyed: settings that would break it are left out, a truth that would is an error.
--! error: ; at most 10 s, which leaves out 
--! output: left out: budget: about 
--! output: refused: 
--! output: would take about 
local lab = require "asperity"

-- As long on a fast machine as on a slow one.
local function ask(knobs)
  local ends = os.clock() + 1e-6 * knobs.cells ^ 2
  repeat until os.clock() >= ends
  return 1 + 1 / knobs.cells
end

local ways = { { name="grid", cells={ 64, 128, 16384 } } }
local study = lab.work_precision{ ask=ask, truth=1, try=ways, repeats=2, at_most="10 s" }
print(study:rows()[3].reason)
assert(study:rows()[2].runs == 2)
local done, message = pcall(lab.work_precision, { ask=ask, truth={ cells=32768 }, try=ways, at_most="10 s" })
print("refused: " .. tostring(message))
assert(not done)

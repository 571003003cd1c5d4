-- SPDX-License-Identifier: GPL-3.0-or-later
-- Studies of functions that do not use what they are given, of rows that are not there and of numbers whose squares leave
-- the range of numbers: nothing of it goes by without a word.
--! error: all replicates give the same answer, to the last digit: does `ask` use what `replicate` names?
--! error: the two finest grids give the same answer, to the last digit: does `ask` use its `cells`?
--! error: the answer does not depend on the inputs: does `ask` use them?
--! output: all told
local lab = require "asperity"
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").with

-- A part that is 0 because `ask` forgot it.
lab.budget{ ask = function() return 3 end, replicate = { seed = { 1, 2, 3 } } }
lab.budget{ ask = function() return 3 end, cells = { 16, 32 } }
lab.budget{ ask = function() return 3 end, inputs = { a = { value = 1, u = 0.1 } } }
-- A used key is not suspected.
local used = lab.budget{ ask = function(x) return x.seed + 1 / x.cells end, replicate = { seed = { 1, 2, 3, 4, 5 } }, cells = { 16, 32 } }
assert(#used.warnings == 0, used.warnings[1])

-- Variances that are infinite or 0 by their numbers alone.
local out = "whose square leaves the range of numbers; return it in another unit"
refused("(replicate 1) is 1e+300, " .. out, lab.budget, { ask = function(x) return 1e300 * x.seed end, replicate = { seed = { 1, 2 } } })
refused("(replicate 1) is 1e-300, " .. out, lab.budget, { ask = function(x) return 1e-300 * x.seed end, replicate = { seed = { 1, 2 } } })
refused(out, lab.sensitivity, { ask = function(x) return 1e300 * x.a end, inputs = { a = { value = 1, u = 0.1 } } })

local function line(q, row) return q.a + q.b * row.x end
local function rows(name, ...)
  local book = lab.notebook(name)
  for _, row in ipairs{ ... } do book:write(row) end
  return book
end
local some = rows("some", { x = 1, y = 1.1 }, { x = 2 }, { x = 3, y = 3.1 }, { x = 4, y = 3.9 })
local function fit(keys)
  keys.model, keys.y, keys.parameters = line, "y", { a = 0, b = 1 }
  return lab.calibrate(keys)
end
local text = tostring(fit{ data = some })
assert(text:find("over 3 rows (1 more without numbers)", 1, true), text)
refused("no row matches `where` `x` = 77", fit, { data = some, where = { x = 77 } })
refused("y is 1e+300 in row 1, and its square leaves the range of numbers; give it in another unit", fit,
  { data = rows("huge", { x = 1, y = 1e300 }, { x = 2, y = 2e300 }, { x = 3, y = 3e300 }) })
print "all told"

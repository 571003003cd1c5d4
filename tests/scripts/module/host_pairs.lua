-- SPDX-License-Identifier: GPL-3.0-or-later
-- The module leaves the host's pairs and next alone; cases of ensembles, which are states of their own, loop in
-- the fixed order, even by functions that they take along.
local plain_pairs, plain_next = pairs, next
local lab = require "asperity"
assert(pairs == plain_pairs and next == plain_next)
assert(pairs{} == next)
local rows = lab.ensemble{ over={ seed={ 1, 2 } }, run=function()
  local text = ""
  for name in plain_pairs{ light=1, middle=2, heavy=3, full=4 } do text = text .. name .. " " end
  for name in pairs{ light=1, middle=2, heavy=3, full=4 } do text = text .. name .. " " end
  return { text=text }
end }
for _, row in ipairs(rows) do assert(row.text == ("full heavy light middle "):rep(2), row.text) end

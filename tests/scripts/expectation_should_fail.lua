-- SPDX-License-Identifier: GPL-3.0-or-later
-- A negative control that fails as it should is a success.
--! exit: 0
--! not error: failed:
local lab = require "asperity"
local book = lab.notebook "control"
for k = 1, 5 do book:write{ D=2 + k / 10, mu=1 - k / 10 } end
assert(book:expect("mu", { increasing_in="D", should_fail=true }))
assert(book:expect("mu", { decreasing_in="D" }))
assert(book:expect("mu", { at_least=0.5, at_most=0.9 }))

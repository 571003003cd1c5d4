-- SPDX-License-Identifier: GPL-3.0-or-later
-- A negative control that holds is a failure.
--! exit: 1
--! error: failed:
local lab = require "asperity"
local book = lab.notebook "control"
for k = 1, 5 do book:write{ D=2 + k / 10, mu=k / 10 } end
book:expect("mu", { increasing_in="D", should_fail=true })

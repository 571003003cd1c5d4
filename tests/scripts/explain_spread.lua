-- SPDX-License-Identifier: GPL-3.0-or-later
-- A contact over ranks has no plan, and that is said rather than that nothing is pressed.
--! command: explain
--! output: spreadContact:press: 2 times, of a contact that is not known before the run or lies over ranks: no plan
--! not output: no contact is pressed
local lab = require "asperity"
local s = lab.spread.sine{ cells = 32, size = 1, amplitude = 0.01, material = lab.material{ young = 1, poisson = 0 } }
local c = lab.spread.contact{ lower = s, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" } }
for k = 1, 2 do c:press{ pressure = 0.001 * k } end

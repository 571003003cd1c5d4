-- SPDX-License-Identifier: GPL-3.0-or-later
-- What a script will compute, without computing it: presses are counted along loops, sweeps and cases, and what
-- depends on one is not followed.
--! command: explain
--! output: contact of 64 x 64 cells
--! output: contact:press: 5 times by `pressure`,
--! output: transforms expected of each
--! output: contact:sweep: 3 times by `pressure`,
--! output: off           plasticity
--! output: contact of 32 x 32 cells
--! output: contact:press: 6 times
--! output: together: 14 presses
--! output: explained to line 25
--! not output: never printed
local lab = require "asperity"
local unit = lab.material{ young = 1, poisson = 0 }
local function contact(cells)
  local body = lab.surface.sine{ cells = cells, size = 1, amplitude = 0.01, material = unit }
  return lab.contact{ lower = body, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" } }
end
local c, last = contact(64), nil
for k = 1, 5 do last = c:press{ pressure = 0.001 * k } end
for _ in c:sweep{ pressure = { 0.001, 0.002, 0.003 } } do end
lab.ensemble{ over = { seed = { 1, 2, 3 } }, run = function() contact(32):press{ pressure = 1e-3 } contact(32):press{ pressure = 2e-3 } return {} end }
if last.area_fraction > 0.5 then print "never printed" end

-- SPDX-License-Identifier: GPL-3.0-or-later
-- A file that the script would have written by then is not missed: what is read of it is not known before the run.
--! command: explain
--! output: contact:press: 1 time, of a contact that is not known before the run or lies over ranks: no plan
--! not output: there is no file
local lab = require "asperity"
local s = lab.surface.sine{ cells = 32, size = 1, amplitude = 0.01, material = lab.material{ young = 1, poisson = 0 } }
for k = 1, 2 do s:write(("own-%d.x3p"):format(k)) end
local back = lab.surface.read("own-2.x3p", { material = s.material })
lab.contact{ lower = back, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" } }:press{ pressure = 1e-3 }

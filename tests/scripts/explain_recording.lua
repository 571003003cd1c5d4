-- SPDX-License-Identifier: GPL-3.0-or-later
-- The presses of an existing log are counted. A log written by the script itself may be missing.
--! command: explain
--! output: protocol:on: 3 times by `load`,
--! output: together: 3 presses, about
--! not output: there is no file
local lab = require "asperity"
local log = lab.protocol.read((arg[0]:match "^(.*/)" or "") .. "../data/press_log.csv")
local unit = lab.material{ young = "70 GPa", poisson = 0.3 }
local body = lab.surface.sine{ cells = 32, size = "1 mm", amplitude = "1 um", material = unit }
local pair = lab.contact{ lower = body, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" } }
for _ in log:on(pair) do end
pair:log "done.csv"
print(#lab.protocol.read "done.csv")

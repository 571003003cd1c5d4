-- SPDX-License-Identifier: GPL-3.0-or-later
-- Where a script presses by flattening, the memory of a contact holds what seeking the load takes.
--! command: explain
--! output: 3.049 MiB at most
--! output: 1.937 MiB more for a press by `flatten`, for a moment
--! output: 4.986 MiB at most in one contact
local lab = require "asperity"
local body = lab.surface.sine{ cells = 184, size = 1, amplitude = 0.01, material = lab.material{ young = 1, poisson = 0 } }
local c = lab.contact{ lower = body, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" } }
c:press{ pressure = 0.001 }
c:press{ flatten = 0.3 }

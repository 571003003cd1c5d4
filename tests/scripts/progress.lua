-- SPDX-License-Identifier: GPL-3.0-or-later
-- Work of over a second says how far it is and how long it will take, on standard error.
--! error:  %, about 
--! error:  left
--! not output: %
local lab = require "asperity"

-- As long on a fast machine as on a slow one: a height takes three quarters of a millisecond, 4096 heights three seconds.
local function height()
  local ends = os.clock() + 0.75e-3
  repeat until os.clock() >= ends
  return 0
end

lab.surface.from_function{ cells=64, size=1, height=height }

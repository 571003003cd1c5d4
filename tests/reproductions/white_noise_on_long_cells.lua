-- SPDX-License-Identifier: GPL-3.0-or-later
-- White noise on long cells of a periodic tile, in either direction, takes at most 400 transforms.
local lab = require "asperity"
local function transforms(size)
  local x = 1
  local s = lab.surface.from_function{ cells=96, size=size, material=lab.material{ young=1e11, poisson=0 },
    height=function() x = x * 16807 % 2147483647 return 1e-7 * x / 2147483647 end }
  local c = lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
  return c:press{ pressure=1e8 }.cost.transforms
end
for _, long in ipairs{ 30, 100, 1000 } do
  for _, size in ipairs{ { 1e-3, 1e-3 * long }, { 1e-3 * long, 1e-3 } } do
    local taken = transforms(size)
    print(long, taken)
    assert(taken <= 400, taken .. " transforms, cells 1:" .. long)
  end
end

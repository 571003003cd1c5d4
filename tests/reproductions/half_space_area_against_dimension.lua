-- SPDX-License-Identifier: GPL-3.0-or-later
-- With box elements the area grows with D; on the half-space the area of the same surfaces falls, as the scripts of the
-- figures say. Two seeds of twelve.
local lab = require "asperity"
local a = require "asperity.arguments"({ seeds=2 }, ...)
local unit = lab.material{ young=1, poisson=0 }
local function area(D, elasticity)
  local sum = 0
  for seed = 1, a.seeds do
    local s = lab.surface.weierstrass_mandelbrot{ cells=150, D=D, span=1, seed=seed, material=unit }:scaled{ amplitude=5 }
    local effects = { elasticity=elasticity }
    local c = lab.contact{ lower=s, upper=lab.rigid, boundary="free", effects=effects, accuracy={ tolerance=1e-5 } }
    sum = sum + c:press{ pressure=.006 }.corrected_area_fraction
  end
  return sum / a.seeds
end
local low, high = area(2.0, "half_space"), area(2.9, "half_space")
print(low, high)
assert(high < low / 3, "the area rises with D on the half-space")

-- SPDX-License-Identifier: GPL-3.0-or-later
-- A strip of 4096 x 4 cells takes at most 30 pairs of transforms, as most scenes do. Required: no more with hardening or
-- with waves of two cells on a free boundary. `explain` reports that 997 cells a side take 7 to 8 times as long as 1000.
local lab = require "asperity"
local m = lab.material{ young=1e11, poisson=0, hardness=5e9 }
local function claim(name, holds, ...) print((holds and "holds: " or "does not hold: ") .. name, ...) end
local function rough(cells, size, short)
  return lab.surface.self_affine{ cells=cells, size=size, hurst=.8, rms_slope=.1, short_wave=short, material=m, seed=1 }
end
local function pairs_of(lower, boundary, plasticity, pressure)
  local c = lab.contact{ lower=lower, upper=lab.rigid, boundary=boundary, accuracy={ tolerance=1e-8 },
    effects={ elasticity="half_space", plasticity=plasticity } }
  return c:press{ pressure=pressure }.cost.transforms / 2
end
local strip = pairs_of(rough({ 4096, 4 }, { 4096e-6, 4e-6 }, 16e-6), "periodic", nil, 1e9)
assert(strip <= 30, strip)
local function plan(cells)
  return lab.contact{ lower=lab.surface.flat{ cells=cells, size=1e-3, material=m }, upper=lab.rigid, boundary="periodic",
    effects={ elasticity="half_space" } }:explain()
end
local odd, even = plan(997), plan(1000)
claim("a plan of 997 cells says that they take longer", odd.seconds > 3 * even.seconds or tostring(odd):find "prime" ~= nil,
  odd.seconds / even.seconds)

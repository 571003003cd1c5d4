-- SPDX-License-Identifier: GPL-3.0-or-later
-- `explain` estimates the memory of a contact: never too low, and at most twice too high, within a mebibyte.
local lab = require "asperity"
local m = lab.material{ young=1e11, poisson=0 }
local function compare(cells, boundary, single)
  local e = lab.contact{
    lower=lab.surface.self_affine{ cells=cells, size=1e-3, hurst=.8, rms_slope=.1, short_wave=1e-3 / 8, material=m },
    upper=lab.rigid, boundary=boundary, effects={ elasticity="half_space" }, accuracy={ precision=single and "single" or nil } }
  local said, taken = e:explain().bytes, e:press{ pressure=2e8 }.cost.bytes
  print(cells, boundary, said, taken)
  assert(taken <= said, taken .. " bytes taken of " .. said)
  assert(said <= 2 * taken + 2 ^ 20, said .. " bytes said for " .. taken)
end
-- Elements, and bodies on yielded surfaces: a press leaves bodies, too.
local hard = lab.material{ young=1e11, poisson=0, hardness=1e9 }
local function compare_elements(cells, model, two)
  local function face(seed)
    return lab.surface.self_affine{ cells=cells, size=1e-3, hurst=.8, rms_slope=.1, short_wave=1e-3 / 8, seed=seed, material=hard }
  end
  local e = lab.contact{ lower=face(1), upper=two and face(2) or lab.rigid, boundary="free",
    effects={ elasticity=model, plasticity={} } }
  local said, taken = e:explain().bytes, e:press{ pressure=2e8 }.cost.bytes
  print(cells, model, said, taken)
  assert(taken <= said, taken .. " bytes taken of " .. said)
  assert(said <= 2 * taken + 2 ^ 20, said .. " bytes said for " .. taken)
end
for _, model in ipairs{ "box", "rigid" } do
  for _, cells in ipairs{ 64, 512 } do
    for _, two in ipairs{ false, true } do compare_elements(cells, model, two) end
  end
end
-- The plan of a press by flattening includes the search for its load.
local f = lab.contact{ lower=lab.surface.self_affine{ cells=256, size=1e-3, hurst=.8, rms_slope=.1, short_wave=1e-3 / 8, material=m },
  upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
local said, taken = f:explain{ flatten=.3 }.bytes, f:press{ flatten=.3 }.cost.bytes
print("flatten", said, taken)
assert(taken <= said, taken .. " bytes taken of " .. said)
for _, boundary in ipairs{ "periodic", "free" } do
  for _, cells in ipairs{ 24, 64, 97, 256 } do compare(cells, boundary) end
end

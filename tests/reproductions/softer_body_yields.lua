-- SPDX-License-Identifier: GPL-3.0-or-later
-- The softer body yields: a body ten times as hard takes less than a hundredth of the plastic volume, one 1.2 times as hard
-- about a quarter, an equal one half. The plan names the rule.
local lab = require "asperity"
local function body(seed, hardness)
  return lab.surface.self_affine{ cells=64, size="1 mm", hurst=.8, ra="3 um", roll_off="250 um", short_wave="32 um", seed=seed,
    material=lab.material{ young=70e9, poisson=.33, hardness=hardness } }
end
local function share_of_harder(ratio)
  local lower, upper = body(1, .5e9), body(2, ratio * .5e9)
  local c = lab.contact{ lower=lower, upper=upper, boundary="periodic", effects={ elasticity="half_space", plasticity={} } }
  assert(tostring(c:explain()):find("by the ratio of their hardness", 1, true), tostring(c:explain()))
  local st = c:press{ pressure="150 MPa" }
  assert(math.abs(st.peak_pressure / .5e9 - 1) < 1e-6, st.peak_pressure)
  c:release()
  local function lost(before, after)
    local sum = 0
    for j, row in ipairs(after:heights()) do
      for i, z in ipairs(row) do sum = sum + math.abs(before:height(i - 1, j - 1) - z) end
    end
    return sum
  end
  local soft, hard = lost(lower, c:lower()), lost(upper, c:upper())
  return hard / (soft + hard)
end
assert(math.abs(share_of_harder(1) - .5) < 1e-3)
assert(math.abs(share_of_harder(1.2) - .25) < .02, share_of_harder(1.2))
assert(share_of_harder(10) < .01)

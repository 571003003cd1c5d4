-- SPDX-License-Identifier: GPL-3.0-or-later
-- What a run has done, call by call and effect by effect; what is not named does nothing.
--! output: contact:press
--! output: off, and nothing done for them: plasticity
--! output: contact of 64 x 64 cells
local lab = require "asperity"

local unit = lab.material{ young = 1, poisson = 0 }
local surface = lab.surface.self_affine{ cells = 64, size = 1, hurst = 0.8, rms_slope = 0.1, short_wave = 1 / 8,
  material = unit }
local contact = lab.contact{
  lower = surface, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" },
}
local plan = contact:explain()
print(plan)
assert(plan.json:find('"effects_off"', 1, true) and plan.bytes > 64 * 64 * 8 and plan.transforms > 0)

local transforms = 0
for k = 1, 3 do transforms = transforms + contact:press{ pressure = 0.001 * k }.cost.transforms end
for st in contact:sweep{ pressure = { 0.001, 0.002 } } do transforms = transforms + st.cost.transforms end

local ledger = lab.ledger()
print(ledger)
local lines = {}
for _, line in ipairs(ledger.calls) do lines[line.call] = line end
assert(lines["contact:press"].times == 3)
assert(lines["contact:sweep"].times == 2, "a line counts the states, not the call nor the turn that ends it")
assert(lines["lab.surface.self_affine"].times == 1)
assert(math.abs(ledger.by_effect.elasticity.transforms - transforms) < 1e-9)
assert(not pcall(function() return ledger.by_effect.plasticity end), "an effect that was not named has no line")

-- Cases of an ensemble have separate ledgers.
lab.ensemble{ over = { load = { 0.001, 0.002 } }, run = function(case)
  local c = lab.contact{
    lower = lab.surface.sine{ cells = 16, size = 1, amplitude = 0.01, material = unit }, upper = lab.rigid,
    boundary = "periodic", effects = { elasticity = "half_space" },
  }
  return { area = c:press{ pressure = case.load }.area_fraction }
end }
local cases = 0
for _, line in ipairs(lab.ledger().calls) do
  if line.in_case and line.call == "contact:press" then cases = line.times end
end
assert(cases == 2)
local sum = lab.ledger()
local accounted = sum.unaccounted
for _, line in ipairs(sum.calls) do
  if not line.in_case then accounted = accounted + line.seconds end
end
assert(math.abs(accounted - sum.seconds) < 1e-9)

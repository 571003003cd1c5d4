-- SPDX-License-Identifier: GPL-3.0-or-later
-- A press by indentation, approach or flattening takes at most 60 transforms and three times the transforms of the same state by
-- pressure. Every solvable press is solved; an unreachable one is refused by name.
local lab = require "asperity"
local m = lab.material{ young=1e11, poisson=0 }
local function contact(n)
  return lab.contact{ lower=lab.surface.sine{ cells=n, size=1e-3, amplitude=1e-6, material=m }, upper=lab.rigid, boundary="periodic",
    effects={ elasticity="half_space", plasticity={ hardness=2e7, hardening=1e11 } } }
end
for _, n in ipairs{ 8, 16, 96 } do
  local st = contact(n):press{ indentation=0.3 }
  local same = contact(n):press{ pressure=st.pressure }
  print(n, st.cost.transforms, same.cost.transforms)
  assert(math.abs(same.approach / st.approach - 1) < 1e-5, same.approach)
  assert(st.cost.transforms <= 3 * same.cost.transforms + 60, st.cost.transforms)
end
local flat = lab.contact{ lower=lab.surface.flat{ cells=8, size=1e-3, material=m }, upper=lab.rigid, boundary="periodic",
  effects={ elasticity="half_space", plasticity={ hardness=2e7, hardening=1e300 } } }
local ok, message = pcall(flat.press, flat, { indentation=0.3 })
assert(not ok and not message:find("e+55", 1, true), message)

-- A press by pressure: it once failed.
local soft = lab.material{ young=3498417126.8865466, poisson=0, hardness=1135771.91093065 }
local hard = lab.contact{
  lower=lab.surface.sine{ cells=96, size=0.0006020977480034872, amplitude=3.948845195143764e-05, directions=2, material=soft },
  upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space", plasticity={ hardening=2663206453.0237713 } } }
local st = hard:press{ pressure=889262.1864497022 }
print(st.residual, st.cost.transforms)
assert(st.converged)

-- On cells so long the descent at an approach stalls, and the load is sought.
local function noise(long)
  local x = 1
  return lab.surface.from_function{ cells=48, size={ 1e-3, 1e-3 * long }, material=m,
    height=function() x = x * 16807 % 2147483647 return 1e-7 * x / 2147483647 end }
end
for _, case in ipairs{ { 400, 1e8 }, { 800, 1e8 }, { 800, 3e8 } } do
  local pressure = case[2]
  local long = lab.contact{ lower=noise(case[1]), upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
  local by_pressure = long:press{ pressure=pressure }
  for _, by in ipairs{ "approach", "indentation", "flatten" } do
    local again = long:copy():press{ [by]=by_pressure[by] }
    print(by, again.cost.transforms, by_pressure.cost.transforms)
    assert(math.abs(again.pressure / pressure - 1) < 1e-3, again.pressure)
    assert(again.cost.transforms <= 10 * by_pressure.cost.transforms + 60, again.cost.transforms)
  end
end

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Bodies that attract each other: pulls, the branch a state is on, and what is said of what is not computed.
--! error: warning: `adhesion` acts around a contact in a zone about
local lab = require "asperity"
local unit = lab.material{ name="unit", young="1 Pa", poisson=0 }
local body = lab.surface.sphere{ cells=32, size=1, radius=1, shape="paraboloid", material=unit }
local function bench(effects, accuracy)
  effects.elasticity = effects.elasticity or "half_space"
  return lab.contact{ lower=body, upper=lab.rigid, boundary="free", effects=effects,
    accuracy=accuracy or { tolerance=1e-4 } }
end
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").anywhere

-- A pull is carried up to the pull-off; a larger pull leaves the contact unchanged.
local c = bench{ adhesion={ work=0.01, range=0.05 } }
local held = c:press{ load=-0.03 }
assert(held.load == -0.03 and held.nodes_in_contact > 0 and held.attraction > 0.03)
assert(#held.preload == 1 and held.preload[1] == 0)
refused(function() c:press{ load=-0.1 } end, "the bodies separate")
assert(c:press{ load=-0.03 }.digest == held.digest)

-- A sweep follows its branch.
local states = {}
for st in c:sweep{ approach={ -0.3, -0.02, 0.02, -0.02, -0.01, -0.3 } } do table.insert(states, st) end
assert(#states[2].preload == 0 and #states[3].preload == 0)
assert(#states[4].preload == 1 and states[4].preload[1] == 0.02)
assert(#states[5].preload == 2 and states[5].preload[2] == -0.02)
assert(states[4].nodes_in_contact >= states[2].nodes_in_contact and states[6].nodes_in_contact == 0)
assert(c:press{ approach=-0.01, preload={ 0.02, -0.02 } }.digest == states[5].digest)

-- A protocol pulls too.
local p = lab.protocol{ { press={ load=0.01 } }, { press={ load=-0.02, preload="10 mN" } }, { release=true } }
assert(tostring(p):find("press -20 mN preloaded to 10 mN", 1, true), tostring(p))
local loads = {}
for event, st in p:on(c) do if st then table.insert(loads, st.load) end end
assert(loads[1] == 0.01 and loads[2] == -0.02)
refused(function() p:write "pull.csv" end, "a log holds neither pulls")
local plain = bench{}
refused(function() for _ in p:on(plain) do end end, "event 2", "nothing attracts the bodies")
refused(function() plain:press{ load=0, preload=0.01 } end, "`preload` is given, and nothing attracts")

-- The ledger has a line for each effect.
local both = bench{ adhesion={ work=0.01, range=0.05 }, capillarity={ pressure=0.05, surface_tension=0.002 } }
local st = both:press{ load=0.01 }
local sum = 0
for _, effect in ipairs{ "elasticity", "adhesion", "capillarity" } do
  assert(st.cost.by_effect[effect].transforms > 0, effect)
  sum = sum + st.cost.by_effect[effect].transforms
end
assert(math.abs(sum - st.cost.transforms) < 1e-9 * sum)
assert(lab.ledger().by_effect.capillarity.transforms > 0)

-- Effects of zero strength are listed and change nothing, on boxes and next to unsupported effects.
local none = { work=0, range=1 }
for _, effects in ipairs{ { elasticity={ model="box", stiffness=3 } }, {}, { plasticity={ hardness=0.5 } },
  { tangential={} } } do
  local without = bench(effects):press{ load=0.01 }
  effects.adhesion, effects.capillarity = none, { humidity=0 }
  local with = bench(effects):press{ load=0.01 }
  assert(with.digest == without.digest)
  assert(with.cost.by_effect.adhesion.transforms == 0 and with.cost.by_effect.capillarity.transforms == 0)
end

-- Errors of these states have no bounds, and the state says so; unsupported effects are refused by name.
assert(st.error.algebraic.approach == math.huge and st.error.algebraic.energy == math.huge)
assert(tostring(st.error):find("for bodies that attract each other", 1, true), tostring(st.error))
assert(not tostring(st):find("inf", 1, true), tostring(st))
local some = { work=0.01, range=0.05 }
for _, effects in ipairs{ { elasticity="box", adhesion=some }, { plasticity={}, adhesion=some },
  { tangential={}, adhesion=some }, { tangential={}, capillarity={ humidity=0.5 } } } do
  refused(function() bench(effects) end, "is not computed")
end
refused(function() bench({ adhesion=some }, { precision="single" }) end, "`precision`")
refused(function() bench({ adhesion=some }, { estimate=true }) end, "estimate")
refused(function() c:press{ flatten=0.5 } end, "`flatten`")
refused(function() c:press{ load=1, preload=0.5 } end, "`preload` is 0.5, below the `load` of 1")
refused(function() c:press{ load=1, preload="2 um" } end, "`preload`")
refused(function() c:press{ load=1, drawn_from=2 } end, "unknown key `drawn_from`, which is called `preload` now")
refused(function() return held.drawn_from end, "`drawn_from`, which is called `preload` now")

-- A grid too coarse for the zone that pulls is warned of, once.
local coarse = bench{ adhesion={ work=0.01, range=0.01 } }
local plan = coarse:explain()
assert(tostring(plan):find("below four", 1, true) and plan.warnings[1]:find("below four", 1, true))
assert(plan.json:find("below four", 1, true) and #plain:explain().warnings == 0)
coarse:press{ load=0.01 }
print "as it should be"

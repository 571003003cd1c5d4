-- SPDX-License-Identifier: GPL-3.0-or-later
-- Whatever only a named effect gives is an error without it, and the error names the effect. A dwell is an
-- option of every protocol and press log: without creep it is told once and changes nothing.
--! error: this scene does not name the effect `creep`
local lab = require "asperity"
local metal = lab.material{ young="70 GPa", poisson=0.33, hardness="1.1 GPa" }
local function rough(seed)
  return lab.surface.self_affine{ cells=32, size="1 mm", hurst=0.8, rms_slope=0.1, short_wave="200 um", seed=seed,
    material=metal }
end
local function bench(effects, accuracy)
  effects.elasticity = effects.elasticity or "half_space"
  return lab.contact{ lower=rough(1), upper=rough(2), boundary="periodic", effects=effects, accuracy=accuracy }
end
local law = lab.friction{ tau0="50 MPa", alpha=0.2 }
local all_of_them = { "plasticity", "creep", "ageing", "interlocking", "tangential", "estimate" }

-- Every name of the language with a required effect: the effect, the name, and a function that uses it.
local asked = {
  { "plasticity", "plastic_volume", function(s) return s.st.plastic_volume end },
  { "plasticity", "plastic_fraction", function(s) return s.st.plastic_fraction end },
  { "plasticity", "plastic", function(s) return s.st:field "plastic" end },
  { "plasticity", "plastic_volume", function(s) return s.estimated.error.discretisation.plastic_volume end },
  { "plasticity", "plastic_fraction", function(s) return s.estimated.error.discretisation.plastic_fraction end },
  { "plasticity", "plastic_volume",
    function(s) return s.estimated.error.discretisation:extrapolated "plastic_volume" end },
  { "plasticity", "plastic_volume", function(s)
    return lab.contact{ lower=rough(1), upper=rough(2), boundary="periodic", effects=s.effects,
      accuracy={ error=0.05, of="plastic_volume" } }
  end },
  { "plasticity", "creep", function(s)
    local effects = { creep={} }
    for name, value in pairs(s.effects) do effects[name] = value end
    return bench(effects)
  end },
  { "ageing", "rest", function(s) return law:on(s.st, { rest="10 min" }) end },
  { "ageing", "strengthening", function(s) return law:on(s.st).strengthening end },
  { "ageing", "rest", function(s) return s.stage:raise{ rest="10 min" } end },
  { "interlocking", "interlocking_force", function(s) return law:on(s.st).interlocking_force end },
  { "tangential", "tangential", function(s) return s.c:shear{ ratio=0.5, friction=0.3 } end },
  { "tangential", "tangential", function(s) return s.stage:slip_growth{ steps=2 } end },
}
for _, name in ipairs{ "load", "pressure", "approach", "separation", "indentation", "flatten", "area",
  "area_fraction", "corrected_area_fraction", "peak_pressure", "mean_gap", "stiffness", "secant_stiffness",
  "energy", "plastic_volume", "plastic_fraction" } do
  table.insert(asked, { "estimate", name, function(s) return s.st.error.discretisation[name] end })
end
table.insert(asked, { "estimate", "area_fraction",
  function(s) return s.st.error.discretisation:extrapolated "area_fraction" end })

local function scene(effects)
  local c = bench(effects)
  local s = { effects=effects, c=c, st=c:press{ pressure="20 MPa" } }
  s.estimated = bench(effects, { estimate=true }):press{ pressure="20 MPa" }
  s.stage = lab.tilt_stage{ contact=c, friction=law, mass="4.3 g" }
  return s
end
local refusal = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").anywhere
local function refused(s, row)
  local effect, what, ask = table.unpack(row)
  refusal(function() ask(s) end, effect, what, "needs_effect.lua:")
end

-- A bare scene refuses every name. A scene with all other effects refuses it too.
local bare = scene{}
for _, row in ipairs(asked) do refused(bare, row) end
local others = {
  plasticity = { ageing={ rate=0.1, onset="1 s" }, interlocking={}, tangential={} },
  ageing = { interlocking={}, tangential={} },
  interlocking = { ageing={ rate=0.1, onset="1 s" }, tangential={} },
  tangential = { plasticity={}, creep={}, ageing={ rate=0.1, onset="1 s" }, interlocking={} },
  estimate = { plasticity={}, creep={}, ageing={ rate=0.1, onset="1 s" }, interlocking={} },
}
for effect, effects in lab.sorted(others) do
  local rest = scene(effects)
  for _, row in ipairs(asked) do
    if row[1] == effect then refused(rest, row) end
  end
end

-- With the effect, each name works: so the refusals above had no other reason.
local given = {
  plasticity = scene{ plasticity={} }, ageing = scene{ ageing={ rate=0.1, onset="1 s" } },
  interlocking = scene{ interlocking={} }, tangential = scene{ tangential={} },
}
for _, row in ipairs(asked) do
  local effect, what, ask = table.unpack(row)
  if effect ~= "estimate" then assert(ask(given[effect]) ~= nil, what) end
end
for _, row in ipairs(asked) do
  local s = { st=scene{ plasticity={} }.estimated }
  if row[1] == "estimate" then assert(row[3](s) ~= nil, row[2]) end
end

-- State and plan list each effect that is off.
for _, list in ipairs{ bare.st.effects_off, bare.c:explain().effects_off } do
  local off = " " .. table.concat(list, " ") .. " "
  for _, effect in ipairs(all_of_them) do
    if effect ~= "estimate" then assert(off:find(" " .. effect .. " ", 1, true), off) end
  end
end
-- A cost has no line for an effect outside the scene.
assert(not pcall(function() return bare.st.cost.by_effect.plasticity end))
assert(not pcall(function() return bare.st.cost.by_effect.estimate end))
assert(given.plasticity.st.cost.by_effect.plasticity.seconds >= 0)

local dwelt = bench{}
assert(dwelt:press{ pressure="20 MPa", dwell="1 h" }.digest == bare.st.digest)

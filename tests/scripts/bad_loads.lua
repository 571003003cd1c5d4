-- SPDX-License-Identifier: GPL-3.0-or-later
-- Contacts that cannot be made and loads that cannot be put on them.
--! output: all refused
local lab = require "asperity"
local S = lab.surface
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
local steel = lab.material "steel"
local box = { elasticity="box" }
local bare = S.sine{ cells=16, size="1 mm", amplitude="1 um" }
local s = bare:with{ material=steel }
refused(function() lab.contact{ lower=s, upper=lab.rigid } end, "`effects` is missing")
refused(function() lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="half_space" } } end, "a half-space needs `boundary`")
refused(function() lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="rigid" } } end, "rigid", "does not name `plasticity`")
refused(function() lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box", adhesion={ work=1, range=1 } } } end, "adhesion", "not computed")
refused(function() lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="rigid", plasticity={ hardness=math.huge } } } end, "their `hardness` is infinite")
refused(function() lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity={ model="rigid", stiffness=1e9 }, plasticity={} } } end, "`effects.elasticity`: `stiffness` is of model=\"box\", and the model is \"rigid\"")
local function layer(keys)
  keys.model = "layer"
  return { elasticity=keys }
end
refused(function() lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity="layer" } } end, "`effects.elasticity` is \"layer\" without its options; give { model=\"layer\", thickness= }")
refused(function() lab.contact{ lower=s, upper=lab.rigid, effects=layer{ thickness="1 mm" } } end, "a layer needs boundary=\"periodic\"")
refused(function() lab.contact{ lower=s, upper=lab.rigid, boundary="free", effects=layer{ thickness="1 mm" } } end, "`boundary` is \"free\", and a layer")
refused(function() lab.contact{ lower=s, upper=steel, boundary="periodic", effects=layer{ thickness="1 mm" } } end, "the upper body is of `steel`", "lab.rigid")
refused(function() lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects=layer{ thickness="1 mm", stiffness=1e9 } } end, "`effects.elasticity`: `stiffness` is of model=\"box\", and the model is \"layer\"")
refused(function() lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity={ model="half_space", base="bonded" } } } end, "`effects.elasticity`: `base` is of model=\"layer\"")
refused(function() lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects=layer{ thickness="1 mm", base="glued" } } end, "base", "frictionless")
refused(function() lab.contact{ lower=bare, upper=lab.rigid, effects=box } end, "elasticity", "the lower body", "no material")
refused(function() lab.contact{ lower=s, upper=S.flat{ cells=8, size="1 mm", material=steel }, effects=box } end, "16 x 16 cells", "8 x 8 cells", "resampled")
refused(function() lab.contact{ lower=s, upper=S.flat{ cells=16, size="2 mm", material=steel }, effects=box } end, "2 mm x 2 mm")
refused(function() lab.contact{ lower=s:with{ material=lab.rigid }, upper=lab.rigid, effects=box } end, "both bodies are rigid")
refused(function() lab.contact{ lower=S.flat{ cells=4, size=1, material=steel }, upper=lab.rigid, effects=box } end, "all combined heights are equal")

local c = lab.contact{ lower=s, upper=lab.rigid, effects=box }
refused(function() c:press{} end, "give exactly one of", "0 are given")
refused(function() c:press{ pressure=1, load=2 } end, "2 are given")
refused(function() c:press{ pressure=-1 } end, "`pressure` is -1 Pa")
refused(function() c:press{ flatten=1.5 } end, "`flatten` is 1.5; give a number from 0 to 1")
refused(function() c:sweep{ pressure=3 } end, "`pressure` is the number 3; give a list")
refused(function() c:sweep{ pressure={} } end, "give a list of values")
refused(function() lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects=box }:rotate(0.3) end, "rotate", "place")
refused(function() c:place{} end, "`seed` is missing")
-- The refused calls have not changed the bench.
local before = c:press{ approach="0.5 um" }
assert(not pcall(c.press, c, { pressure=-1 }))
assert(c:press{ approach="0.5 um" }.digest == before.digest)
-- Pressing until just nothing, and nothing at all.
assert(c:press{ pressure=0 }.nodes_in_contact == 0)
refused(function() before:field "presure" end, "(did you mean `pressure`?)")
refused(function() before:deformed "middle" end, 'give "lower" or "upper"')
refused(function() return before.plastic_volume end, "needs the effect `plasticity`")

local law = lab.friction{ tau0="500 MPa", alpha=0.2 }
refused(function() law:on(c) end, "`st` is a contact; give a state")
refused(function() lab.tilt_stage{ contact=c, friction=law } end, "`mass` is missing")
refused(function() lab.tilt_stage{ contact=c, friction=law, mass="4 g", limit="95 deg" } end, "`limit` is")
refused(function() lab.tilt_stage{ contact=c, friction=law, mass="4 g", probe_pressure={} } end, "`probe_pressure` is an empty list; give one pressure or more")
refused(function() lab.tilt_stage{ contact=c, friction=law, mass="4 g", probe_pressure={ math.huge } } end, "`probe_pressure` is inf Pa; give a finite pressure above 0")
-- A flat has no peak-to-valley to be a fraction of.
local flat = S.flat{ cells=8, size="1 mm", material=steel }
for _, boundary in ipairs{ "periodic", "free" } do
  local even = lab.contact{ lower=flat, upper=lab.rigid, boundary=boundary, effects={ elasticity="half_space" } }
  refused(function() even:press{ indentation=0.1 } end, "`indentation` is a fraction of a peak-to-valley that is zero")
  refused(function() even:press{ flatten=0.1 } end, "`flatten` is a fraction of a peak-to-valley that is zero")
  local st = even:press{ pressure="1 MPa" }
  assert(st.area_fraction == 1 and st.converged)
  if boundary == "periodic" then
    assert(st.approach == 0 and st.indentation == 0 and st.peak_pressure == 1e6 and st.stiffness == math.huge)
  else
    refused(function() return st.indentation end, "`indentation` is a fraction of a peak-to-valley that is zero", "read `approach`")
    assert(not tostring(st):find "indentation" and not tostring(st):find "inf")
  end
end
c:close()
refused(function() c:press{ pressure=1 } end, "a contact was used after it was closed")
print "all refused"

-- SPDX-License-Identifier: GPL-3.0-or-later
-- An elastic layer on a rigid base, by its names: every way of pressing it, its plan, plasticity, what is refused.
--! output: ok
local lab = require "asperity"
local S = lab.surface
local rubber = lab.material{ young="5 MPa", poisson=0.45, name="rubber" }
local ground = S.self_affine{ cells={64, 48}, size={"1 mm", "0.6 mm"}, hurst=0.8, rms_height="1 um", short_wave="60 um",
  material=rubber }
local function bench(elasticity, more)
  local effects = more or {}
  effects.elasticity = elasticity
  return lab.contact{ lower=ground, upper=lab.rigid, boundary="periodic", effects=effects, accuracy={ tolerance=1e-8 } }
end
local layer = { model="layer", thickness="80 um", base="bonded" }

-- Every way of asking gives the same state.
local c = bench(layer)
local st = c:press{ pressure="30 kPa" }
assert(st.converged and st.nodes_in_contact > 100 and st.area_fraction < 0.9)
for key, value in pairs{ load=st.load, approach=st.approach, indentation=st.indentation, flatten=st.flatten } do
  local same = c:press{ [key]=value }
  assert(math.abs(same.pressure / st.pressure - 1) < 1e-5, key)
  assert(math.abs(same.approach / st.approach - 1) < 1e-5, key)
  assert(math.abs(same.nodes_in_contact - st.nodes_in_contact) <= 2, key)
end

-- In full contact the tangent stiffness equals the stiffness of uniform compression.
local full = c:press{ pressure="5 MPa" }
local t, nu, young = 80e-6, 0.45, 5e6
local uniform = t * (1 + nu) * (1 - 2 * nu) / (young * (1 - nu))
assert(full.area_fraction == 1)
assert(math.abs(full.stiffness * uniform - 1) < 1e-9)

-- The base bears: a frictionless one less than a bonded one, a half-space least.
local free = bench{ model="layer", thickness="80 um", base="frictionless" }:press{ pressure="30 kPa" }
local deep = bench("half_space"):press{ pressure="30 kPa" }
assert(st.area_fraction < free.area_fraction and free.area_fraction < deep.area_fraction)
local thick = bench{ model="layer", thickness="1 m" }:press{ pressure="30 kPa" }
assert(math.abs(thick.peak_pressure / deep.peak_pressure - 1) < 1e-6)

local plan = tostring(c:explain())
assert(plan:find("layer of 80 um, bonded to a rigid base", 1, true), plan)
assert(bench(layer, { plasticity={ hardness="0.1 MPa" } }):press{ pressure="30 kPa" }.plastic_fraction > 0)
local ok, message = pcall(bench, layer, { adhesion={ work=0.05, range="1 um" } })
assert(not ok and tostring(message):find("`adhesion` is not computed on a layer", 1, true), message)
print "ok"

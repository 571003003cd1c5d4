-- SPDX-License-Identifier: GPL-3.0-or-later
-- A contact of half-spaces with plasticity, by its names: control, memory, fields, costs, refusals.
--! output: ok
local lab = require "asperity"
local S = lab.surface
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").anywhere
local function body(seed)
  return S.self_affine{ cells=64, size="250 um", hurst=0.8, ra="1 um", short_wave="24 um", seed=seed,
    material=lab.material "Al-2011" }
end
local function bench(effects, boundary)
  return lab.contact{ lower=body(1), upper=body(2), boundary=boundary or "periodic", effects=effects,
    accuracy={ tolerance=1e-8 } }
end

-- Every way of asking gives the same state.
local c = bench{ elasticity="half_space" }
local st = c:press{ pressure="20 MPa" }
assert(st.converged and st.residual <= 1e-8 and st.iterations > 0)
local tile = 250e-6 ^ 2
for key, value in pairs{ load=20e6 * tile, approach=st.approach, indentation=st.indentation, flatten=st.flatten } do
  local same = c:press{ [key]=value }
  assert(math.abs(same.pressure / st.pressure - 1) < 1e-5, key)
  assert(math.abs(same.nodes_in_contact - st.nodes_in_contact) <= 2, key)
end
assert(math.abs(st.separation + st.approach - (c:press{ pressure=0 }).separation) < 1e-15)

-- The stiffness is the slope of pressure on approach.
local near = c:press{ pressure="20.02 MPa" }
local slope = (near.pressure - st.pressure) / (near.approach - st.approach)
assert(math.abs(st.stiffness / slope - 1) < 0.02, st.stiffness / slope)

-- Nothing yields without the effect `plasticity`.
refused(function() return st.plastic_volume end, "plastic_volume", "plasticity")
assert(c:lower() == body(1) or c:lower().digest == body(1).digest)

-- With plasticity, deformation stays; creep lowers the hardness with dwell.
local p = bench{ elasticity="half_space", plasticity={}, creep={} }
local pressed = p:press{ pressure="60 MPa", dwell="10 min" }
assert(pressed.plastic_volume > 0 and pressed.plastic_fraction > 0 and pressed.peak_pressure <= 1.1e9)
assert(math.abs(pressed:field "plastic".mean * tile / pressed.plastic_volume - 1) < 1e-12)
local longer = bench{ elasticity="half_space", plasticity={}, creep={} }:press{ pressure="60 MPa", dwell="100 min" }
assert(longer.plastic_volume > pressed.plastic_volume)
p:release()
assert(p:lower().digest ~= body(1).digest)
local worn = p:lower().digest
refused(function() p:press{ pressure="2 GPa" } end, "1.1 GPa")
assert(p:lower().digest == worn)
assert(p:press{ pressure="60 MPa", dwell="10 min" }.plastic_volume < 1e-5 * pressed.plastic_volume)

-- Costs are reported by effect; effects that are off are listed.
assert(pressed.cost.by_effect.elasticity.transforms > 0 and pressed.cost.by_effect.plasticity)
assert(table.concat(pressed.effects_run, " ") == "elasticity plasticity creep")

-- Turns: whole quarters on a periodic tile, any angle on a free one.
refused(function() p:rotate "37 deg" end, "37 deg", "place", "free")
local free = bench({ elasticity="half_space", plasticity={} }, "free")
free:press{ pressure="20 MPa" }
free:release()
local before = free:upper()
free:rotate "37 deg"
free:rotate "53 deg"
free:rotate "-90 deg"
assert(free:upper().digest == before.digest)
refused(function() free:shift{ x="10 um" } end, "free")

-- Options.
refused(function() bench{ elasticity="half_space", plasticity={ hardnes="1 GPa" } } end, "hardness")
refused(function() bench{ elasticity="half_space", plasticity={ hardness="1 m" } } end, "hardness")
refused(function() bench{ elasticity="half_space", creep={} } end, "creep", "plasticity")
refused(function() bench{ elasticity="half_space", plasticity=true } end, "plasticity")
refused(function() bench{ elasticity={ model="half_space", stiffness=1 } } end, "stiffness", "box")
refused(function() bench{ elasticity="half_spac" } end, "half_space")
refused(function()
  lab.contact{ lower=body(1), upper=lab.rigid, boundary="periodic", effects={ elasticity="box" },
    accuracy={ precision="single" } }
end, "single")
print "ok"

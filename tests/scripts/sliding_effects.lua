-- SPDX-License-Identifier: GPL-3.0-or-later
-- The effects of a contact that is pulled sideways: what each adds where it is named, and what is said where it
-- is not.
local lab = require "asperity"
local al = lab.material "Al-2011"
local function rough(seed)
  return lab.surface.self_affine{ cells=64, size="1 mm", hurst=0.8, rms_slope=0.2, short_wave="80 um", seed=seed,
    material=al }
end
local function bench(effects, upper)
  effects.elasticity = effects.elasticity or "half_space"
  return lab.contact{ lower=rough(1), upper=upper or rough(2), boundary="periodic", effects=effects }
end
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").anywhere
local function near(a, b, within) assert(math.abs(a - b) <= (within or 1e-12) * math.abs(b), a .. " " .. b) end
local law = lab.friction{ tau0="50 MPa", alpha=0.2 }

-- Without effects: the plain law. Each result of an effect is refused by name.
local plain = bench{}
local st = plain:press{ pressure="20 MPa" }
local r = law:on(st)
refused(function() return r.interlocking_force end, "`interlocking_force`", "effect `interlocking`")
refused(function() return r.strengthening end, "`strengthening`", "effect `ageing`")
refused(function() law:on(st, { rest="10 min" }) end, "`rest`", "effect `ageing`")
refused(function() plain:shear{ ratio=0.5, friction=0.3 } end, "effect `tangential`")
local stage = lab.tilt_stage{ contact=plain, friction=law, mass="4.3 g" }
refused(function() stage:raise{ rest="10 min" } end, "`rest`", "effect `ageing`")
refused(function() stage:slip_growth() end, "effect `tangential`")
local off = table.concat(st.effects_off, " ")
assert(off:find("ageing interlocking tangential", 1, true), off)

-- Named, they change no press; and of no strength, no friction.
local all = bench{ interlocking={}, ageing={ rate=0, onset="1 s" }, tangential={} }
local same = all:press{ pressure="20 MPa" }
assert(same.digest == st.digest)
assert(table.concat(same.effects_run, " ") == "elasticity ageing interlocking tangential")
assert(tostring(all:explain()):find("tangential", 1, true))
local aged = bench{ ageing={ rate=0, onset="1 s" } }
assert(law:on(aged:press{ pressure="20 MPa" }, { rest="1 h" }).force == r.force)

-- Interlocking: the plain parts and the part of the slopes; the other direction gives another part.
local s = law:on(same)
assert(s.adhesive_force == r.adhesive_force and s.load_force == r.load_force)
assert(s.force == s.adhesive_force + s.load_force + s.interlocking_force and s.interlocking_force ~= 0)
local back = law:on(bench{ interlocking={ direction="180 deg" } }:press{ pressure="20 MPa" })
assert(back.interlocking_force ~= s.interlocking_force)
refused(function() bench({ interlocking={} }, lab.rigid) end, "`interlocking`", "two rough bodies", "flat")
refused(function() bench{ interlocking={ direktion=1 } } end, "did you mean `direction`")

-- Ageing: tau0 grows with the logarithm of the rest.
local resting = bench{ ageing={ rate=0.05, onset="1 s" } }
local state = resting:press{ pressure="20 MPa" }
local rested = law:on(state, { rest="10 min" })
near(rested.strengthening, 1 + 0.05 * math.log(601))
near(rested.adhesive_force, r.adhesive_force * rested.strengthening)
assert(law:on(state).force == r.force and rested.load_force == r.load_force)
local t = lab.tilt_stage{ contact=resting, friction=law, mass="4.3 g" }
local raised = t:raise{ repeats=1, rest="10 min" }
assert(raised.angle > t:raise{ repeats=1 }.angle)
assert(raised.note:find("tau0 grew by a factor of", 1, true))
refused(function() bench{ ageing={ rate=0.1 } } end, "`onset` is missing")
refused(function() bench{ ageing={ rate=0.1, onset="1 um" } } end, "`onset`", "time")
refused(function() law:on(state, { rest=-1 }) end, "`rest`")

-- Tangential: part of the contact slips; at Coulomb's force the whole contact slips.
refused(function() bench{ tangential={} }:shear{ ratio=0.5, friction=0.3 } end, "carries no load")
local q = all:shear{ ratio=0.5, friction=0.3 }
near(q.force, 0.5 * 0.3 * same.load)
near(q.stick_fraction + q.slip_fraction, 1)
assert(q.stick_fraction > 0 and q.slip_fraction > 0 and q.displacement > 0 and not q.slides)
assert(q.stiffness > 0 and q.cost.transforms > 0)
assert(q:field"shear".max <= 0.3 * same.peak_pressure and q:field"stick".max == 1)
local slid = all:shear{ ratio=1, friction=0.3 }
assert(slid.slides and slid.slip_fraction == 1 and slid.stiffness == 0)
-- Like bodies: Mindlin's (2 - nu)/(2 (1 - nu)).
near(slid.displacement, 0.3 * same.approach * (2 - al.poisson) / (2 * (1 - al.poisson)))
near(all:shear{ force=slid.force, friction=0.3 }.displacement, slid.displacement)
near(all:shear{ ratio=0.5, friction=law }.friction, s.mu)
print(q)
refused(function() all:shear{ force=1.01 * slid.force, friction=0.3 } end, "`force`", "slides at")
refused(function() all:shear{ force="1 N", ratio=0.5, friction=0.3 } end, "exactly one of `force` and `ratio`")
refused(function() all:shear{ ratio=0.5 } end, "`friction` is missing")
refused(function() all:shear{ ratio=0.5, friction="much" } end, "`friction`")
refused(function() all:shear{ ratio=1.5, friction=0.3 } end, "`ratio`")
refused(function() q:field "sheer" end, "did you mean `shear`")
all:release()
refused(function() all:shear{ ratio=0.5, friction=0.3 } end, "carries no load")
refused(function() bench{ tangential={}, plasticity={} } end, "`tangential`", "`plasticity`")
refused(function() bench{ elasticity="box", tangential={} } end, "`compliance_ratio`")

-- As the stage is raised, slip grows to all of the contact.
local pulled = lab.tilt_stage{ contact=all, friction=law, mass="4.3 g" }
local growth, before = pulled:slip_growth{ steps=4 }, 0
assert(#growth == 4)
for _, at in ipairs(growth) do
  assert(at.slip_fraction > before and at.displacement == nil)
  before = at.slip_fraction
end
assert(growth[4].slip_fraction == 1 and growth[4].ratio == 1)
near(growth[4].angle, pulled:raise{ repeats=1 }.angle)

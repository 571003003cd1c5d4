-- SPDX-License-Identifier: GPL-3.0-or-later
-- Friction at its limits: a cap that binds everywhere, no load, a stage at 90 degrees, a specimen that never
-- slips.
--
-- τ = min(τ0 + αP, τmax). Without a cap the force is τ0 A + αF for any pressures; with a cap that binds
-- everywhere it is τmax A. For boxes on a paraboloid (k = R = 1) every value between is known. On a tilt
-- stage, T(N) = T0 + αN slips at θ = asin(T0/(W√(1 + α²))) + atan α. This angle passes 90° as T0 passes W:
-- with a larger T0 the specimen never slips.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 15, title = "Friction at its limits", edge = "the cap from above every stress to below every"
    .. " stress; strength from 0 to past the weight, to one part in 1e12 on either side; loads from 1e-270 N",
  elsewhere = "The tangent of 90° is printed as a friction coefficient of 1.6e16. A specimen that never"
    .. " slips is reported to slip at the last angle tried. No load gives zero over zero.",
  here = "Capped sums are right at every cap. A specimen that never slips is reported as such, with an"
    .. " infinite coefficient. Without load there is no friction force.",
}

-- 1. The cap, with boxes on a paraboloid: the force at each τmax in closed form. P falls linearly with the
-- area from its peak p0 to 0 over A = 2πRδ.
local F, tau0, alpha = 1e-3, 1e-3, 0.2
local unit = lab.material{ young = 1, poisson = 0 }
local paraboloid = lab.surface.sphere{ cells = 1024, size = 0.5, radius = 1, shape = "paraboloid",
  material = unit }
local boxes = lab.contact{ lower = paraboloid, upper = lab.rigid, boundary = "free",
  effects = { elasticity = { model = "box", stiffness = 1 } } }
local st = boxes:press{ load = F }
local delta = math.sqrt(F / math.pi)
local area, p0 = 2 * math.pi * delta, delta
local caps = lab.notebook "caps"
for _, tau_max in ipairs{ 1, 0.005, 0.004, 0.003, 0.002, 0.0011, 1.0001e-3, 1e-3, 1e-4, 1e-12, 1e-300 } do
  local r = lab.friction{ tau0 = tau0, alpha = alpha, tau_max = tau_max }:on(st)
  -- Stress is distributed uniformly from τ0 (rim) to τ0 + α p0 (centre); above the cap it is τmax.
  local top, wanted = tau0 + alpha * p0, nil
  if tau_max >= top then wanted = area * (tau0 + top) / 2
  elseif tau_max <= tau0 then wanted = area * tau_max
  else
    local x = (tau_max - tau0) / (top - tau0)
    wanted = area * (x * (tau0 + tau_max) / 2 + (1 - x) * tau_max)
  end
  caps:write{ tau_max = tau_max, capped = r.capped_fraction, force = r.force,
    error = math.abs(r.force / wanted - 1),
    whole = tau_max <= tau0 and math.abs(r.force / (tau_max * st.area) - 1) or tau_max >= top
      and math.abs(r.force / (tau0 * st.area + alpha * F) - 1) or 0 }
end
case:evidence(caps, "Boxes on a paraboloid, 1024 x 1024 nodes, 1e-3 N, τ0 = 1e-3, α = 0.2: force"
  .. " against the closed form. If the cap binds nowhere or everywhere, also against the exact sums.",
  { { "tau_max", "%.5g", "τmax" }, { "capped", "%.4f", "share capped" }, { "force", "%.6e" },
  { "error", "%.0e" },
  { "whole", "%.0e", "error against the exact sum" } })
case:expect(caps, "error", { at_most = 7e-4 }) -- measured 7e-5
case:expect(caps, "whole", { at_most = 1e-15 }) -- measured 0

-- The same on a half-space, with the pressures of Hertz's contact (R = E* = 1): known values with and without
-- a cap.
local hertz = lab.notebook "hertz"
local ball = lab.surface.sphere{ cells = 257, size = 0.3, radius = 1, shape = "paraboloid", material = unit }
local pressed = lab.contact{ lower = ball, upper = lab.rigid, boundary = "free",
  effects = { elasticity = "half_space" } }:press{ load = F }
for tau_max, wanted in lab.sorted{ [0.018] = 4.337256e-4, [math.huge] = 4.593328e-4 } do
  local r = lab.friction{ tau0 = 0.01, alpha = 0.2, tau_max = tau_max }:on(pressed)
  -- The stepped outline of the contact encloses a little more area than the circle.
  local excess = 0.01 * (pressed.area_fraction - pressed.corrected_area_fraction) * 0.3 ^ 2
  hertz:write{ cap = tau_max == math.huge and "none" or ("%g"):format(tau_max), force = r.force,
    capped = r.capped_fraction,
    error = math.abs((r.force - excess) / wanted - 1), whole = tau_max == math.huge
      and math.abs(r.force / (0.01 * pressed.area + 0.2 * F) - 1) or 0 }
end
case:evidence(hertz, "Hertz's contact on 257 x 257 nodes, τ0 = 0.01, α = 0.2.",
  { { "cap", "%s", "τmax" }, { "capped", "%.4f", "share capped" },
  { "force", "%.6e" }, { "error", "%.0e" } })
case:expect(hertz, "error", { at_most = 5e-3 }) -- measured 8e-4
case:expect(hertz, "whole", { at_most = 1e-15 }) -- measured 0

-- 2. The stage, with a flat of boxes: A is the tile, and T = T0 + αN exactly.
local flat = lab.surface.flat{ cells = 4, size = 1, material = unit }
local function stage(T0, alpha, limit)
  local c = lab.contact{ lower = flat, upper = lab.rigid, effects = { elasticity = { model = "box",
    stiffness = 1e6 } } }
  return lab.tilt_stage{ contact = c, friction = lab.friction{ tau0 = T0, alpha = alpha }, mass = 1,
    gravity = 1, limit = limit }:raise{ repeats = 1 }
end
local tilts = lab.notebook "tilts"
local function tilt(T0, alpha, text)
  local t = stage(T0, alpha)
  local ratio = T0 / math.sqrt(1 + alpha * alpha)
  local theta = T0 < 1 and math.asin(ratio) + math.atan(alpha) or math.pi / 2
  local slips = T0 <= 1
  tilts:write{ ["T0"] = text or ("%g"):format(T0), alpha = alpha, slipped = t.slipped and "yes" or "never",
    angle = t.slipped and t.angle / lab.units.deg or nil,
    mu = t.mu == math.huge and "infinite" or ("%.4f"):format(t.mu),
    error = t.slipped and math.abs(t.angle - theta) or 0, right = t.slipped == slips and 1 or 0,
    told = (t.slipped or t.mu == math.huge) and 1 or 0 }
end
for _, T0 in ipairs{ 0, 1e-300, 1e-12, 1e-3, 0.3, 0.9, 0.99, 0.9999 } do tilt(T0, 0.2) end
tilt(1 - 1e-9, 0.2, "1 - 1e-9")
tilt(1 - 1e-12, 0.2, "1 - 1e-12")
tilt(1 + 1e-12, 0.2, "1 + 1e-12")
tilt(1 + 1e-9, 0.2, "1 + 1e-9")
for _, T0 in ipairs{ 1.1, 10, 1e300 } do tilt(T0, 0.1) end
tilt(0, 0)
tilt(0, 1e6)
tilt(0, 1e15)
case:evidence(tilts, "A specimen of weight 1 N on a stage, T = T0 + αN: angle of slip against the"
  .. " closed form.", { { "T0", "%s" }, { "alpha", "%g", "α" },
  { "slipped", "%s" }, { "angle", "%.9f", "angle (°)" }, { "error", "%.0e", "error (rad)" },
  { "mu", "%s", "μ at the angle held" } })
case:expect(tilts, "right", { at_least = 1 })
case:expect(tilts, "told", { at_least = 1,
  label = "a specimen that never slips has an infinite coefficient" })
case:expect(tilts, "error", { at_most = 4e-15 }) -- measured 4e-16

-- 3. Light loads, no load, and negative loads.
local law = lab.friction{ tau0 = tau0, alpha = alpha }
local light = lab.notebook "light"
for _, load in ipairs{ 1e-270, 1e-200, 1e-100, 1e-30, 1e-12 } do
  local r, touching = law:on(boxes:press{ load = load }), boxes:press{ load = load }
  local exact = tau0 * touching.area + alpha * touching.load
  light:write{ load = load, mu = r.mu, error = math.abs(r.force / exact - 1),
    of_mu = math.abs(r.mu / (exact / load) - 1) }
end
case:evidence(light, "The lightest loads: one node touches, so μ = α + τ0 A/F grows as 1/F.",
  { { "load", "%.0e", "load (N)" },
  { "mu", "%.3e", "μ" }, { "error", "%.0e", "error of the force" }, { "of_mu", "%.0e", "error of μ" } })
case:expect(light, "error", { at_most = 1e-15 }) -- measured 0
case:expect(light, "of_mu", { at_most = 1e-15 }) -- measured 0
local idle = boxes:press{ pressure = 0 }
case:holds("without load there is no friction force", law:on(idle).force == 0)
local function refused_stage(what, options, part)
  case:refused(what, function()
    options.contact, options.friction = boxes, law
    options.mass = options.mass or 1
    return lab.tilt_stage(options)
  end, part)
end
refused_stage("a negative mass", { mass = -1 }, "`mass`")
refused_stage("a mass of 0", { mass = 0 }, "`mass`")
refused_stage("a stage past 90 degrees", { limit = "90.0000001 deg" }, "`limit`")
refused_stage("gravity upwards", { gravity = -9.81 }, "`gravity`")
case:refused("a pulling load", function() boxes:press{ load = -1e-300 } end, "`load`")
case:refused("a negative strength", function() lab.friction{ tau0 = -1, alpha = 0 } end, "`tau0`")
case:refused("a cap of 0", function() lab.friction{ tau0 = 1, alpha = 0, tau_max = 0 } end, "`tau_max`")
case:finish{ worst = "4e-16 of the angle, 7e-5 of the capped force", verdict = "right answer" }

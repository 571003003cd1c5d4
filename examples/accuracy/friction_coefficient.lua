-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does a coefficient of friction cost? A ball whose junctions reach their greatest strength in
-- the middle: on a Hertz contact, tau = min(tau0 + alpha p, tau_max) has a closed form.
--
--   asperity run examples/accuracy/friction_coefficient.lua
--
-- Found: the error of friction is the error of the area, because the adhesive part counts the
-- touching nodes.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"

local options = require "asperity.arguments"({ budget = 30 }, ...)
local load, unit = 1e-3, lab.material{ young = 1, poisson = 0 }
local law = lab.friction{ tau0 = 0.01, alpha = 0.2, tau_max = 0.018 }
local exact = lab.exact.hertz{ radius = 1, modulus = 1, load = load, friction = law }.mu

local function mu(knobs)
  local ball = lab.surface.sphere{ cells = knobs.cells, size = 0.4, radius = 1,
    shape = "paraboloid", material = unit }
  local contact = lab.contact{ lower = ball, upper = lab.rigid, boundary = "free",
    effects = { elasticity = knobs.model or "half_space" },
    accuracy = { tolerance = knobs.tolerance } }
  return law:on(contact:press{ load = load }).mu
end

accuracy.show{ number = 3, title = "Friction coefficient",
  question = "A ball with junctions of strength min(0.01 + 0.2 p, 0.018): how large is friction?",
  truth = ("the integral over Hertz's pressures: %.7f."):format(exact),
  study = lab.work_precision{ ask = mu, truth = exact, at_most = options.budget, try = {
    { name = "finer grid", cells = { 16, 32, 64, 128, 256, 512 } },
    { name = "odd cells", cells = { 17, 33, 65, 129, 257 } },
    { name = "tighter tolerance", cells = 128, tolerance = { 1e-1, 1e-2, 1e-3, 1e-4, 1e-6 } },
    { name = "boxes", model = "box", cells = { 32, 64, 128, 256, 512 } } } },
  finding = "Friction is as good as the contact area: it counts the nodes that touch." }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does a coefficient of friction cost? A ball whose junctions reach their greatest strength in the middle.
--
--   asperity run examples/accuracy/friction_coefficient.lua
--   asperity run examples/accuracy/friction_coefficient.lua -- budget=120
--
-- tau = min(tau0 + alpha p, tau_max) over a Hertz contact has a closed form. Friction is an area and a sum over
-- pressures together, and what it errs by is the area's error: the adhesive part counts the nodes that touch.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"
local arguments = require "asperity.arguments"

local options = arguments({ budget = 30 }, ...)
local load = 1e-3
local law = lab.friction{ tau0 = 0.01, alpha = 0.2, tau_max = 0.018 }
local exact = lab.exact.hertz{ radius = 1, modulus = 1, load = load, friction = law }
local unit = lab.material{ young = 1, poisson = 0 }

local function mu(knobs)
  local ball <close> = lab.surface.sphere{
    cells = knobs.cells, size = 0.4, radius = 1, shape = "paraboloid", material = unit,
  }
  local contact <close> = lab.contact{
    lower = ball, upper = lab.rigid, boundary = "free", effects = { elasticity = knobs.model or "half_space" },
    accuracy = { tolerance = knobs.tolerance, precision = knobs.precision },
  }
  return law:on(contact:press{ load = load }).mu
end

local study = lab.work_precision{
  ask = mu,
  truth = exact.mu,
  try = {
    { name = "finer grid", cells = { 16, 32, 64, 128, 256, 512 } },
    { name = "odd cells", cells = { 17, 33, 65, 129, 257 } },
    { name = "tighter tolerance", cells = 128, tolerance = { 1e-1, 1e-2, 1e-3, 1e-4, 1e-6 } },
    { name = "boxes", model = "box", cells = { 32, 64, 128, 256, 512 } },
  },
  repeats = 5, at_most = options.budget,
}
accuracy.show{
  number = 3, title = "Friction coefficient", study = study,
  question = "A ball whose junctions hold min(0.01 + 0.2 p, 0.018): what is its coefficient of friction?",
  truth = ("the integral over Hertz's pressures: %.7f."):format(exact.mu),
  finding = "Friction is as good as the contact area: it counts the nodes that touch.",
}

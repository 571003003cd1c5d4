-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does the angle at which a specimen slips cost? A cap on box elements, tilted.
--
--   asperity run examples/accuracy/slip_angle.lua
--
-- Found: the reading of the stage, its last step without slip, is as accurate as its step.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"

local options = require "asperity.arguments"({ budget = 30 }, ...)
local radius, stiffness, mass = 1, 1e6, 1
local law = lab.friction{ tau0 = "50 Pa", alpha = 0.2 }

-- The area A has a closed form. Iterating the balance tau0 A(W cos t) + alpha W cos t = W sin t
-- gives every digit of the angle t.
local exact, weight = 0, mass * 9.81
for _ = 1, 30 do
  local cap = lab.exact.box_paraboloid{ radius = radius, stiffness = stiffness,
    load = weight * math.cos(exact) }
  exact = math.asin((law.tau0 * cap.area + law.alpha * cap.load) / weight)
end

local function angle(knobs)
  local cap = lab.surface.sphere{ cells = knobs.cells, size = 0.3, radius = radius,
    shape = "paraboloid", material = lab.material{ young = 1e9, poisson = 0 } }
  local contact = lab.contact{ lower = cap, upper = lab.rigid,
    effects = { elasticity = { model = "box", stiffness = stiffness } } }
  return lab.tilt_stage{ contact = contact, friction = law, mass = mass,
    step = knobs.step and knobs.step .. " deg" }:raise{ repeats = 1 }[knobs.read or "angle"]
end

accuracy.show{ number = 7, title = "Slip angle",
  question = "A cap of radius 1 m on box elements, 1 kg, strength 50 Pa + 0.2 p: at which angle "
    .. "does it slip?",
  truth = ("the balance solved in closed form: %.6f deg."):format(math.deg(exact)),
  study = lab.work_precision{ ask = angle, truth = exact, repeats = 3, at_most = options.budget,
    try = { { name = "finer grid", cells = { 16, 32, 64, 128, 256, 512, 1024 } },
      { name = "as read, finer steps", cells = 512, read = "held",
        step = { 10, 3, 1, 0.3, 0.1, 0.03, 0.01 } } } },
  finding = "The angle is as good as the area; reading it off a stage is as good as the step." }

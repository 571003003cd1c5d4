-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does the angle at which a specimen slips cost?
--
--   asperity run examples/accuracy/slip_angle.lua
--   asperity run examples/accuracy/slip_angle.lua -- budget=120
--
-- A cap on box elements, tilted: area goes with the root of the normal force, so the balance is
-- tau0 A(W cos t) + alpha W cos t = W sin t with A known in closed form, and the angle to any digit by halving.
-- What is read off the stage, the last step that held, is no better than its step.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"
local arguments = require "asperity.arguments"

local options = arguments({ budget = 30 }, ...)
local radius, stiffness, mass, tau0, alpha = 1, 1e6, 1, 50, 0.2
local weight, deg = mass * 9.81, math.pi / 180
local law = lab.friction{ tau0 = tau0, alpha = alpha }

local function excess(angle)
  local normal = weight * math.cos(angle)
  local cap = lab.exact.box_paraboloid{ radius = radius, stiffness = stiffness, load = normal }
  return weight * math.sin(angle) - tau0 * cap.area - alpha * normal
end
local low, high = 0, math.pi / 2 - 1e-9
for _ = 1, 60 do
  local middle = (low + high) / 2
  if excess(middle) > 0 then high = middle else low = middle end
end

local function angle(knobs)
  local cap <close> = lab.surface.sphere{
    cells = knobs.cells, size = 0.3, radius = radius, shape = "paraboloid",
    material = lab.material{ young = 1e9, poisson = 0 },
  }
  local contact <close> = lab.contact{
    lower = cap, upper = lab.rigid, effects = { elasticity = { model = "box", stiffness = stiffness } },
  }
  local stage = lab.tilt_stage{
    contact = contact, friction = law, mass = mass, step = (knobs.step or 0.1) * deg,
  }
  local tilt = stage:raise{ repeats = 1 }
  return knobs.read == "held" and tilt.held or tilt.angle
end

local study = lab.work_precision{
  ask = angle,
  truth = high,
  try = {
    { name = "finer grid", cells = { 16, 32, 64, 128, 256, 512, 1024 } },
    { name = "as read, finer steps", cells = 512, read = "held", step = { 10, 3, 1, 0.3, 0.1, 0.03, 0.01 } },
  },
  repeats = 3, at_most = options.budget,
}
accuracy.show{
  number = 7, title = "Slip angle", study = study,
  question = "A cap of radius 1 m on box elements, 1 kg, strength 50 Pa + 0.2 p: at which angle does it slip?",
  truth = ("the balance solved in closed form: %.6f deg."):format(high / deg),
  finding = "The angle is as good as the area; reading it off a stage is as good as the step.",
}

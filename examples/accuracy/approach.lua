-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does the approach of two bodies cost? A ball on a flat, against Hertz's exact answer.
--
--   asperity run examples/accuracy/approach.lua
--
-- Found: the free half-space is within 1e-4 of Hertz on 128² cells, because the approach is an
-- integral of the pressures. A periodic tile is a lattice of balls: only a larger tile helps. The
-- approach on boxes depends on an unknown stiffness.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"

local options = require "asperity.arguments"({ budget = 30 }, ...)
local radius, load = 20, 15
local body = lab.material{ young = "102 Pa", poisson = 0 } -- any unit: only ratios matter
local exact = lab.exact.hertz{ radius = radius, modulus = 102, load = load }.approach

local function approach(knobs)
  local ball = lab.surface.sphere{ cells = knobs.cells, size = 5 * (knobs.tile or 1),
    radius = radius, shape = "paraboloid", material = body }
  return lab.contact{ lower = ball, upper = lab.rigid, boundary = knobs.boundary or "free",
    effects = { elasticity = knobs.model or "half_space" },
    accuracy = { tolerance = knobs.tolerance } }:press{ load = load }.approach
end

accuracy.show{ number = 2, title = "Approach",
  question = "A paraboloid of radius 20 on a half-space of E* = 102 under a load of 15: how far do "
    .. "they approach?",
  truth = ("Hertz: %.9f."):format(exact),
  study = lab.work_precision{ ask = approach, truth = exact, at_most = options.budget, try = {
    { name = "finer grid", cells = { 16, 32, 64, 128, 256, 512 } },
    { name = "tighter tolerance", cells = 128, tolerance = { 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8 } },
    { name = "periodic tile, finer", boundary = "periodic", cells = { 32, 64, 128, 256 } },
    { name = "periodic tile, larger", boundary = "periodic", cells = { 64, 128, 256, 512 },
      tile = { 1, 2, 4, 8 } },
    { name = "boxes", model = "box", cells = { 32, 64, 128, 256 } } } },
  finding = "The approach is an integral of the pressures and forgives a coarse edge: no quantity "
    .. "is cheaper. A finer grid mends neither a wrong boundary nor a wrong model." }

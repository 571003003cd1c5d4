-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does the approach of two bodies cost? A ball on a flat, against Hertz's exact answer.
--
--   asperity run examples/accuracy/approach.lua
--   asperity run examples/accuracy/approach.lua -- budget=120
--
-- The free half-space meets the exact answer to 1e-4 on 128² cells: the approach is an integral of the
-- pressures, and forgives the edge of the contact. A periodic tile is another problem, a lattice of balls, and
-- a finer grid does not help; a larger tile does. The approach on boxes depends on a stiffness that nobody
-- knows: by default it has nothing to do with Hertz's.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"
local arguments = require "asperity.arguments"

local options = arguments({ budget = 30 }, ...)
local radius, modulus, load, side = 20, 102, 15, 5
local exact = lab.exact.hertz{ radius = radius, modulus = modulus, load = load }
local body = lab.material{ young = modulus .. " Pa", poisson = 0 } -- any unit: ratios alone count

local function approach(knobs)
  local ball <close> = lab.surface.sphere{
    cells = knobs.cells, size = (knobs.tile or 1) * side, radius = radius, shape = "paraboloid", material = body,
  }
  local contact <close> = lab.contact{
    lower = ball, upper = lab.rigid, boundary = knobs.boundary or "free",
    effects = { elasticity = knobs.model or "half_space" },
    accuracy = { tolerance = knobs.tolerance, precision = knobs.precision },
  }
  return contact:press{ load = load }.approach
end

local study = lab.work_precision{
  ask = approach,
  truth = exact.approach,
  try = {
    { name = "finer grid", cells = { 16, 32, 64, 128, 256, 512 } },
    { name = "tighter tolerance", cells = 128, tolerance = { 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8 } },
    { name = "periodic tile, finer", boundary = "periodic", cells = { 32, 64, 128, 256 } },
    { name = "periodic tile, larger", boundary = "periodic", cells = { 64, 128, 256, 512 }, tile = { 1, 2, 4, 8 } },
    { name = "boxes", model = "box", cells = { 32, 64, 128, 256 } },
  },
  repeats = 5, at_most = options.budget,
}
accuracy.show{
  number = 2, title = "Approach", study = study,
  question = "A paraboloid of radius 20 on a half-space of E* = 102 under a load of 15: how far do they approach?",
  truth = ("Hertz: %.9f."):format(exact.approach),
  finding = "The approach is an integral of the pressures and forgives a coarse edge: it is the cheapest of all "
    .. "quantities. The wrong boundary or the wrong model cannot be mended by a finer grid.",
}

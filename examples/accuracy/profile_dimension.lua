-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does the fractal dimension of a profile cost? Methods, points and profiles against a known answer.
--
--   asperity run examples/accuracy/profile_dimension.lua
--   asperity run examples/accuracy/profile_dimension.lua -- budget=120
--
-- A self-affine surface of Hurst exponent 0.5 has profiles of dimension 1.5. The method decides, not the money:
-- each has a bias of its own, and more points bring out the bias. The shortest wave here is two cells, so the
-- surface is smooth from one node to the next, which the shortest steps of the structure function see: without
-- them it is closer. The paper's method of lengths measures steepness: on a gentle surface it finds 1.05, on a
-- steep one it does as well as the structure function. Box counting is far too low at any affordable size.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"
local arguments = require "asperity.arguments"

local options = arguments({ budget = 30, seeds = 4 }, ...)
local hurst = 0.5

-- The mean over the profiles of some surfaces, so that the bias of a method is not lost in the scatter of one.
local function dimension(knobs)
  local sum, seeds = 0, knobs.seeds or options.seeds
  for seed = 1, seeds do
    local surface <close> = lab.surface.self_affine{
      cells = knobs.points, size = 1, hurst = hurst, rms_slope = knobs.slope or 1, short_wave = 2 / knobs.points, seed = seed,
    }
    sum = sum + surface:fractal_dimension{
      method = knobs.method or "structure", steps = knobs.from and { knobs.from, 2 * knobs.from, 4 * knobs.from },
    }.D / seeds
  end
  return sum
end

local points = { 64, 128, 256, 512, 1024 }
local study = lab.work_precision{
  ask = dimension,
  truth = 2 - hurst,
  try = {
    { name = "structure function", points = points, method = "structure" },
    { name = "structure, steps from 4 cells", points = { 128, 256, 512, 1024 }, method = "structure", from = 4 },
    { name = "spectrum", points = points, method = "psd" },
    { name = "madogram", points = points, method = "madogram" },
    { name = "box counting", points = points, method = "box" },
    { name = "lengths, slope 1", points = points, method = "length" },
    { name = "lengths, slope 100", points = points, method = "length", slope = 100 },
    { name = "structure, more surfaces", points = 128, seeds = { 1, 4, 16, 64 } },
  },
  repeats = 3, at_most = options.budget,
}
accuracy.show{
  number = 4, title = "Fractal dimension of a profile", study = study,
  question = "Profiles of a self-affine surface of Hurst exponent 0.5: what is their fractal dimension?",
  truth = "2 - H = 1.5, by construction.",
  finding = "The method decides, not the money: more points bring out the bias of each. The paper's method of lengths "
    .. "measures steepness and needs a steep profile to see a dimension at all.",
}

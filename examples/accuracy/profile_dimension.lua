-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does the fractal dimension of a profile cost? Methods, points and profiles against a known
-- answer: a self-affine surface of Hurst exponent 0.5 has profiles of dimension 1.5.
--
--   asperity run examples/accuracy/profile_dimension.lua
--
-- Found: the method decides, not the cost, because each method has a bias that more points only
-- confirm. The paper's length method finds 1.05 on a gentle surface and matches the structure
-- function on a steep one. Box counting is far too low at any affordable size.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"

local options = require "asperity.arguments"({ budget = 30, seeds = 4 }, ...)

-- The mean over several surfaces shows the bias of a method through the scatter.
local function dimension(knobs)
  local sum, seeds, from = 0, knobs.seeds or options.seeds, knobs.from
  for seed = 1, seeds do
    sum = sum + lab.surface.self_affine{ cells = knobs.points, size = 1, hurst = 0.5,
      rms_slope = knobs.slope or 1, short_wave = 2 / knobs.points, seed = seed,
    }:fractal_dimension{ method = knobs.method or "structure",
      steps = from and { from, 2 * from, 4 * from } }.D / seeds
  end
  return sum
end

local points = { 64, 128, 256, 512, 1024 }
accuracy.show{ number = 4, title = "Fractal dimension of a profile",
  question = "Which dimension have the profiles of a self-affine surface of Hurst exponent 0.5?",
  truth = "2 - H = 1.5, by construction.",
  study = lab.work_precision{ ask = dimension, truth = 1.5, repeats = 3, at_most = options.budget,
    try = {
    { name = "structure function", points = points, method = "structure" },
    -- Between the nodes the surface is smooth: its shortest wave has two cells.
    { name = "structure, steps from 4 cells", points = { 128, 256, 512, 1024 },
      method = "structure", from = 4 },
    { name = "spectrum", points = points, method = "psd" },
    { name = "madogram", points = points, method = "madogram" },
    { name = "box counting", points = points, method = "box" },
    { name = "lengths, slope 1", points = points, method = "length" },
    { name = "lengths, slope 100", points = points, method = "length", slope = 100 },
    { name = "structure, more surfaces", points = 128, seeds = { 1, 4, 16, 64 } } } },
  finding = "The method decides, not the cost: more points show the bias of each. The paper's "
    .. "method of lengths measures steepness and needs a steep profile to see a dimension." }

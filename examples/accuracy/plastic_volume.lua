-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does the plastic volume of eight events cost?
--
--   asperity run examples/accuracy/plastic_volume.lua
--   asperity run examples/accuracy/plastic_volume.lua -- budget=1200 finest=512
--   asperity run examples/accuracy/plastic_volume.lua -- events=1
--
-- Two rough bodies are put down afresh and pressed eight times; how much is flattened for good in all? The
-- answer after eight events is no worse than after one: errors do not pile up, for what an event leaves is
-- exact in its own grid. What is paid for is the grid: a tolerance of 1e-2 serves as well as 1e-8.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"
local arguments = require "asperity.arguments"

local options = arguments({ budget = 300, finest = 256, events = 8 }, ...)
local metal = lab.material{ young = 1, poisson = 0, hardness = 0.03 }

local function body(cells, seed)
  return lab.surface.self_affine{
    cells = cells, size = 1, hurst = 0.8, rms_slope = 0.1, short_wave = 1 / 16, seed = seed, material = metal,
  }
end
local function volume(knobs)
  local contact <close> = lab.contact{
    lower = body(knobs.cells, 1), upper = body(knobs.cells, 2), boundary = "periodic",
    effects = { elasticity = "half_space", plasticity = {} },
    accuracy = { tolerance = knobs.tolerance, precision = knobs.precision },
  }
  local sum = 0
  for event = 1, options.events do
    -- Half a tile further each time: the same places on every grid.
    if event > 1 then contact:shift{ x = event % 2 == 0 and 0.5 or 0.25, y = event % 3 == 0 and 0.5 or 0.25 } end
    sum = sum + contact:press{ pressure = 0.003 }.plastic_volume
    contact:release()
  end
  return sum
end

local grids = {}
for cells = 5, 30 do
  if 2 ^ cells < options.finest then grids[#grids + 1] = 1 << cells end
end
local study = lab.work_precision{
  ask = volume,
  truth = { cells = options.finest, tolerance = 1e-9 },
  try = {
    { name = "finer grid", cells = grids },
    { name = "tighter tolerance", cells = 64, tolerance = { 1e-2, 1e-3, 1e-4, 1e-6, 1e-8 } },
    { name = "single precision", precision = "single", cells = grids },
  },
  repeats = 3, at_most = options.budget,
}
accuracy.show{
  number = 5, title = "Plastic volume after eight events", study = study,
  question = "Two rough bodies of hardness 0.03 E*, put down elsewhere and pressed at 0.003 E* eight times: which "
    .. "volume is flattened for good?",
  truth = ("the same on %d² cells, solved to 1e-9."):format(options.finest),
  finding = "Errors do not pile up over the events: each leaves its bodies exact on their own grid.",
}

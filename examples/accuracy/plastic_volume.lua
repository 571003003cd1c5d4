-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does the plastic volume of eight events cost? Two rough bodies are placed afresh and pressed
-- eight times.
--
--   asperity run examples/accuracy/plastic_volume.lua -- events=8 finest=256
--
-- Found: the error after eight events is no larger than after one, because the state after an event
-- is exact on its own grid. The grid decides the cost: a tolerance of 1e-2 serves as well as 1e-8.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"

local options = require "asperity.arguments"({ budget = 300, finest = 256, events = 8 }, ...)
local metal = lab.material{ young = 1, poisson = 0, hardness = 0.03 }

local function body(cells, seed)
  return lab.surface.self_affine{ cells = cells, size = 1, hurst = 0.8, rms_slope = 0.1,
    short_wave = 1 / 16, seed = seed, material = metal }
end
local function volume(knobs)
  local contact = lab.contact{ lower = body(knobs.cells, 1), upper = body(knobs.cells, 2),
    boundary = "periodic", effects = { elasticity = "half_space", plasticity = {} },
    accuracy = { tolerance = knobs.tolerance, precision = knobs.precision } }
  local sum = 0
  for event = 1, options.events do
    -- A shift by half or a quarter of a tile gives the same places on every grid.
    if event > 1 then
      contact:shift{ x = event % 2 == 0 and 0.5 or 0.25, y = event % 3 == 0 and 0.5 or 0.25 }
    end
    sum = sum + contact:press{ pressure = 0.003 }.plastic_volume
    contact:release()
  end
  return sum
end

local grids = { 32 }
while 2 * grids[#grids] < options.finest do grids[#grids + 1] = 2 * grids[#grids] end

accuracy.show{ number = 5, title = "Plastic volume after eight events",
  question = "Two rough bodies of hardness 0.03 E*, put down elsewhere and pressed at 0.003 E* "
    .. "eight times: which volume is flattened for good?",
  truth = ("the same on %d² cells, solved to 1e-9."):format(options.finest),
  study = lab.work_precision{ ask = volume, repeats = 3, at_most = options.budget,
    truth = { cells = options.finest, tolerance = 1e-9 }, try = {
      { name = "finer grid", cells = grids },
      { name = "tighter tolerance", cells = 64, tolerance = { 1e-2, 1e-3, 1e-4, 1e-6, 1e-8 } },
      { name = "single precision", precision = "single", cells = grids } } },
  finding = "Errors do not grow over the events: each state is exact on its own grid." }

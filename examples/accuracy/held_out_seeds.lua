-- SPDX-License-Identifier: GPL-3.0-or-later
-- Does a setting chosen on some specimens serve for others?
--
--   asperity run examples/accuracy/held_out_seeds.lua
--   asperity run examples/accuracy/held_out_seeds.lua -- held_out=200 budget=60
--
-- The contact area of eight seeds is asked for together, and the study's answer is the worst error among them,
-- so that the truth is 0. The cheapest setting for 1 % is then tried on forty seeds it has never seen; nineteen
-- in twenty must meet the 1 %.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"
local arguments = require "asperity.arguments"

local options = arguments({ budget = 30, seen = 8, held_out = 40, finest = 512, error = 0.01 }, ...)
local slope, unit = 0.1, lab.material{ young = 1, poisson = 0 }

local function area_fraction(seed, knobs)
  local surface <close> = lab.surface.self_affine{
    cells = knobs.cells, size = 1, hurst = 0.8, rms_slope = slope, short_wave = 1 / 16, seed = seed, material = unit,
  }
  local contact <close> = lab.contact{
    lower = surface, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" },
    accuracy = { tolerance = knobs.tolerance },
  }
  return contact:press{ pressure = 0.1 * slope }.corrected_area_fraction
end

local truths = {}
local function error_of(seed, knobs)
  truths[seed] = truths[seed] or area_fraction(seed, { cells = options.finest, tolerance = 1e-8 })
  return math.abs(area_fraction(seed, knobs) / truths[seed] - 1)
end
for seed = 1, options.seen + options.held_out do error_of(seed, { cells = 32 }) end -- the truths, outside the study

local study = lab.work_precision{
  ask = function(knobs)
    local worst = 0
    for seed = 1, options.seen do worst = math.max(worst, error_of(seed, knobs)) end
    return worst
  end,
  truth = 0,
  try = {
    { name = "finer grid", cells = { 32, 48, 64, 96, 128, 192, 256 } },
    { name = "tolerance 1e-2", tolerance = 1e-2, cells = { 32, 48, 64, 96, 128, 192, 256 } },
  },
  repeats = 3, at_most = options.budget,
}
local chosen = study:cheapest{ error = options.error }
local met = 0
for seed = options.seen + 1, options.seen + options.held_out do
  if error_of(seed, chosen.knobs) <= options.error then met = met + 1 end
end
local share = met / options.held_out
print(("%s meets %g %% on %d of %d seeds that it was not chosen on"):format(chosen, 100 * options.error, met,
  options.held_out))

accuracy.show{
  number = 8, title = "A setting for specimens it has not seen", study = study,
  question = ("The worst error of the contact area among %d seeds; then the cheapest setting for 1 %% on %d others.")
    :format(options.seen, options.held_out),
  truth = ("each seed on %d² cells, solved to 1e-8; the errors below are of the worst seed."):format(options.finest),
  finding = ("`%s` meets 1 %% on %d of %d seeds that it was not chosen on."):format(chosen, met, options.held_out),
}
local book = lab.notebook "held_out"
book:write{ share = share }
book:expect("share", { at_least = 0.95, label = "the cheapest setting for 1 % meets it on 95 % of other seeds" })

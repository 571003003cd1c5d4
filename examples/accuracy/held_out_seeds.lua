-- SPDX-License-Identifier: GPL-3.0-or-later
-- Does a setting chosen on some specimens serve for others?
--
--   asperity run examples/accuracy/held_out_seeds.lua -- held_out=40
--
-- The study's value is the worst error of the contact area among twenty seeds, so the truth is 0.
-- Found: the cheapest setting for 1 % meets it on at least nineteen in twenty of forty other seeds.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"

local options = require "asperity.arguments"({ budget = 30, seen = 20, held_out = 40, finest = 512,
  error = 0.01 }, ...)
local slope, unit = 0.1, lab.material{ young = 1, poisson = 0 }

local function area_fraction(seed, knobs)
  local face = lab.surface.self_affine{ cells = knobs.cells, size = 1, hurst = 0.8,
    rms_slope = slope, short_wave = 1 / 16, seed = seed, material = unit }
  return lab.contact{ lower = face, upper = lab.rigid, boundary = "periodic",
    effects = { elasticity = "half_space" }, accuracy = { tolerance = knobs.tolerance },
  }:press{ pressure = 0.1 * slope }.corrected_area_fraction
end

local truths = {}
for seed = 1, options.seen + options.held_out do
  truths[seed] = area_fraction(seed, { cells = options.finest, tolerance = 1e-8 })
end
local function error_of(seed, knobs)
  return math.abs(area_fraction(seed, knobs) / truths[seed] - 1)
end

local function worst_error(knobs)
  local worst = 0
  for seed = 1, options.seen do worst = math.max(worst, error_of(seed, knobs)) end
  return worst
end
local grids = { 32, 48, 64, 96, 128, 192, 256 }
local study = lab.work_precision{ ask = worst_error, truth = 0, repeats = 3,
  at_most = options.budget, try = { { name = "finer grid", cells = grids },
    { name = "tolerance 1e-2", tolerance = 1e-2, cells = grids } } }

local chosen, met = study:cheapest{ error = options.error }, 0
for seed = options.seen + 1, options.seen + options.held_out do
  if error_of(seed, chosen.knobs) <= options.error then met = met + 1 end
end
local finding = ("`%s` meets %g %% on %d of %d seeds that it was not chosen on."):format(chosen,
  100 * options.error, met, options.held_out)
print(finding)

accuracy.show{ number = 8, title = "A setting for specimens it has not seen", study = study,
  question = ("The worst error of the contact area among %d seeds; then the cheapest setting for "
    .. "1 %% on %d others."):format(options.seen, options.held_out),
  truth = ("each seed on %d² cells, solved to 1e-8; the errors below are of the worst seed.")
    :format(options.finest),
  finding = finding }
lab.table.from{ { share = met / options.held_out } }:expect("share", { at_least = 0.95,
  label = "the cheapest setting for 1 % meets it on 95 % of other seeds" })

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Coverage of 95 % intervals from solved contacts with a known truth: budgets of the approach of rough faces,
-- and calibrations of the amplitude and Young's modulus of a face.
--
--   asperity run bench/blind_experiments.lua --threads 2 -- experiments=200
--
-- Budgets: the truth is the mean approach over one recipe with the true modulus, from `faces` other faces on
-- 64 and 128 cells, extrapolated with the observed order. An experiment has 5 to 12 faces on 16 and 32 cells
-- and a modulus with an error of 5 %. Calibrations: 14 gaps under 14 loads, scatter 3 %, unknown amplitude
-- and modulus.
local lab = require "asperity"
local arguments = require "asperity.arguments"
local options = arguments({ experiments = 200, faces = 400, seed = 1 }, ...)
local young, pressure = 70e9, 2e7

local function approach(x)
  local face = lab.surface.self_affine{ cells = x.cells, size = "100 um", hurst = 0.8, rms_slope = 0.1, roll_off = "50 um",
    short_wave = "25 um", seed = x.seed, material = lab.material{ young = x.young, poisson = 0.3 } }
  local pair = lab.contact{ lower = face, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" } }
  return pair:press{ pressure = pressure }.approach
end
local function list(from, to)
  local all = {}
  for k = from, to do all[#all + 1] = k end
  return all
end
math.randomseed(options.seed)
local function normal() return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random()) end

-- 1. Truth of the budgets.
local sums, n = { 0, 0, 0 }, options.faces
local squares = 0
for _, row in ipairs(lab.ensemble{ over = { seed = list(1000001, 1000000 + n) }, run = function(case)
  local of = {}
  for k, cells in ipairs{ 32, 64, 128 } do of[k] = approach{ cells = cells, seed = case.seed, young = young } end
  return { of = of }
end }) do
  for k = 1, 3 do sums[k] = sums[k] + row.of[k] / n end
  squares = squares + row.of[3] ^ 2 / n
end
local order = math.log((sums[2] - sums[1]) / (sums[3] - sums[2]), 2)
local truth = sums[3] + (sums[3] - sums[2]) / (2 ^ order - 1)
local deviation = math.sqrt(squares - sums[3] ^ 2)
print(("approach: %.6g m, known to %.2g; one face scatters by %.1f %%, 32 cells err by %.1f %%, with order %.2f"):format(
  truth, deviation / math.sqrt(n), 100 * deviation / truth, 100 * (sums[1] / truth - 1), order))

-- 2. Budgets.
local held, widths = 0, 0
for k = 1, options.experiments do
  local first = 100 * k
  local budget = lab.budget{ ask = approach, replicate = { seed = list(first, first + 4 + k % 8) }, cells = { 16, 32 },
    inputs = { young = { value = young * (1 + 0.05 * normal()), u = 0.05 * young } }, runs = 8, seed = k }
  if budget.low <= truth and truth <= budget.high then held = held + 1 end
  widths = widths + (budget.high - budget.low) / 2 / truth / options.experiments
end
local budgets = held / options.experiments
print(("budgets: %d of %d intervals hold the truth (%.1f %%), half a width is %.1f %% in the mean"):format(held, options.experiments,
  100 * budgets, 100 * widths))

-- 3. Calibrations.
local function gap(q, load)
  local face = lab.surface.sine{ cells = 16, size = "1 mm", amplitude = q.amplitude, material = lab.material{ young = q.young, poisson = 0.3 } }
  local pair = lab.contact{ lower = face, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" } }
  return pair:press{ pressure = load }.mean_gap
end
local exact = {}
for k = 1, 14 do exact[k] = gap({ amplitude = 1e-6, young = 2e11 }, 2e7 * k) end
local parameters, within, profile, sets = { amplitude = 1e-6, young = 2e11 }, 0, 0, 0
for _ = 1, options.experiments do
  local rows = {}
  for k = 1, 14 do rows[k] = { load = 2e7 * k, gap = exact[k] * (1 + 0.03 * normal()) } end
  local found = lab.calibrate{ data = lab.table.from(rows), y = "gap", scatter = "relative",
    model = function(q, row) return gap(q, row.load) end,
    parameters = { amplitude = { start = "1.2 um", lower = "0.1 um" }, young = { start = "150 GPa", lower = "10 GPa" } } }
  sets = sets + found.calls / 14 / options.experiments
  for name, value in pairs(parameters) do
    local of = found.parameters[name]
    if of.low <= value and value <= of.high then within = within + 1 end
    if of.profile_low and of.profile_high and of.profile_low <= value and value <= of.profile_high then profile = profile + 1 end
  end
end
local calibrations = within / 2 / options.experiments
print(("calibrations: %.1f %% of the linearised intervals hold the truth, %.1f %% of those by profile; %.1f presses a row"):format(
  100 * calibrations, 100 * profile / 2 / options.experiments, sets))

local checks = lab.notebook "coverage"
checks:write{ of = "budgets", held = budgets }
checks:write{ of = "calibrations", held = calibrations }
checks:expect("held", { at_least = 0.91, at_most = 0.98 })

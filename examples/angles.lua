-- SPDX-License-Identifier: GPL-3.0-or-later
-- Do computed tilt angles hold against a table of measured ones?
--
--   asperity run examples/angles.lua
--
-- Rougher faces slide earlier, measured and computed.
--
-- The table is a German spreadsheet file: a line above the heads, semicolons, decimal commas,
-- angles in degrees, one row per trial. Your own table (`-- table="my_angles.csv"`) needs columns
-- for roughness, trial and angle.

local lab = require "asperity"
local file = ((arg and arg[0] or ""):match "^(.*)/" or ".") .. "/data/tilt_angles.csv"
local given = require "asperity.arguments"({ table = file, cells = 128, seeds = 6 }, ...)

-- 1. Measured angles: one row per specimen. The angles of the example are synthetic: friction
--    coefficients for tau0 = 500 MPa and alpha = 0.2, with a scatter of 6 %, from other surfaces of
--    the same roughness.
local trials = lab.table.read(given.table, { skip = 1,
  columns = { Ra = "Rauheit Ra", angle = "Winkel", trial = "Versuch" } })
local measured = trials:mean("angle", { by = "Ra" })
print(trials)

-- 2. Computed angles: several random surfaces for each roughness.
local computed = lab.notebook("computed", { columns = { "Ra", "seed", "angle" } })
for row in measured:each() do
  for seed = 1, given.seeds do
    local face = lab.surface.self_affine{ cells = given.cells, size = "400 um", hurst = 0.8,
      ra = row.Ra, roll_off = "100 um", short_wave = "12.5 um", seed = seed,
      material = lab.material "steel" }
    local contact = lab.contact{ lower = face, upper = lab.rigid, boundary = "periodic",
      effects = { elasticity = "half_space" } }
    local stage = lab.tilt_stage{ contact = contact, mass = "50 g", specimen_area = "1 cm^2",
      friction = lab.friction{ tau0 = "500 MPa", alpha = 0.2 } }
    computed:write{ ["Ra [m]"] = row.Ra, seed = seed, ["angle [rad]"] = stage:raise{ repeats = 1 }.angle }
  end
end

-- 3. Measured and computed angles, compared. Measured intervals are for trials on one specimen.
--    Computed intervals include the differences between specimens, so both may disagree.
local both = measured:joined(computed:mean("angle", { by = "Ra" }), { by = "Ra", suffix = "_computed" })
  :with{ difference = function(row) return row.mean_computed - row.mean end }
print "Measured and computed angles with their 95 % intervals, and computed less measured:"
both:show{ "Ra [um]", "mean [deg]", "low [deg]", "high [deg]", "mean_computed [deg]",
  "low_computed [deg]", "high_computed [deg]", "difference [deg]", digits = 4 }
local trend = measured:fit{ y = "mean", x = "Ra", model = "power" }
print(trend)
print(both:chart{ x = "Ra", y = { "mean", "mean_computed" }, fit = trend, log_x = true,
  y_label = "tilt angle", file = "angles.svg" })

-- 4. Expectations.
both:write "means.csv"
both:expect("mean", { decreasing_in = "Ra" })
both:expect("mean_computed", { decreasing_in = "Ra" })

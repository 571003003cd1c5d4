-- SPDX-License-Identifier: GPL-3.0-or-later
-- Do computed tilt angles hold against a table of measured ones?
--
--   asperity run examples/angles.lua
--   asperity run examples/angles.lua -- table="my_angles.csv"
--
-- The table is what a spreadsheet writes: a line above the heads, German heads, semicolons, decimal commas, angles
-- in degrees, one row a trial. It is read by the names of its columns, the trials of each specimen become a mean
-- with its 95 % interval, and the program computes the angle of each specimen from its roughness. The table of the
-- example was not measured: it was made from friction coefficients of a law of tau0 = 500 MPa and alpha = 0.2 with
-- trials that scatter by 6 %, on other surfaces of the same roughness than those computed here, so that there is
-- an answer to be found. The intervals of the table are of trials on one specimen: they do not say how specimens
-- of one roughness differ, which the computed intervals do; so the two may miss each other. Give your own with `table=`, with columns for roughness, trial and angle.

local lab = require "asperity"
local arguments = require "asperity.arguments"
local given = arguments({ table = "", cells = 128, seeds = 6 }, ...)
local folder = (arg and arg[0] or ""):match "^(.*)/" or "."
local path = given.table == "" and folder .. "/data/tilt_angles.csv" or given.table
local um, deg = lab.units.um, lab.units.deg

-- 1. Measured: read, and brought to one row a specimen.
local trials = lab.table.read(path, { skip = 1, columns = { Ra = "Rauheit Ra", angle = "Winkel", trial = "Versuch" } })
local measured = trials:mean("angle", { by = "Ra" })
print(trials)

-- 2. Computed: the same roughness on the tilt stage, on several surfaces each, for a surface is a draw too.
local steel = lab.material "steel"
local law = lab.friction{ tau0 = "500 MPa", alpha = 0.2 }
local computed = lab.notebook("computed", { columns = { "Ra", "seed", "angle" } })
for _, row in ipairs(measured:rows()) do
  for seed = 1, given.seeds do
    local face = lab.surface.self_affine{ cells = given.cells, size = "400 um", hurst = 0.8, ra = row.Ra, roll_off = "100 um",
                                          short_wave = "12.5 um", seed = seed, material = steel }
    local stage = lab.tilt_stage{
      contact = lab.contact{ lower = face, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" } },
      friction = law, mass = "50 g", specimen_area = "1 cm^2" }
    computed:write{ ["Ra [m]"] = row.Ra, seed = seed, ["angle [rad]"] = stage:raise{ repeats = 1 }.angle }
  end
end

-- 3. Beside each other.
local beside = measured:joined(computed:mean("angle", { by = "Ra" }), { by = "Ra", suffix = "_computed" })
print "Ra (um)   measured (95 %)             computed (95 %)            computed less measured"
for _, row in ipairs(beside:rows()) do
  print(("%5.2f     %5.2f (%5.2f to %5.2f) deg   %5.2f (%5.2f to %5.2f) deg   %+.2f deg"):format(row.Ra / um, row.mean / deg, row.low / deg,
    row.high / deg, row.mean_computed / deg, row.low_computed / deg, row.high_computed / deg, (row.mean_computed - row.mean) / deg))
end
local trend = measured:fit{ y = "mean", x = "Ra", model = "power" }
print(trend)
print(beside:chart{ x = "Ra", y = { "mean", "mean_computed" }, fit = trend, log_x = true, y_label = "tilt angle", file = "angles.svg" })

-- 4. What must hold: rougher faces slide earlier, in the table and computed.
local means = lab.notebook "means"
for _, row in ipairs(beside:rows()) do means:write{ ["Ra [m]"] = row.Ra, measured = row.mean, computed = row.mean_computed } end
means:expect("measured", { decreasing_in = "Ra" })
means:expect("computed", { decreasing_in = "Ra" })

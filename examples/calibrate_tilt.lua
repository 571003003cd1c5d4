-- SPDX-License-Identifier: GPL-3.0-or-later
-- Which tau0 and which alpha do fourteen measured tilt angles ask for, and do they determine both?
--
--   asperity run examples/calibrate_tilt.lua
--   asperity run examples/calibrate_tilt.lua -- cells=64 scatter=0.1
--
-- The law is tan(angle) = alpha + tau0 c with c the real contact area over the load, which the tilt stage computes from
-- the roughness. Fourteen angles of one specimen have one c, and determine the sum alone: the calibration gives neither
-- parameter a number. Seven angles each of two specimens of different roughness determine both, as far as two specimens
-- can: whether specimens scatter they do not show. The angles of the example were not measured: they are those of a
-- stage with tau0 = 200 MPa and alpha = 0.2, with trials that scatter evenly within `scatter` of themselves, so that
-- there is a truth to be found. With a table of your own, read by lab.table.read, begin at step 2.

local lab = require "asperity"
local arguments = require "asperity.arguments"
local given = arguments({ cells = 32, scatter = 0.1, seed = 1 }, ...)
local MPa, deg = lab.units.MPa, lab.units.deg
local truth = { tau0 = 200 * MPa, alpha = 0.2 }

-- 1. A smooth and a rougher face on the stage: their real area over the load, and angles that scatter.
local steel = lab.material "steel"
local function stage_of(name, q)
  local face = lab.surface.self_affine{ cells = given.cells, size = "400 um", hurst = 0.8, ra = name == "rough" and "0.4 um" or "0.05 um",
                                        roll_off = "100 um", short_wave = "25 um", seed = given.seed, material = steel }
  return lab.tilt_stage{
    contact = lab.contact{ lower = face, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" } },
    friction = lab.friction{ tau0 = q.tau0, alpha = q.alpha }, mass = "50 g", specimen_area = "1 cm^2" }
end
-- The stage answers in steps of 0.1 deg, which differences of the law fall between; its real area does not.
local area_per_load = {}
local function predicted(q, specimen)
  area_per_load[specimen] = area_per_load[specimen] or stage_of(specimen, truth):raise{ repeats = 1 }.area_per_load
  return math.atan(q.alpha + q.tau0 * area_per_load[specimen])
end
math.randomseed(given.seed)
local function angles_of(specimens)
  local rows = {}
  for k = 1, 14 do
    local specimen = specimens[(k - 1) % #specimens + 1]
    local angle = math.atan(math.tan(predicted(truth, specimen)) * (1 + given.scatter * (2 * math.random() - 1)))
    rows[k] = { specimen = specimen, mass = "50 g", ["angle [rad]"] = angle }
  end
  return lab.table.from(rows)
end
local function calibrated(rows)
  return lab.calibrate{ data = rows, y = "angle", specimen = "specimen", scatter = "relative",
                        parameters = { tau0 = { start = "400 MPa", lower = 0 }, alpha = { start = 0.1, lower = 0 } },
                        model = function(q, row) return predicted(q, row.specimen) end }
end

-- 2. One specimen: only the sum.
local one = calibrated(angles_of{ "rough" })
print(one)
local checks = lab.notebook "checks"
checks:write{ what = "one specimen", determined = #one.combinations == 1 and 0 or 1 }

-- 3. A second specimen with another real area: both.
local rows = angles_of{ "rough", "smooth" }
local both = calibrated(rows)
print(both)
for _, name in ipairs{ "alpha", "tau0" } do
  local of = both.parameters[name]
  print(("%-6s true %.4g, found %.4g, 95 %% %.4g to %.4g"):format(name, truth[name], of.value, of.low, of.high))
end
print(("angles scatter by %.1f %%, were made to by %.1f %%; the model was called %d times"):format(
  100 * both.residual_sd, 100 * given.scatter / math.sqrt(3), both.calls))
print(both:chart{ file = "calibration.svg" })
print(both:chart{ likelihood = true, file = "likelihood.svg" })

-- 4. What must hold: one specimen determines neither; two find the truth again, and the stage with the law that was
--    found slides as was measured.
for _, name in ipairs{ "alpha", "tau0" } do
  local of = both.parameters[name]
  checks:write{ what = name, ["off by"] = (of.value - truth[name]) / of.u }
end
local specimens = rows:column "specimen"
for k, fitted in ipairs(both.fitted) do
  if k > 2 then break end  -- a row of each specimen
  local angle = stage_of(specimens[k], both.values):raise{ repeats = 1 }.angle
  print(("the %s specimen slides at %.1f deg; by the fit at %.2f (%.2f to %.2f) deg"):format(specimens[k], angle / deg, fitted / deg,
    both.fitted_low[k] / deg, both.fitted_high[k] / deg))
  checks:write{ what = "stage, " .. specimens[k], ["off by"] = (angle - fitted) / (0.1 * deg) }
end
checks:expect("determined", { near = 0, within = 0, label = "fourteen angles of one specimen determine a sum" })
checks:expect("off by", { at_least = -4, at_most = 4, label = "within four standard uncertainties, or steps of the stage" })

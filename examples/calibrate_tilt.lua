-- SPDX-License-Identifier: GPL-3.0-or-later
-- Which tau0 and which alpha do fourteen measured tilt angles ask for, and do they determine both?
--
--   asperity run examples/calibrate_tilt.lua
--
-- Fourteen angles of one specimen determine only the sum of both terms of the law. Seven angles
-- each of two specimens of different roughness determine both parameters, but not the scatter
-- between specimens.

local lab = require "asperity"
local given = require "asperity.arguments"({ cells = 32, scatter = 0.1, seed = 1 }, ...)
local truth = { tau0 = lab.quantity "200 MPa", alpha = 0.2 }

-- 1. A smooth and a rougher face on the stage. The law is tan(angle) = alpha + tau0 c. The stage
--    computes c, the real contact area over the load, from the roughness. Its angle has steps of
--    0.1 deg, too coarse for derivatives, so we use c.
local function stage_of(name, q)
  local face = lab.surface.self_affine{ cells = given.cells, size = "400 um", hurst = 0.8,
    ra = name == "rough" and "0.4 um" or "0.05 um", roll_off = "100 um", short_wave = "25 um",
    seed = given.seed, material = lab.material "steel" }
  local contact = lab.contact{ lower = face, upper = lab.rigid, boundary = "periodic",
    effects = { elasticity = "half_space" } }
  return lab.tilt_stage{ contact = contact, friction = lab.friction(q), mass = "50 g",
    specimen_area = "1 cm^2" }
end
local c = {}
for _, name in ipairs{ "rough", "smooth" } do
  c[name] = stage_of(name, truth):raise{ repeats = 1 }.area_per_load
end
local function predicted(q, row) return math.atan(q.alpha + q.tau0 * c[row.specimen]) end

-- The angles are synthetic, each within `scatter` of the true angle, so the truth is known. With a
-- table of your own, read by lab.table.read, begin at step 2.
math.randomseed(given.seed)
local function angles_of(specimens)
  local rows = {}
  for k = 1, 14 do
    rows[k] = { specimen = specimens[(k - 1) % #specimens + 1], mass = "50 g" }
    local factor = 1 + given.scatter * (2 * math.random() - 1)
    rows[k]["angle [rad]"] = math.atan(math.tan(predicted(truth, rows[k])) * factor)
  end
  return lab.table.from(rows)
end
local function calibrated(rows)
  return lab.calibrate{ data = rows, y = "angle", specimen = "specimen", scatter = "relative",
    parameters = { tau0 = { start = "400 MPa", lower = 0 }, alpha = { start = 0.1, lower = 0 } },
    model = predicted }
end

-- 2. One specimen determines only the sum.
local one = calibrated(angles_of{ "rough" })
print(one)
local checks = lab.notebook "checks"
checks:write{ what = "one specimen", determined = 1 - #one.combinations }

-- 3. A second specimen with another real area determines both parameters.
local both = calibrated(angles_of{ "rough", "smooth" })
print(both)
for name, of in lab.sorted(both.parameters) do
  lab.say("%-6s true %.4g, found %.4g, 95 %% %.4g to %.4g", name, truth[name], of.value, of.low, of.high)
  checks:write{ what = name, ["off by"] = (of.value - truth[name]) / of.u }
end
lab.say("angles scatter by %.1f %%, were made to by %.1f %%; the model was called %d times",
  100 * both.residual_sd, 100 * given.scatter / math.sqrt(3), both.calls)
print(both:chart{ file = "calibration.svg" })
print(both:chart{ likelihood = true, file = "likelihood.svg" })

-- 4. Expectations: one specimen determines neither parameter. Two specimens recover the truth, and
--    the stage with the calibrated law reproduces the measured angles.
for k, specimen in ipairs{ "rough", "smooth" } do -- the first row of each
  local fitted = both.fitted[k]
  local angle = stage_of(specimen, both.values):raise{ repeats = 1 }.angle
  lab.say("the %s specimen slides at %.1f [deg]; by the fit at %.2f [deg] (%.2f [deg] to %.2f [deg])",
    specimen, angle, fitted, both.fitted_low[k], both.fitted_high[k])
  checks:write{ what = "stage, " .. specimen, ["off by"] = (angle - fitted) / lab.quantity "0.1 deg" }
end
checks:expect("determined", { near = 0, within = 0 }) -- fourteen angles determine a sum
checks:expect("off by", { at_least = -4, at_most = 4,
  label = "within four standard uncertainties, or steps of the stage" })

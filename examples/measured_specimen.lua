-- SPDX-License-Identifier: GPL-3.0-or-later
-- A measured specimen: how rough is it, how fractal, how does it touch a flat, and when does it slide?
--
--   asperity run examples/measured_specimen.lua -- specimen.txt size="1 mm, 2 mm" unit=um
--
-- Without a file the script makes a specimen, writes it and reads it. It checks for every specimen:
-- levelling removes only slope, a heavier load never touches less, and friction is the tangent of
-- the tilt angle.

local lab = require "asperity"

-- 1. The file and its options: a map (X3P, NPY, a text matrix, x y z triples) or a stylus trace (a
--    profiler's CSV, as a map with one row). Give size= and unit= for files without them, unit_xy=
--    for the positions of points, fill=interpolate for files with holes, format= for a format that
--    is not recognised.
local words, path = { ... }, nil
if words[1] and not words[1]:find "^%a+=" then path = table.remove(words, 1) end
local given = require "asperity.arguments"({ size = "", unit = "", unit_xy = "", fill = "",
  format = "", material = "Al-2011", flat = "quartz", mass = "4.3 g" }, table.unpack(words))

local file = {}
for _, key in ipairs{ "size", "unit", "unit_xy", "fill", "format" } do
  file[key] = given[key] ~= "" and given[key] or nil
end
local x, y = given.size:match "^([^,]+),([^,]+)$"
if x then file.size = { x, y } end

if not path then
  print "No file was given: here is a specimen made, written as X3P, and read back.\n"
  local made = lab.surface.self_affine{ cells = 200, size = "500 um", hurst = 0.8, ra = "3 um",
    roll_off = "125 um", short_wave = "5 um" }
  path = made:write "specimen.x3p"
  local book = lab.notebook "file"
  book:write{ written = made.peak_to_valley, read = lab.surface.read(path).peak_to_valley }
  book:expect("read", { near = made.peak_to_valley, rel = 1e-12, label = "heights come back as written" })
end
local specimen = lab.surface.read(path, file)
print("specimen    " .. path)
print("as read     " .. tostring(specimen))

-- 2. Levelling removes the tilt of the instrument's table. Then the roughness of the whole map.
local surface = specimen:levelled{ degree = 1 }
local tilted, r = specimen:roughness(), surface:roughness()
print("levelled    " .. tostring(surface))
local numbers = lab.notebook("roughness", { units = { Ra = "um", Rq = "um", amplitude = "um" } })
for state, q in lab.sorted{ ["as read"] = tilted, levelled = r } do
  numbers:write{ state = state, Ra = q.Ra, Rq = q.Rq, amplitude = q.amplitude, skewness = q.skewness,
    kurtosis = q.kurtosis, rms_slope = q.rms_slope }
end
print "\nroughness; the amplitude is peak to valley"
numbers:where{ state = "levelled" }:show{ "Ra [um]", "Rq [um]", "amplitude [um]", "skewness",
  "kurtosis", "rms_slope", digits = 4 }
numbers:expect("Rq", { where = { state = "levelled" }, at_most = tilted.Rq * (1 + 1e-9) })
if r.amplitude == 0 then
  print "\nThe specimen is flat: there is nothing more to measure."
  os.exit(0)
end

local along = surface.cells[1] == 1 and "y" or surface.cells[2] == 1 and "x" or "both"
local is_map = along == "both"
local seen = is_map and surface or surface:profiles{ along = along }[1]
seen:picture("specimen.png", { title = "specimen, levelled" })
if is_map then
  surface:picture("specimen_relief.png", { title = "specimen, levelled", view = "relief" })
end

-- 3. The fractal dimension of its profiles, by every method. A method without a result gives the
--    reason.
print "\nfractal dimension of the profiles (that of the surface is one more)"
local dimensions = lab.notebook "fractal_dimension"
for _, method in ipairs{ "length", "structure", "madogram", "psd", "box" } do
  local d = surface:fractal_dimension{ method = method, along = along }
  lab.say("  %-10s  %s", method, not d.resolved and "not resolved: " .. d.reason
    or ("D = %.4f, scatter %.4f over %d profiles"):format(d.D, d.error, d.profiles))
  dimensions:write{ method = method, D = d.D, scatter = d.error, r_squared = d.r_squared,
    resolved = d.resolved }
end

-- 4. The spectrum.
local spectrum = surface:spectrum{ bins = 40 }
local waves = lab.notebook("spectrum", { units = { wavelength = "m", power = "m^4" } })
for k, power in ipairs(spectrum.C) do
  if power > 0 then waves:write{ wavelength = 2 * math.pi / spectrum.q[k], power = power } end
end
lab.say("\nspectrum    rms slope %.4f, %s window", spectrum.rms_slope, spectrum.window)
if #waves > 1 then
  waves:chart{ x = "wavelength", y = "power", log_x = true, log_y = true, points = false,
    title = "Power spectrum of the specimen" }
end

-- 5. Presses against a flat at the pressures of the source paper. Boxes are independent: real area
--    and stiffness hold for this model.
local flat = given.flat == "rigid" and lab.rigid or lab.material(given.flat)
local bench = lab.contact{ lower = surface:with{ material = lab.material(given.material) },
  upper = flat, effects = { elasticity = "box" } }
local law = lab.friction{ tau0 = "500 MPa", alpha = 0.2 }
local book = lab.notebook("contact", { units = { pressure = "MPa", approach = "um", gap = "um" },
  columns = { "pressure", "approach", "area", "spots", "gap", "mu" } })
for st in bench:sweep{ pressure = require "asperity.laboratory".stresses } do
  book:write{ pressure = st.pressure, approach = st.approach, area = st.area_fraction, spots = st.spots,
    gap = st.mean_gap, mu = law:on(st).mu }
end
lab.say("\n%s on %s: boxes, junctions of tau = 500 MPa + 0.2 P", given.material, given.flat)
print(book)
book:expect("approach", { increasing_in = "pressure" })
for k = 2, #book do
  book:expect("area", { where = { pressure = book[k].pressure }, at_least = book[k - 1].area })
end
book:chart{ x = "pressure", y = "area", title = "Real contact area", y_label = "area fraction" }
if is_map then
  local st = bench:press{ pressure = "203.72 MPa" }
  st:field "pressure":picture("pressure.png", { title = "pressure at 203.72 MPa" })
end

-- 6. The tilt stage. The measured area alone carries the weight.
local t = lab.tilt_stage{ contact = bench, friction = law, mass = given.mass }:raise{ repeats = 1 }
local tilt = lab.notebook "tilt"
tilt:write{ ["angle [rad]"] = t.angle, ["held [rad]"] = t.held, mu = t.mu, slipped = t.slipped }
lab.say("\ntilt stage  %s on the area measured %s %.2f [deg]", given.mass,
  t.slipped and "slides at" or "does not slide, even at", t.angle)
if t.slipped then
  lab.say("            mu = %.3f", t.mu)
  tilt:expect("mu", { near = math.tan(t.held), rel = 1e-12 })
end

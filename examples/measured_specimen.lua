-- SPDX-License-Identifier: GPL-3.0-or-later
-- A measured specimen: how rough is it, how fractal, how does it touch a flat, and when does it slide?
--
--   asperity run examples/measured_specimen.lua -- specimen.x3p
--   asperity run examples/measured_specimen.lua -- specimen.txt size="1 mm, 2 mm" unit=um
--   asperity run examples/measured_specimen.lua -- trace.csv material=steel flat=rigid mass="100 g"
--
-- Reads maps (X3P, NPY, text matrices, x y z triples) and stylus traces (a profiler's CSV, taken as a map
-- of one row). size= and unit= are for files that do not tell theirs, unit_xy= for positions of points without a
-- unit, fill=interpolate for files with holes; format= names a format that is not recognised. Without a file
-- it makes a specimen, writes it as X3P and reads that.
-- What it finds depends on the specimen. What it checks holds for all: levelling takes no roughness that
-- is not slope, a heavier load never touches less, the friction of the tilt stage is the tangent of
-- its angle. Boxes do not pull on their neighbours: real area and stiffness are those of the model.

local lab = require "asperity"
local arguments = require "asperity.arguments"
local um, MPa, deg = lab.units.um, lab.units.MPa, lab.units.deg

-- 1. The file, and what the command line says about it.
local words = { ... }
local path
if words[1] and not words[1]:find "^%a+=" then path = table.remove(words, 1) end
local given = arguments({
  size = "", unit = "", unit_xy = "", fill = "", format = "", material = "Al-2011", flat = "quartz", mass = "4.3 g",
}, table.unpack(words))

local function if_given(text) return text ~= "" and text or nil end
local function sides(text)
  local x, y = text:match "^([^,]+),([^,]+)$"
  return x and { x, y } or if_given(text)
end

local specimen
if path then
  specimen = lab.surface.read(path, {
    size = sides(given.size), unit = if_given(given.unit), unit_xy = if_given(given.unit_xy),
    fill = if_given(given.fill), format = if_given(given.format),
  })
else
  print [=[usage: asperity run examples/measured_specimen.lua -- FILE [size="1 mm"] [unit=um]
       [unit_xy=mm] [fill=interpolate] [format=NAME] [material=Al-2011] [flat=quartz] [mass="4.3 g"]]=]
  print "No file was given: here is a specimen made, written as X3P, and read back.\n"
  local made = lab.surface.self_affine{
    cells = 200, size = "500 um", hurst = 0.8, ra = "3 um", roll_off = "125 um", short_wave = "5 um",
  }
  path = made:write "specimen.x3p"
  specimen = lab.surface.read(path)
  local book = lab.notebook "file"
  book:write{ written = made.peak_to_valley, read = specimen.peak_to_valley }
  book:expect("read", { near = made.peak_to_valley, rel = 1e-12, label = "heights come back as written" })
end
print("specimen    " .. path)
print("as read     " .. tostring(specimen))

-- 2. Level it: the tilt of the instrument's table is no roughness. Then the roughness, of all of it.
local surface = specimen:levelled{ degree = 1 }
local nx, ny = surface.cells[1], surface.cells[2]
local tilted, r = specimen:roughness(), surface:roughness()
print("levelled    " .. tostring(surface))
print(("\nroughness   Ra %.4g um   Rq %.4g um   peak to valley %.4g um"):format(r.Ra / um, r.Rq / um,
  r.amplitude / um))
print(("            skewness %.3f   kurtosis %.3f   rms slope %.4f"):format(r.skewness, r.kurtosis,
  r.rms_slope))
local numbers = lab.notebook "roughness"
for state, q in lab.sorted{ ["as read"] = tilted, levelled = r } do
  numbers:write{ state = state, ["Ra [m]"] = q.Ra, ["Rq [m]"] = q.Rq, ["amplitude [m]"] = q.amplitude,
    skewness = q.skewness, kurtosis = q.kurtosis, rms_slope = q.rms_slope }
end
numbers:expect("Rq", { where = { state = "levelled" }, at_most = tilted.Rq * (1 + 1e-9) })
if r.amplitude == 0 then
  print "\nThe specimen is flat: there is nothing more to measure."
  os.exit(0)
end

local is_map = nx > 1 and ny > 1
if is_map then
  surface:picture("specimen.png", { title = "specimen, levelled" })
  surface:picture("specimen_relief.png", { title = "specimen, levelled", view = "relief" })
else
  local trace = surface:profile(nx > 1 and { row = 0 } or { column = 0 })
  trace:picture("specimen.png", { title = "specimen, levelled" })
end

-- 3. The fractal dimension of its profiles, by every method. Where a method cannot tell, it says so.
local along = is_map and "both" or nx > 1 and "x" or "y"
print "\nfractal dimension of the profiles (that of the surface is one more)"
local dimensions = lab.notebook "fractal_dimension"
for _, method in ipairs{ "length", "structure", "madogram", "psd", "box" } do
  local d = surface:fractal_dimension{ method = method, along = along }
  if d.resolved then
    print(("  %-10s  D = %.4f, scatter %.4f over %d profiles"):format(method, d.D, d.error, d.profiles))
  else
    print(("  %-10s  not resolved: %s"):format(method, d.reason))
  end
  dimensions:write{
    method = method, D = d.D, scatter = d.error, r_squared = d.r_squared, resolved = d.resolved,
  }
end

-- 4. Its spectrum.
local spectrum = surface:spectrum{ bins = 40 }
local waves = lab.notebook "spectrum"
for k, q in ipairs(spectrum.q) do
  local power = spectrum.C[k]
  if power > 0 then waves:write{ ["wavelength [m]"] = 2 * math.pi / q, ["power [m^4]"] = power } end
end
print(("\nspectrum    rms slope %.4f, %s window"):format(spectrum.rms_slope, spectrum.window))
if #waves:rows() > 1 then
  waves:chart{ x = "wavelength", y = "power", log_x = true, log_y = true, points = false,
    title = "Power spectrum of the specimen" }
end

-- 5. Press it against a flat, at the pressures of the source paper, as boxes.
local flat = given.flat == "rigid" and lab.rigid or lab.material(given.flat)
local contact = lab.contact{
  lower = surface:with{ material = lab.material(given.material) }, upper = flat,
  effects = { elasticity = "box" },
}
local law = lab.friction{ tau0 = "500 MPa", alpha = 0.2 }
local book = lab.notebook "contact"
print(("\n%s on %s: boxes, junctions of tau = 500 MPa + 0.2 P"):format(given.material, given.flat))
print "  pressure (MPa)   approach (um)   contact area   spots   mean gap (um)    mu"
local pressures = { "20.37 MPa", "40.74 MPa", "61.11 MPa", "101.86 MPa", "152.78 MPa", "203.72 MPa" }
local last
for st in contact:sweep{ pressure = pressures } do
  local mu = law:on(st).mu
  print(("      %6.2f          %.4f          %.4f    %5d       %.4f      %.3f"):format(st.pressure / MPa,
    st.approach / um, st.area_fraction, st.spots, st.mean_gap / um, mu))
  book:write{ ["pressure [Pa]"] = st.pressure, ["approach [m]"] = st.approach, area = st.area_fraction,
    spots = st.spots, ["gap [m]"] = st.mean_gap, mu = mu }
  last = st
end
book:expect("approach", { increasing_in = "pressure" })
local rows = book:rows()
for k = 2, #rows do
  book:expect("area", { where = { pressure = rows[k].pressure }, at_least = rows[k - 1].area })
end
book:chart{ x = "pressure", y = "area", title = "Real contact area", y_label = "area fraction" }
if is_map then last:field "pressure":picture("pressure.png", { title = "pressure at 203.72 MPa" }) end

-- 6. On the tilt stage, its weight on the measured area alone.
local stage = lab.tilt_stage{ contact = contact, friction = law, mass = given.mass }
local t = stage:raise{ repeats = 1 }
local tilt = lab.notebook "tilt"
tilt:write{ ["angle [rad]"] = t.angle, ["held [rad]"] = t.held, mu = t.mu, slipped = t.slipped }
if t.slipped then
  print(("\ntilt stage  %s on the area measured slides at %.2f deg, mu = %.3f"):format(given.mass,
    t.angle / deg, t.mu))
  tilt:expect("mu", { near = math.tan(t.held), rel = 1e-12 })
else
  print(("\ntilt stage  %s on the area measured does not slide, even at %.0f deg"):format(given.mass,
    t.angle / deg))
end

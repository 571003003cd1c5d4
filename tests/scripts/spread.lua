-- SPDX-License-Identifier: GPL-3.0-or-later
-- A contact in slabs against the same in one process: one slab here, several in runner/spread.sh. And what is not
-- computed over ranks, said clearly.
--! output: over ranks as in one process
local lab = require "asperity"
local al = lab.material{ young = "70 GPa", poisson = 0.33, hardness = "1 GPa" }
local tolerance = 1e-7

local function close(what, found, wanted, within)
  if not (math.abs(found - wanted) <= within * math.abs(wanted)) then
    error(("%s is %.17g, not %.17g"):format(what, found, wanted), 2)
  end
end

-- Every number within ten tolerances, but the pressure of a single node within a hundred; the
-- numbers of nodes may differ by one that is on the edge.
local function compare(cells, press, plasticity)
  local keys = { cells = cells, size = { "100 um", "80 um" }, hurst = 0.7, rms_height = "1 um", short_wave = "12 um",
    seed = 3, material = al }
  local spread, whole = lab.spread.self_affine(keys), lab.surface.self_affine(keys)
  close("peak", spread.peak, whole:roughness().peak, 1e-12)
  close("valley", spread.valley, whole:roughness().valley, 1e-12)
  local effects = { elasticity = "half_space", plasticity = plasticity }
  local accuracy = { tolerance = tolerance }
  local a = lab.spread.contact{ lower = spread, upper = lab.rigid, boundary = "periodic", effects = effects,
    accuracy = accuracy }:press(press)
  local b = lab.contact{ lower = whole, upper = lab.rigid, boundary = "periodic", effects = effects,
    accuracy = accuracy }:press(press)
  assert(a.converged and a.residual <= tolerance)
  for _, name in ipairs{ "load", "pressure", "approach", "mean_gap", "energy" } do
    close(name, a[name], b[name], 10 * tolerance)
  end
  close("peak_pressure", a.peak_pressure, b.peak_pressure, 100 * tolerance)
  assert(math.abs(a.nodes_in_contact - b.nodes_in_contact) <= 1)
  close("area", a.area, a.nodes_in_contact * (100e-6 / spread.cells[1]) * (80e-6 / spread.cells[2]), 1e-12)
  if plasticity then
    close("plastic_volume", a.plastic_volume, b.plastic_volume, 10 * tolerance)
    assert(math.abs(a.plastic_fraction - b.plastic_fraction) * b.nodes_in_contact / b.area_fraction <= 1.5)
  end
  return a
end
compare({ 64, 52 }, { pressure = "100 MPa" })
compare({ 63, 51 }, { pressure = "300 MPa" })
compare({ 97, 64 }, { pressure = "2 MPa" })
compare({ 66, 53 }, { load = "1 N" })
compare({ 64, 52 }, { pressure = "10 kPa" })
compare({ 64, 52 }, { pressure = "300 MPa" }, {})
compare({ 64, 53 }, { pressure = "300 MPa" }, { hardness = "2.5 GPa" })
compare({ 64, 52 }, { approach = "1.2 um" })
compare({ 64, 52 }, { approach = "1.2 um" }, {})

-- A wave has known answers: p* = pi E* A / wavelength flattens it (Westergaard 1939).
local modulus, amplitude, length = 70e9 / (1 - 0.33 ^ 2), 0.5e-6, 100e-6
local flattening = math.pi * modulus * amplitude / length
local wave = lab.spread.sine{ cells = { 256, 20 }, size = { length, 20e-6 }, amplitude = amplitude, material = al }
local waves = lab.spread.contact{ lower = wave, upper = lab.rigid, boundary = "periodic",
  effects = { elasticity = "half_space" } }
local full = waves:press{ pressure = 1.5 * flattening }
assert(full.area_fraction == 1)
close("peak pressure of full contact", full.peak_pressure, 2.5 * flattening, 1e-12)
local half = waves:press{ pressure = 0.5 * flattening }
assert(math.abs(half.area_fraction - 2 / math.pi * math.asin(math.sqrt(0.5))) < 2 / 256)

local flat = lab.spread.contact{ lower = lab.spread.flat{ cells = 16, size = 1e-4, material = al }, upper = lab.rigid,
  boundary = "periodic", effects = { elasticity = "half_space" } }:press{ pressure = 1e6 }
assert(flat.area_fraction == 1 and flat.peak_pressure == 1e6 and flat.approach == 0)
assert(waves:press{ pressure = 0 }.nodes_in_contact == 0)

-- Written and read again in slabs, bit for bit.
local made = lab.spread.from_function{ cells = { 31, 9 }, size = 1e-4, material = al,
  height = function(x, y) return 1e-6 * math.sin(x * 1e5) * math.cos(y * 3e5) end }
made:write "made.npy"
local again = lab.spread.read("made.npy", { size = 1e-4 })
assert(made.digest == again.digest and made.peak == again.peak)
assert(lab.spread.read("made.npy", { size = 1e-4, unit = "um" }).rms_height * 1e6 - made.rms_height < 1e-18)

local fails = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").with
local function scene(changes)
  local keys = { lower = wave, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" } }
  for key, value in pairs(changes) do keys[key] = value end
  return keys
end
fails('`boundary` is "free", which is not computed over ranks', lab.spread.contact, scene{ boundary = "free" })
fails("`effects.adhesion` is not computed over ranks", lab.spread.contact,
  scene{ effects = { elasticity = "half_space", adhesion = { work = 1, range = 1e-9 } } })
fails("`effects.creep` is not computed over ranks", lab.spread.contact,
  scene{ effects = { elasticity = "half_space", plasticity = {}, creep = {} } })
fails("did you mean `plasticity`", lab.spread.contact,
  scene{ effects = { elasticity = "half_space", plastisity = {} } })
fails("names box elements, not computed over ranks; give \"half_space\"", lab.spread.contact, scene{ effects = { elasticity = "box" } })
fails("names a layer, not computed over ranks", lab.spread.contact, scene{ effects = { elasticity = { model = "layer", thickness = "1 mm" } } })
fails("names no elasticity", lab.spread.contact, scene{ effects = {} })
fails("`effects.plasticity.hardening` is not computed over ranks", lab.spread.contact,
  scene{ effects = { elasticity = "half_space", plasticity = { hardening = 1e14 } } })
fails("a surface that every rank holds", lab.spread.contact,
  scene{ lower = lab.surface.flat{ cells = 8, size = 1e-4 } })
fails("over ranks the upper body is flat", lab.spread.contact, scene{ upper = wave })
fails("which has no material", lab.spread.contact, scene{ lower = lab.spread.flat{ cells = 8, size = 1e-4 } })
fails("exactly one of `pressure`", waves.press, waves, {})
fails("cannot be carried", function()
  lab.spread.contact(scene{ effects = { elasticity = "half_space", plasticity = {} } }):press{ pressure = "1 GPa" }
end)
fails("in full contact at", waves.press, waves, { approach = "1 um" })
fails("needs the effect `plasticity`", function() return half.plastic_fraction end)
fails("from zero up", waves.press, waves, { pressure = -1 })
fails("under two cells", lab.spread.self_affine,
  { cells = 16, size = 1e-4, hurst = 0.8, rms_height = 1e-6, short_wave = 1e-6 })
fails("there is no file", lab.spread.read, "nowhere.npy", { size = 1e-4 })
fails("there is no field `displacement`", half.write, half, "displacement", "u.npy")
fails("the height of node (2, 0) is nan", lab.spread.from_function,
  { cells = 4, size = 1, height = function(x) return x == 0.5 and 0 / 0 or 0 end })
local rows = lab.ensemble{ over = { k = { 1 } }, on_failure = "report",
  run = function() return { s = lab.spread.flat{ cells = 8, size = 1 }.rms_height } end }
assert(rows.failed[1].message:find("in a case of an ensemble", 1, true))
print "over ranks as in one process"

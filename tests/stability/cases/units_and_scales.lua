-- SPDX-License-Identifier: GPL-3.0-or-later
-- Nanonewtons on micrometre grids, gigapascals, and thirty decades of scale: does any constant of the program
-- have a unit?
--
-- The equations have no unit. With lengths times L, and moduli and pressures times E, the contact is the
-- same: areas times L², approach times L, loads times E L², energies times E L³. Powers of two may not change
-- one bit. Powers of ten may change the last digits.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 4, title = "SI scales", edge = "moduli and lengths over 30 decades each, with loads in proportion",
  elsewhere = "An absolute tolerance, a guard like 1e-12, or a logarithm of metres in the kernel is right"
    .. " in one system of units and wrong in another: contact is found at every gap below a picometre, or"
    .. " never.",
  here = "Scaling lengths and moduli by powers of two changes no bit. Powers of ten change nothing"
    .. " beyond rounding. This holds for half-spaces with and without cap and hardening, periodic and free,"
    .. " and for boxes.",
}

local base = lab.surface.self_affine{ cells = { 48, 40 }, size = { 1.2, 1 }, hurst = 0.8, rms_height = 0.004,
  short_wave = 0.125 }
local heights = base:heights()
local function bench(model, L, E)
  local scaled = {}
  for j, row in ipairs(heights) do
    scaled[j] = {}
    for i, z in ipairs(row) do scaled[j][i] = z * L end
  end
  local s = lab.surface.from_table{ size = { 1.2 * L, L }, heights = scaled,
    material = lab.material{ young = E, poisson = 0.25, hardness = 0.03 * E } }
  local effects = { elasticity = model.box and "box" or "half_space" }
  if model.cap then effects.plasticity = { hardening = model.hardening and model.hardening * E / L } end
  return lab.contact{ lower = s, upper = lab.rigid, boundary = model.boundary, effects = effects,
    accuracy = { tolerance = 1e-9 } }
end

local models = {
  { name = "half-space, periodic", boundary = "periodic" }, { name = "half-space, free", boundary = "free" },
  { name = "with a cap", boundary = "periodic", cap = true },
  { name = "with a cap, free", boundary = "free", cap = true },
  { name = "with hardening", boundary = "periodic", cap = true, hardening = 2 },
  { name = "boxes", box = true, boundary = "free" },
}
local function measured(model, L, E)
  local st = bench(model, L, E):press{ pressure = 0.004 * E }
  return { nodes_in_contact = st.nodes_in_contact, approach = st.approach / L, load = st.load / (E * L * L),
    energy = st.energy / (E * L * L * L),
    peak = st.peak_pressure / E, gap = st.mean_gap / L, volume = model.cap
      and st.plastic_volume / (L * L * L) or 0,
    iterations = st.iterations, certificate = st.residual }
end

local book = lab.notebook "scales"
for _, model in ipairs(models) do
  local usual = measured(model, 1, 1)
  local worst, bits, count = 0, true, 0
  local nodes = true
  local function compare(L, E, exact)
    local found = measured(model, L, E)
    count = count + 1
    for key, value in pairs(usual) do
      if exact then bits = bits and (value == found[key])
      elseif key == "nodes_in_contact" then nodes = nodes and found[key] == value
      elseif key ~= "certificate" and key ~= "iterations" and value ~= 0 then worst = math.max(worst,
        math.abs(found[key] / value - 1)) end
    end
  end
  for _, decade in ipairs{ -15, -9, -6, -3, 3, 6, 9, 15 } do
    compare(10.0 ^ decade, 1, false)
    compare(1, 10.0 ^ decade, false)
    compare(10.0 ^ decade, 10.0 ^ -decade, false)
    compare(2.0 ^ math.floor(decade / 0.3), 1, true)
    compare(1, 2.0 ^ math.floor(decade / 0.3), true)
    compare(2.0 ^ math.floor(decade / 0.3), 2.0 ^ -math.floor(decade / 0.3), true)
  end
  book:write{ model = model.name, scales = count, nodes = usual.nodes_in_contact, worst = worst,
    iterations = usual.iterations,
    certificate = usual.certificate }
  case:holds(model.name .. ": powers of two change no bit, powers of ten change no node",
    bits and nodes)
end
case:evidence(book, "Lengths and moduli from 1e-15 to 1e15, 48 x 40 nodes: worst relative change by powers of ten of"
  .. " approach, load, energy, peak pressure, mean gap and plastic volume.",
  { { "model", "%s" }, { "scales", "%d", "scales tried" }, { "nodes", "%d" },
  { "worst", "%.0e", "worst change" }, { "iterations", "%d" }, { "certificate", "%.0e" } })
case:expect(book, "worst", { at_most = 6e-14 }) -- measured 4e-14

-- Hertz in the units of a nanoscope: a paraboloid, R = 10 um, E* of silicon, 20 nN on a grid of nanometres.
local hertz = lab.notebook "hertz"
local um, GPa = lab.units.um, lab.units.GPa
local R, modulus = 10 * um, 150 * GPa
for _, load in ipairs{ 1e-9, 20e-9, 400e-9, 8e-6 } do
  local a = (3 * load * R / (4 * modulus)) ^ (1 / 3)
  local s = lab.surface.sphere{ cells = 129, size = 3 * a, radius = R, shape = "paraboloid",
    material = lab.material{ young = modulus, poisson = 0 } }
  local st = lab.contact{ lower = s, upper = lab.rigid, boundary = "free",
    effects = { elasticity = "half_space" } }:press{ load = load }
  hertz:write{ load = load, radius = a, approach = st.approach,
    ["approach error"] = math.abs(st.approach / (a * a / R) - 1),
    ["pressure error"] = math.abs(st.peak_pressure / (1.5 * load / (math.pi * a * a)) - 1),
    ["area error"] = math.abs(st.corrected_area_fraction * 9 * a * a / (math.pi * a * a) - 1),
    iterations = st.iterations, certificate = st.residual }
end
case:evidence(hertz, "Hertz: a paraboloid of radius 10 µm, E* = 150 GPa, 129 x 129 nodes.",
  { { "load", "%.0e", "load (N)" },
  { "radius", "%.2e", "contact radius (m)" }, { "approach", "%.3e", "approach (m)" },
  { "approach error", "%.0e" },
  { "pressure error", "%.0e" }, { "area error", "%.0e" }, { "iterations", "%d" }, { "certificate", "%.0e" } })
case:expect(hertz, "approach error", { at_most = 2e-4 }) -- measured 2e-5
case:expect(hertz, "pressure error", { at_most = 3e-4 }) -- measured 3e-5
case:expect(hertz, "area error", { at_most = 5e-3 }) -- measured 8e-4
case:finish{ worst = "4e-14 by powers of ten, no bit by powers of two", verdict = "right answer" }

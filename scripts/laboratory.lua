-- SPDX-License-Identifier: GPL-3.0-or-later
-- Functions shared by the examples of the source paper's experiments: Hanaor, Gan and Einav (2013), "Effects of
-- surface structure deformation on static friction at fractal interfaces", Geotechnique Letters 3. Two blasted or
-- self-affine aluminium specimens, the six stresses, the eight events, and the measurements after each: Ra, profile
-- length, real area on quartz. `require "asperity.laboratory"`.
local lab = require "asperity"
local laboratory = {}

-- The paper's nominal stresses, and the stress of the repeated events (up to eight). Each press lasted ten minutes,
-- the reference time of hardness. So the scripts need no creep and no dwell.
local MPa = lab.units.MPa
laboratory.stresses = { 20.37 * MPa, 40.74 * MPa, 61.11 * MPa, 101.86 * MPa, 152.78 * MPa, 203.72 * MPa }
laboratory.event = { pressure = 152.78 * MPa }

laboratory.kinds = { "self-affine", "bead-blasted" }
laboratory.probe = "3 MPa" -- on quartz: enough nodes touch, and area still grows in proportion to load

-- A tile of 1 mm with Ra = 3 um. A grid of 256 cells leaves the shortest wave four cells, too few
-- to resolve it: ratios hold, absolute areas need finer cells.
local function specimen(kind, cells, seed, material)
  local options = { cells = cells or 256, size = "1 mm", ra = "3 um", seed = seed,
    material = material or lab.material "Al-2011" }
  if kind == "self-affine" then
    options.hurst, options.roll_off, options.short_wave = 0.8, "250 um", "16 um"
    return lab.surface.self_affine(options)
  elseif kind == "bead-blasted" then
    options.fine = { short_wave = "16 um" }
    return lab.surface.bead_blasted(options)
  end
  error(("`kind` is `%s`; give self-affine or bead-blasted"):format(kind), 0)
end

-- Two specimens, lower and upper, of a kind and of a material (Al-2011); each pair k has different seeds.
function laboratory.specimens(given)
  local kind, cells, seed, material = given.kind, given.cells, 2 * given.pair, given.material
  return specimen(kind, cells, seed - 1, material), specimen(kind, cells, seed, material)
end

-- Both on the bench: elastic half-spaces whose pressure is capped by hardness. Away from its axis a turned disc
-- touches a fresh surface; on one periodic tile `place` represents this turn.
function laboratory.bench(lower, upper)
  return lab.contact{ lower = lower, upper = upper, boundary = "periodic",
    effects = { elasticity = "half_space", plasticity = {} } }
end

-- The specimen on flat quartz, touched elastically; with a `hardness` (Pa) its spots yield as well.
function laboratory.on_quartz(specimen, hardness)
  return lab.contact{ lower = specimen, upper = lab.material "quartz", boundary = "periodic",
    effects = { elasticity = "half_space", plasticity = hardness and { hardness = hardness } } }
end

-- Profile length over the whole area, along both directions, at 24 steps in equal ratios from one cell to a
-- quarter of a millimetre, rounded to whole cells.
local function by_length(surface)
  local longest, steps = 250 * lab.units.um / (surface.size[1] / surface.cells[1]), {}
  for k = 0, 23 do
    local step = math.floor(longest ^ (k / 23) + 0.5)
    if step ~= steps[#steps] then steps[#steps + 1] = step end
  end
  return surface:fractal_dimension{
    method = "length", along = "both", wrap = true, offsets = true, pooled = true, steps = steps,
  }
end

-- D - 1 by the paper's profile length (eq. 3).
function laboratory.excess(surface) return by_length(surface).D - 1 end

-- Profile length against resolution: the steps in metres, and the excess length over straight lines, L/L0 - 1.
function laboratory.lengths(surface)
  local found, h, steps, stretch = by_length(surface), surface.size[1] / surface.cells[1], {}, {}
  for k, step in ipairs(found.steps) do steps[k], stretch[k] = step * h, found.lengths[k] - 1 end
  return steps, stretch
end

-- Real area over load on quartz (1/Pa), corrected for the outlines of the spots.
function laboratory.area_per_load(surface, hardness)
  local st = laboratory.on_quartz(surface, hardness):press{ pressure = laboratory.probe }
  return st.corrected_area_fraction / st.pressure
end

-- Pressure in the spots of an elastic touch on quartz at the probe pressure, divided by the specimen's hardness: the
-- mean over the real area, and the highest node. Above 1 the specimen would yield. Then the share of the load on
-- nodes above the hardness, and the number of touching nodes.
function laboratory.over_hardness(surface)
  local st, H = laboratory.on_quartz(surface):press{ pressure = laboratory.probe }, surface.material.hardness
  local load, above, nodes = 0, 0, 0
  for _, row in ipairs(st:field("pressure"):values()) do
    for _, p in ipairs(row) do load, above, nodes = load + p, above + (p > H and p or 0), nodes + (p > 0 and 1 or 0) end
  end
  return st.pressure / st.corrected_area_fraction / H, st.peak_pressure / H, above / load, nodes
end

-- Ra and amplitude (m) over the whole map, and by the paper's method: the mean of five levelled traces of 2 mm by
-- a tip of 2 um, a sample every quarter of a micrometre. A seed selects the same lines of every specimen.
function laboratory.roughness(surface, seed)
  local stylus = lab.stylus{ tip = "2 um", length = "2 mm", speed = "50 um/s", rate = "200 Hz" }
  local map, traces, Ra, amplitude = surface:roughness(), stylus:scan(surface, { count = 5, seed = seed }), 0, 0
  for _, trace in ipairs(traces) do
    local along = trace:levelled():roughness()
    Ra, amplitude = Ra + along.Ra / #traces, amplitude + along.amplitude / #traces
  end
  return { ["Ra [m]"] = map.Ra, ["amplitude [m]"] = map.amplitude, ["traced_Ra [m]"] = Ra,
    ["traced_amplitude [m]"] = amplitude }
end

-- The lower specimen after one event at each stress, always from the virgin pair.
function laboratory.after_stress(lower, upper)
  local found = {}
  for k, stress in ipairs(laboratory.stresses) do
    local bench = laboratory.bench(lower, upper)
    bench:press{ pressure = stress }
    bench:release()
    found[k] = bench:lower()
  end
  return found
end

-- The lower specimen after each of `events` (8) at 152.78 MPa. A new placement, drawn from `seed`, precedes each
-- event but the first; with `turning = false` the specimens keep their place.
function laboratory.after_events(lower, upper, given)
  local bench, found = laboratory.bench(lower, upper), {}
  for N = 1, given.events or 8 do
    if N > 1 and given.turning ~= false then bench:place{ seed = (given.seed or 1) * 100 + N } end
    bench:press(laboratory.event)
    bench:release()
    found[N] = bench:lower()
  end
  return found
end

-- A control: the lower face cut by one plane, which removes the volume of the plastic flow under `stress` (Pa).
function laboratory.cut_to_a_plane(lower, upper, stress)
  local st = laboratory.bench(lower, upper):press{ pressure = stress }
  local taken = st.plastic_volume / 2 / (lower.size[1] * lower.size[2]) -- a mean height
  local mean, less, more = lower:roughness().mean, 0, 1 -- less and more: shares of the amplitude
  for _ = 1, 30 do
    local middle = (less + more) / 2
    local cut = mean - lower:cut{ fraction = middle }:roughness().mean
    if cut < taken then less = middle else more = middle end
  end
  return lower:cut{ fraction = more }
end

-- A control: the surface after `times` interpolations, each a shift by part of a cell with a mean of four neighbours.
function laboratory.interpolated(surface, times)
  local hx, hy = surface.size[1] / surface.cells[1], surface.size[2] / surface.cells[2]
  for _ = 1, times do
    local a, b = math.random(), math.random()
    surface = (1 - a) * (1 - b) * surface + a * (1 - b) * surface:shifted{ x = hx }
      + (1 - a) * b * surface:shifted{ y = hy } + a * b * surface:shifted{ x = hx, y = hy }
  end
  return surface
end

-- The paper's measurement: five stylus traces of 2 mm, a sample every quarter of a micrometre. Returns the means of
-- Ra and of D - 1 by profile length at steps of 0.25 to 250 um. A seed selects the same lines.
function laboratory.scanned(surface, seed)
  local stylus = lab.stylus{ tip = "2 um", length = "2 mm", speed = "50 um/s", rate = "200 Hz" }
  local traces, steps = stylus:scan(surface, { count = 5, seed = seed }), {}
  for k = 0, 23 do
    local step = math.floor(1000 ^ (k / 23) + 0.5)
    if step ~= steps[#steps] then steps[#steps + 1] = step end
  end
  local Ra, excess = 0, 0
  for _, trace in ipairs(traces) do
    local along = trace:levelled()
    Ra = Ra + along:roughness().Ra / #traces
    excess = excess + (along:fractal_dimension{ method = "length", offsets = true, steps = steps }.D - 1) / #traces
  end
  return { Ra = Ra, excess = excess }
end

-- The rows whose `column` is `last`, with each roughness divided by that of the rows whose `column` is `first`. Rows
-- that belong together are equal in the columns `keys`.
function laboratory.left(rows, column, first, last, keys)
  local ratios = {}
  for _, name in ipairs{ "Ra", "amplitude", "traced_Ra", "traced_amplitude" } do
    ratios[name] = function(row) return row[name] / row[name .. "_first"] end
  end
  local before = rows:where{ [column] = first }
  return rows:where{ [column] = last }:joined(before, { by = keys, suffix = "_first" }):with(ratios)
end

-- The least-squares line y = intercept + slope x, and the share r2 of the variance of y that it explains.
function laboratory.line(x, y)
  local mx, my, xx, xy, yy = 0, 0, 0, 0, 0
  for k = 1, #x do mx, my = mx + x[k] / #x, my + y[k] / #x end
  for k = 1, #x do
    xx, xy, yy = xx + (x[k] - mx) ^ 2, xy + (x[k] - mx) * (y[k] - my), yy + (y[k] - my) ^ 2
  end
  return { slope = xy / xx, intercept = my - xy / xx * mx, r2 = xy * xy / (xx * yy) }
end

return laboratory

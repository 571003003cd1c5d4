-- SPDX-License-Identifier: GPL-3.0-or-later
-- Functions shared by the examples of the source paper's experiments: Hanaor, Gan and Einav (2013), "Effects of
-- surface structure deformation on static friction at fractal interfaces", Geotechnique Letters 3. Two blasted or
-- self-affine aluminium specimens, the six stresses, the eight events, and the measurements after each: Ra, profile
-- length, real area on quartz. `require "asperity.laboratory"`.
local lab = require "asperity"
local laboratory = {}

-- The paper's nominal stresses, and the one it repeated up to eight times. Each press lasted ten minutes, the
-- reference time of hardness. So the scripts need no creep and no dwell.
local MPa = lab.units.MPa
laboratory.stresses = { 20.37 * MPa, 40.74 * MPa, 61.11 * MPa, 101.86 * MPa, 152.78 * MPa, 203.72 * MPa }
laboratory.event = { pressure = 152.78 * MPa }

laboratory.kinds = { "self-affine", "bead-blasted" }
laboratory.probe = "3 MPa" -- on quartz: enough nodes touch, and area still grows in proportion to load

-- A tile of one millimetre with Ra = 3 um. A grid of 256 cells leaves the shortest wave four cells, too few
-- to resolve it: ratios hold, absolute areas need finer cells.
local function specimen(kind, cells, seed, material)
  local options = {
    cells = cells or 256, size = "1 mm", ra = "3 um", seed = seed, material = material or lab.material "Al-2011",
  }
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
  return lab.contact{
    lower = lower, upper = upper, boundary = "periodic",
    effects = { elasticity = "half_space", plasticity = {} },
  }
end

-- The specimen on flat quartz, touched elastically; with a `hardness` (Pa) its spots yield as well.
function laboratory.on_quartz(specimen, hardness)
  return lab.contact{
    lower = specimen, upper = lab.material "quartz", boundary = "periodic",
    effects = { elasticity = "half_space", plasticity = hardness and { hardness = hardness } },
  }
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

-- Profile length against resolution: the steps in metres, and at each by what share the profiles are longer
-- than straight lines, L/L0 - 1.
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

-- Ra and amplitude (m) over the whole map, and as the paper read them: the mean of five traces of 2 mm by a
-- tip of 2 um, a sample every quarter of a micrometre, each levelled. The same seed goes over the same
-- lines of every specimen.
function laboratory.roughness(surface, seed)
  local stylus = lab.stylus{ tip = "2 um", length = "2 mm", speed = "50 um/s", rate = "200 Hz" }
  local map, traces = surface:roughness(), stylus:scan(surface, { count = 5, seed = seed })
  local row = { Ra = map.Ra, amplitude = map.amplitude, traced_Ra = 0, traced_amplitude = 0 }
  for _, trace in ipairs(traces) do
    local along = trace:levelled():roughness()
    row.traced_Ra = row.traced_Ra + along.Ra / #traces
    row.traced_amplitude = row.traced_amplitude + along.amplitude / #traces
  end
  return row
end

-- The lower specimen after one event at each stress, every one from the same virgin pair.
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

-- The lower specimen after each of `events` (8) at 152.78 MPa, put down afresh from a `seed` before all but
-- the first; with `turning = false`, always as it lay.
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

-- Controls, which must not show the paper's effect.

-- The lower face cut by one plane. The plane removes the same volume as plastic flow under `stress` (Pa) does node by
-- node.
function laboratory.cut_to_a_plane(lower, upper, stress)
  local st = laboratory.bench(lower, upper):press{ pressure = stress }
  local taken = st.plastic_volume / 2 / (lower.size[1] * lower.size[2]) -- a mean height
  local mean = lower:roughness().mean
  local less, more = 0, 1 -- shares of the amplitude
  for _ = 1, 30 do
    local middle = (less + more) / 2
    local cut = mean - lower:cut{ fraction = middle }:roughness().mean
    if cut < taken then less = middle else more = middle end
  end
  return lower:cut{ fraction = more }
end

-- The surface after interpolation at every turn: moved by part of a cell, `times` times, each time a mean of four
-- neighbours.
function laboratory.interpolated(surface, times)
  local hx, hy = surface.size[1] / surface.cells[1], surface.size[2] / surface.cells[2]
  local function weighted(s, weight) return s:scaled{ amplitude = weight * s.peak_to_valley } end
  for _ = 1, times do
    local a, b = math.random(), math.random()
    surface = weighted(surface, (1 - a) * (1 - b))
      :plus(weighted(surface:shifted{ x = hx }, a * (1 - b)))
      :plus(weighted(surface:shifted{ y = hy }, (1 - a) * b))
      :plus(weighted(surface:shifted{ x = hx, y = hy }, a * b))
      :levelled{ degree = 0 } -- `scaled` keeps the mean, so that the sum has four of them
  end
  return surface
end

-- As the paper measured: five stylus traces of 2 mm, a sample every quarter of a micrometre, and of each Ra and D - 1
-- by profile length at steps of 0.25 to 250 um. Means over the traces; the same seed goes over the same lines.
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

-- Evaluation of the numbers.

-- Mean and standard deviation (n - 1) of a list of numbers.
function laboratory.average(numbers)
  local sum, squares = 0, 0
  for _, x in ipairs(numbers) do sum = sum + x end
  local mean = sum / #numbers
  for _, x in ipairs(numbers) do squares = squares + (x - mean) ^ 2 end
  return mean, #numbers > 1 and math.sqrt(squares / (#numbers - 1)) or 0
end

-- The remaining share of every number: last row / first row, column by column.
function laboratory.left(rows)
  local first, last, ratios = rows[1], rows[#rows], {}
  for column, number in pairs(first) do ratios[column] = last[column] / number end
  return ratios
end

-- A column of a row of `paper.means`, as text: the mean, and its scatter over specimens where there is one.
function laboratory.with_scatter(row, column)
  local scatter = row[column .. "_sd"]
  return ("%.3f"):format(row[column]) .. (scatter and (" +- %.3f"):format(scatter) or "")
end

-- A line of a printed table: a name, then a column of every row, in a unit and with so many decimals.
function laboratory.across(name, rows, column, unit, decimals)
  local text = { ("  %-21s"):format(name) }
  for _, row in ipairs(rows) do text[#text + 1] = ("%8." .. decimals .. "f"):format(row[column] / unit) end
  return table.concat(text)
end

-- The least-squares line y = intercept + slope x, and the share r2 of the variance of y that it explains.
function laboratory.line(x, y)
  local mx, my = laboratory.average(x), laboratory.average(y)
  local xx, xy, yy = 0, 0, 0
  for k = 1, #x do
    xx, xy, yy = xx + (x[k] - mx) ^ 2, xy + (x[k] - mx) * (y[k] - my), yy + (y[k] - my) ^ 2
  end
  local slope = xy / xx
  return { slope = slope, intercept = my - slope * mx, r2 = xy * xy / (xx * yy) }
end

return laboratory

-- SPDX-License-Identifier: GPL-3.0-or-later
-- What the examples of the source paper's experiments share: Hanaor, Gan and Einav (2013), "Effects of
-- surface structure deformation on static friction at fractal interfaces", Geotechnique Letters 3. Two
-- blasted or self-affine aluminium specimens, the six stresses, the eight events, and what is measured
-- after each: Ra, profile length, real area on quartz. `require "asperity.laboratory"`.
local lab = require "asperity"
local laboratory = {}

-- The paper's nominal stresses for ten minutes, and the one it repeated up to eight times.
local MPa = lab.units.MPa
laboratory.stresses = { 20.37 * MPa, 40.74 * MPa, 61.11 * MPa, 101.86 * MPa, 152.78 * MPa, 203.72 * MPa }
laboratory.event = { pressure = 152.78 * MPa, dwell = "10 min" }
laboratory.kinds = { "self_affine", "bead_blasted" }
laboratory.names = { self_affine = "self-affine", bead_blasted = "bead-blasted" }
laboratory.tile = 1000 * lab.units.um
laboratory.probe = "3 MPa" -- on quartz: enough nodes touch, and area still grows in proportion to load

-- Two specimens of a kind; pair k has seeds of its own. A grid of 256 cells leaves its shortest wave four
-- cells, too few to resolve it: ratios hold, absolute areas need finer cells.
function laboratory.specimens(given)
  local function specimen(seed)
    local options = {
      cells = given.cells or 256, size = laboratory.tile, ra = "3 um", seed = seed,
      material = lab.material "Al-2011",
    }
    if given.kind == "bead_blasted" then
      options.fine = { short_wave = "16 um" }
      return lab.surface.bead_blasted(options)
    end
    options.hurst, options.roll_off, options.short_wave = 0.8, "250 um", "16 um"
    return lab.surface.self_affine(options)
  end
  return specimen(2 * given.pair - 1), specimen(2 * given.pair)
end

-- Both on the bench: elastic half-spaces whose pressure is capped by hardness. Off its axis a disc that is
-- turned meets ground it has not touched; on one periodic tile `place` stands for it.
function laboratory.bench(lower, upper)
  return lab.contact{
    lower = lower, upper = upper, boundary = "periodic",
    effects = { elasticity = "half_space", plasticity = {} },
    accuracy = { tolerance = 1e-6 },
  }
end

-- The specimen on flat quartz, touched elastically; with a `hardness` its spots yield as well.
function laboratory.on_quartz(specimen, hardness)
  return lab.contact{
    lower = specimen, upper = lab.material "quartz", boundary = "periodic",
    effects = { elasticity = "half_space", plasticity = hardness and { hardness = hardness } },
  }
end

-- 24 spacings in equal ratios from one cell to a quarter of a millimetre, rounded to whole cells.
local function steps_for(surface)
  local h = surface.size[1] / surface.cells[1]
  local longest, steps = 250 * lab.units.um / h, {}
  for k = 0, 23 do
    local step = math.floor(longest ^ (k / 23) + 0.5)
    if step ~= steps[#steps] then steps[#steps + 1] = step end
  end
  return steps
end

-- Profile length against resolution: L/L0 - 1 at every step, and the steps in metres.
function laboratory.lengths(surface)
  local d = surface:fractal_dimension{
    method = "length", along = "both", wrap = true, offsets = true, pooled = true, steps = steps_for(surface),
  }
  local h, steps, stretch = surface.size[1] / surface.cells[1], {}, {}
  for k, step in ipairs(d.steps) do steps[k], stretch[k] = step * h, d.lengths[k] - 1 end
  return steps, stretch
end

-- D - 1 by the paper's profile length (eq. 3), over the whole area and both directions.
function laboratory.excess(surface)
  return surface:fractal_dimension{
    method = "length", along = "both", wrap = true, offsets = true, pooled = true, steps = steps_for(surface),
  }.D - 1
end

-- Real area over load on quartz, 1/Pa, corrected for the outlines of its spots.
function laboratory.area_per_load(surface, hardness)
  local st = laboratory.on_quartz(surface, hardness):press{ pressure = laboratory.probe }
  return st.corrected_area_fraction / st.pressure
end

-- Ra and amplitude as the paper read them: the mean of five traces of 2 mm by a tip of 2 um, a sample every
-- quarter of a micrometre, each levelled. The same seed goes over the same lines of every specimen.
function laboratory.traced(surface, seed)
  local stylus = lab.stylus{ tip = "2 um", length = "2 mm", speed = "50 um/s", rate = "200 Hz" }
  local traces, Ra, amplitude = stylus:scan(surface, { count = 5, seed = seed }), 0, 0
  for _, trace in ipairs(traces) do
    local roughness = trace:levelled():roughness()
    Ra, amplitude = Ra + roughness.Ra / #traces, amplitude + roughness.amplitude / #traces
  end
  return Ra, amplitude
end

-- The lower specimen after one event at each stress, every one from the same virgin pair.
function laboratory.after_stress(lower, upper)
  local found = {}
  for k, stress in ipairs(laboratory.stresses) do
    local bench = laboratory.bench(lower, upper)
    bench:press{ pressure = stress, dwell = "10 min" }
    bench:release()
    found[k] = bench:lower()
  end
  return found
end

-- The lower specimen after each of N events, put down afresh before all but the first; with
-- `turning = false`, always as it lay.
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

-- Controls, which must not show what the paper found.

-- The lower face cut by one plane that takes as much as its share of what yielded node by node.
function laboratory.cut_to_a_plane(lower, upper, stress)
  local st = laboratory.bench(lower, upper):press{ pressure = stress, dwell = "10 min" }
  local taken = st.plastic_volume / 2 / (lower.size[1] * lower.size[2]) -- a mean height
  local mean = lower:roughness().mean
  local less, more = 0, 1 -- shares of the amplitude
  for _ = 1, 30 do
    local middle = (less + more) / 2
    if mean - lower:cut{ fraction = middle }:roughness().mean < taken then less = middle else more = middle end
  end
  return lower:cut{ fraction = more }
end

-- The surface as a store would hold it that interpolates at every turn: moved by part of a cell, `times`
-- times, each time a mean of four neighbours.
function laboratory.interpolated(surface, times)
  local hx, hy = surface.size[1] / surface.cells[1], surface.size[2] / surface.cells[2]
  local function weighted(s, weight) return s:scaled{ amplitude = weight * s.peak_to_valley } end
  for _ = 1, times do
    local a, b = math.random(), math.random()
    surface = weighted(surface, (1 - a) * (1 - b))
      :plus(weighted(surface:shifted{ x = hx }, a * (1 - b)))
      :plus(weighted(surface:shifted{ y = hy }, (1 - a) * b))
      :plus(weighted(surface:shifted{ x = hx, y = hy }, a * b))
  end
  return surface
end

-- What is made of the numbers.

-- Mean and standard deviation (n - 1) of a list of numbers.
function laboratory.average(numbers)
  local sum, squares = 0, 0
  for _, x in ipairs(numbers) do sum = sum + x end
  local mean = sum / #numbers
  for _, x in ipairs(numbers) do squares = squares + (x - mean) ^ 2 end
  return mean, #numbers > 1 and math.sqrt(squares / (#numbers - 1)) or 0
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

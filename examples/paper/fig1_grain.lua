-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 1: what does a grain look like whose outline is round at a distance and fractal close by?
--
--   asperity run examples/paper/fig1_grain.lua
--   asperity run examples/paper/fig1_grain.lua -- amplitude=0.05 points=8192
--   asperity run examples/paper/fig1_grain.lua -- seed=7
--
-- The paper: a quasi-spherical grain, a circle with a rough outline, as the picture of what meets at a
-- contact.
-- Here: r = R (1 + amplitude w), where w sums cosine waves around the outline, gamma = 1.5 times
-- shorter from one to the next. The size of the roughness is the same at every D; what D changes is how
-- much of it is in the short waves, and so the length of the outline. The waves fit around the grain a
-- whole number of times, which makes its structure function known exactly: step 3 checks it.

local lab = require "asperity"
local arguments = require "asperity.arguments"
local um = lab.units.um

local options = arguments({ seed = 1, points = 2048, amplitude = 0.1 }, ...)
local R, K = 100 * um, options.points

-- The mean square of w(t + q) - w(t) over the outline, from the waves alone: for every set of phases.
local function waves(D)
  local list, n = {}, 0
  while true do
    local k = math.floor(3 * 1.5 ^ n + 0.5)
    if 2 * k > K then return list end
    list[#list + 1] = { k = k, power = 1.5 ^ (2 * (D - 2) * n) }
    n = n + 1
  end
end
local function known_structure(list, q)
  local sum = 0
  for _, wave in ipairs(list) do sum = sum + wave.power * (1 - math.cos(2 * math.pi * wave.k * q / K)) end
  return sum
end
local function structure(heights, q)
  local sum, n = 0, #heights
  for t, height in ipairs(heights) do sum = sum + (heights[(t + q - 1) % n + 1] - height) ^ 2 end
  return sum / n
end

-- 1. Five grains with the same phases, each drawn to scale.
local book, quarter = lab.notebook "grains", lab.notebook "quarter"
print(("Grains of R = 100 um, roughness +- %g %% of R, %d points, seed %d\n"):format(
  100 * options.amplitude, K, options.seed))
print "  D     Rq (um)   outline / circle   D by structure function   worst error of the structure function"
for _, D in ipairs{ 1.1, 1.2, 1.3, 1.4, 1.5 } do
  local grain = lab.surface.grain_profile{
    radius = R, D = D, amplitude = options.amplitude, points = K, seed = options.seed,
  }
  grain:picture(("grain_%.1f.png"):format(D), { title = ("D = %.1f"):format(D) })

  -- 2. How long the outline is, as a polygon through all points, against the circle's.
  local heights = grain:heights()
  local length = 0
  for t, height in ipairs(heights) do
    local here, after = R + height, R + heights[t % #heights + 1]
    length = length + math.sqrt(here ^ 2 + after ^ 2 - 2 * here * after * math.cos(2 * math.pi / K))
  end

  -- 3. The structure function at many lags against the exact one. The scale of the heights is unknown
  --    from outside: the variance, half the sum of all powers, gives it.
  local list = waves(D)
  local all = 0
  for _, wave in ipairs(list) do all = all + wave.power end
  local Rq = grain:roughness().Rq
  local worst = 0
  for _, q in ipairs{ 1, 2, 3, 5, 8, 13, 55, 144, K // 4, K // 2 } do
    local exact = known_structure(list, q) * 2 * Rq ^ 2 / all
    worst = math.max(worst, math.abs(structure(heights, q) / exact - 1))
  end

  -- 4. D again, from the heights alone.
  local measured = grain:fractal_dimension{ method = "structure", steps = { 1, 2, 4, 8, 16 }, wrap = true }.D
  print(("  %.1f    %.3f       %.3f                 %.3f                        %.1e"):format(D, Rq / um,
    length / (2 * math.pi * R), measured, worst))
  book:write{ D = D, ["Rq [m]"] = Rq, ["amplitude [m]"] = grain:roughness().amplitude,
    outline = length / (2 * math.pi * R), D_measured = measured, structure_error = worst }
  for t, height in ipairs(heights) do
    if 4 * t <= K then quarter:write{ D = D, angle = 360 * (t - 1) / K, ["height [m]"] = height } end
  end
end

-- 5. What must hold whatever the phases.
book:expect("structure_error", { at_most = 1e-10, label = "exact for every set of phases" })
book:expect("amplitude", { near = 2 * options.amplitude * R, rel = 1e-12 })
book:expect("outline", { increasing_in = "D", label = "a rougher outline is longer" })
book:expect("D_measured", { increasing_in = "D" })

-- 6. A quarter of three outlines, unrolled.
quarter:chart{
  x = "angle", y = "height", one_line_per = "D", where = { D = { 1.1, 1.3, 1.5 } }, points = false,
  file = "fig1_unrolled.svg", title = "A quarter of the outline, unrolled", x_label = "angle (degrees)",
  y_label = "distance from the circle",
}

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 1: what does a grain look like whose outline is round at a distance and fractal close by?
--
--   asperity run examples/paper/fig1_grain.lua
--
-- A grain is a circle with a rough outline, r = R (1 + amplitude w). The amplitude is equal at
-- every D; D sets the share of the short waves in w, and so the length of the outline.

local lab = require "asperity"

local options = require "asperity.arguments"({ seed = 1, points = 2048, amplitude = 0.1 }, ...)
local R, K = lab.quantity "100 um", options.points

-- 1. Five grains with the same phases, each drawn to scale.
local book, quarter = lab.notebook "grains", lab.notebook "quarter"
lab.say("Grains of R = 100 um, roughness +- %g %% of R, %d points, seed %d", 100 * options.amplitude, K,
  options.seed)
for _, D in ipairs{ 1.1, 1.2, 1.3, 1.4, 1.5 } do
  local grain = lab.surface.grain_profile{ radius = R, D = D, amplitude = options.amplitude,
    points = K, seed = options.seed }
  grain:picture(("grain_%.1f.png"):format(D), { title = ("D = %.1f"):format(D) })

  -- 2. The length of the outline, a polygon through all points, over the length of the circle.
  local heights = grain:heights()
  local length = 0
  for t, height in ipairs(heights) do
    local here, after = R + height, R + heights[t % K + 1]
    length = length + math.sqrt(here ^ 2 + after ^ 2 - 2 * here * after * math.cos(2 * math.pi / K))
  end

  -- 3. The structure function at many lags against the exact function of any phases. w sums cosine
  --    waves around the outline, each 1.5 times shorter than the one before, each a whole number of
  --    times. The variance, half the sum of the powers, gives the scale of the heights.
  local r, worst = grain:roughness(), 0
  for _, q in ipairs{ 1, 2, 3, 5, 8, 13, 55, 144, K // 4, K // 2 } do
    local exact, all, found = 0, 0, 0
    for n = 0, K do
      local k, power = math.floor(3 * 1.5 ^ n + 0.5), 1.5 ^ (2 * (D - 2) * n)
      if 2 * k > K then break end
      exact = exact + power * (1 - math.cos(2 * math.pi * k * q / K))
      all = all + power
    end
    for t, z in ipairs(heights) do found = found + (heights[(t + q - 1) % K + 1] - z) ^ 2 end
    worst = math.max(worst, math.abs(found / K / (exact * 2 * r.Rq ^ 2 / all) - 1))
  end

  -- 4. D measured, the error without roundings of math.cos, and a quarter of the outline.
  book:write{ D = D, Rq = r.Rq, amplitude = r.amplitude, outline = length / (2 * math.pi * R),
    D_measured = grain:fractal_dimension{ method = "structure", wrap = true }.D,
    structure_error = worst > 1e-12 and worst or 0 }
  for t = 1, K // 4 do
    quarter:write{ D = D, ["angle [deg]"] = 360 * (t - 1) / K, ["height [m]"] = heights[t] }
  end
end
print "The length of the outline over that of the circle, and the worst error of the structure function:"
book:show{ "D", "Rq [um]", "outline", "D_measured", "structure_error", digits = 4 }

-- 5. Expectations for any phases.
book:expect("structure_error", { at_most = 1e-10, label = "exact for every set of phases" })
book:expect("amplitude", { near = 2 * options.amplitude * R, rel = 1e-12 })
book:expect("outline", { increasing_in = "D", label = "a rougher outline is longer" })
book:expect("D_measured", { increasing_in = "D" })

-- 6. A quarter of three outlines, unrolled.
quarter:chart{ x = "angle", y = "height", one_line_per = "D", where = { D = { 1.1, 1.3, 1.5 } },
  points = false, file = "fig1_unrolled.svg", title = "A quarter of the outline, unrolled",
  y_label = "distance from the circle" }

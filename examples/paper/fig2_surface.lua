-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 2: what is a fractal surface built on, and what does the fractal dimension D add to it?
--
--   asperity run examples/paper/fig2_surface.lua
--
-- The base is the sum of the longest waves (n = 0, 1, 2) with the same phases; D sets how slowly
-- the amplitudes decrease. At D = 2.0 the base has nine tenths of the variance. At D = 2.9 it has a
-- fifth, and two fifths belong to waves too short for 150 cells, which appear as noise.

local lab = require "asperity"

local options = require "asperity.arguments"({ seed = 1, cells = 150, span = 1.0, base = 2 }, ...)

-- Waves in ten directions, each 1.5 times shorter than the one before. In eq. (2) as printed the
-- phases change nothing, so we use the form of Yan and Komvopoulos.
local function wm(D, n_max)
  return lab.surface.weierstrass_mandelbrot{ cells = options.cells, D = D, span = options.span,
    L = "50 um", G = "5 um", n_max = n_max, seed = options.seed }
end

-- The share of the waves n = 0 .. last in the variance. Wave n has the weight gamma^(2 (D - 3) n).
local function share(D, last)
  local q = 1.5 ^ (2 * (D - 3))
  return (1 - q ^ (last + 1)) / (1 - q ^ 101)
end

-- 1. The base, and the surface for five D, all scaled to one amplitude. Colours show heights above
--    the mean.
local amplitude = lab.quantity "5 um"
local function scaled(surface) return surface:scaled{ amplitude = amplitude }:levelled{ degree = 0 } end
local function draw(surface, stem, title)
  local s, range = scaled(surface), { -amplitude / 2, amplitude / 2 }
  s:picture(stem .. "_map.png", { title = title, range = range })
  s:picture(stem .. "_relief.png", { title = title, range = range, view = "relief" })
end
draw(wm(2.3, options.base), "base", ("base of D = 2.3: waves n = 0 to %d"):format(options.base))

local book = lab.notebook "surfaces"
lab.say("Weierstrass-Mandelbrot surfaces, %d x %d cells over %g L, seed %d", options.cells, options.cells,
  options.span, options.seed)
for _, D in ipairs{ 2.0, 2.3, 2.5, 2.7, 2.9 } do
  local surface, base = wm(D), wm(D, options.base)
  local r, b, both = surface:roughness(), base:roughness().Rq, (surface + base):roughness().Rq
  book:write{ D = D, rms = r.Rq, peak_to_valley = r.amplitude,
    ["in the base"] = share(D, options.base), ["beyond the grid"] = surface.aliased_share,
    like_base = (both ^ 2 - r.Rq ^ 2 - b ^ 2) / (2 * r.Rq * b), -- correlation
    D_measured = surface:fractal_dimension{ method = "structure" }.D + 1 }
  draw(surface, ("surface_%.1f"):format(D), ("D = %.1f"):format(D))
end
print "Heights by eq. (2); shares of the variance; correlation with the base; D of profiles + 1:"
book:show{ "D", "rms [um]", "peak_to_valley [um]", "in the base", "beyond the grid", "like_base",
  "D_measured", digits = 4 }

-- 2. The effect of D, for any phases. The first wave shorter than two cells is n = 11 at span 1 and
--    150 cells. The measured D follows the given D.
book:expect("in the base", { decreasing_in = "D" })
book:expect("beyond the grid", { increasing_in = "D" })
book:expect("D_measured", { increasing_in = "D" })
if options.cells == 150 and options.span == 1 then
  for row in book:each() do
    local where = { D = row.D }
    book:expect("beyond the grid", { where = where, near = 1 - share(row.D, 10), rel = 1e-9 })
    book:expect("D_measured", { where = where, near = row.D, within = 0.25 })
  end
end

-- 3. Phases are exact. The golden phases are reproducible, and the heights below were computed with
--    420 bits. (L and G are the paper's values, in metres. With phases in plain doubles, the last
--    heights would be wrong by up to 26.)
local exact = lab.notebook "exact"
for _, line in ipairs{
  { 2.5, 1, 0, -0.5383048380187191 }, { 2.5, 3, 7, 0.5925490453921832 },
  { 2.5, 75, 75, 12.113727585722931 }, { 2.5, 149, 149, 11.537855201082617 },
  { 2.99, 1, 0, -31.324843705314891 }, { 2.99, 3, 7, -13.20985640310383 },
  { 2.99, 75, 75, 17.109113313201217 }, { 2.99, 149, 149, 0.5141096344990127 },
} do
  local D, i, j, z = table.unpack(line)
  local s = lab.surface.weierstrass_mandelbrot{ cells = 150, D = D, phases = "golden" }
  exact:write{ D = D, i = i, j = j, ["z [m]"] = s:height(i, j), error = math.abs(s:height(i, j) - z) }
end
exact:expect("error", { at_most = 1e-10, label = "heights of the golden surface" })

-- 4. Profiles through the middle, and the share of the base in the variance.
local middle = lab.notebook "profiles"
for _, D in ipairs{ 2.0, 2.5, 2.9 } do
  local p = scaled(wm(D)):profile{ row = options.cells // 2 }
  local x = p:positions()
  for k, z in ipairs(p:heights()) do middle:write{ D = D, ["x [m]"] = x[k], ["height [m]"] = z } end
end
middle:chart{ x = "x", y = "height", one_line_per = "D", points = false, file = "fig2_profiles.svg",
  title = "The same phases at three D" }
book:chart{ x = "D", y = { "in the base", "beyond the grid" }, file = "fig2_variance.svg",
  title = "Where the variance is", x_label = "fractal dimension D",
  y_label = "share of the variance" }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 2: what is a fractal surface built on, and what does the fractal dimension D add to it?
--
--   asperity run examples/paper/fig2_surface.lua
--   asperity run examples/paper/fig2_surface.lua -- seed=7 cells=300
--   asperity run examples/paper/fig2_surface.lua -- span=3
--
-- The paper: a Weierstrass-Mandelbrot surface (eq. 2) beside its non-fractal base.
-- Here: the surface sums waves in M = 10 directions, each gamma = 1.5 times shorter than the last. Its
-- base is the same sum with the longest waves alone (n = 0, 1, 2), and the same phases: low waves do not
-- depend on how many follow. D sets how slowly the waves weaken. At D = 2.0 nine tenths of the variance
-- is in the base; at 2.9 a fifth is, and two fifths is in waves that 150 cells cannot carry, which act
-- as noise on every cell.
-- Choices of this project: eq. (2) as printed has phases that change nothing, and is used in the form of Yan and
-- Komvopoulos, where they do; and the base of n <= 2, which the paper does not define.

local lab = require "asperity"
local arguments = require "asperity.arguments"
local um = lab.units.um

local options = arguments({ seed = 1, cells = 150, span = 1.0, base = 2 }, ...)

local function wm(D, n_max)
  return lab.surface.weierstrass_mandelbrot{
    cells = options.cells, D = D, span = options.span, L = "50 um", G = "5 um", gamma = 1.5, M = 10,
    n_max = n_max, seed = options.seed,
  }
end

-- How alike two surfaces are: the correlation of their heights.
local function correlation(a, b)
  local x, y, ma, mb = a:heights(), b:heights(), a:roughness().mean, b:roughness().mean
  local sum, n = 0, 0
  for j = 1, #x do
    for i = 1, #x[j] do
      sum, n = sum + (x[j][i] - ma) * (y[j][i] - mb), n + 1
    end
  end
  return sum / n / (a:roughness().Rq * b:roughness().Rq)
end

-- The share of the variance in the waves n = 0 .. last: wave n carries gamma^(2 (D - 3) n) of it.
local function share(D, last)
  local q = 1.5 ^ (2 * (D - 3))
  return (1 - q ^ (last + 1)) / (1 - q ^ 101)
end

-- 1. The base, and the surface for five D, each stretched to one amplitude so that they can be compared.
--    The colours are those of heights above the mean.
local amplitude = 5 * um
local function draw(surface, stem, title)
  local s = surface:scaled{ amplitude = amplitude }:levelled{ degree = 0 }
  local range = { -amplitude / 2, amplitude / 2 }
  s:picture(stem .. "_map.png", { title = title, range = range })
  s:picture(stem .. "_relief.png", { title = title, range = range, view = "relief" })
end
draw(wm(2.3, options.base), "base", ("base of D = 2.3: waves n = 0 to %d"):format(options.base))

local book = lab.notebook "surfaces"
print(("Weierstrass-Mandelbrot surfaces, %d x %d cells over %g L, seed %d\n"):format(options.cells,
  options.cells, options.span, options.seed))
print "         heights as eq. (2) gives them       variance in      like its   D of profiles + 1,"
print "  D     rms (um)  peak to valley (um)   base   beyond grid    base      by structure function"
for _, D in ipairs{ 2.0, 2.3, 2.5, 2.7, 2.9 } do
  local surface, base = wm(D, 100), wm(D, options.base)
  local r = surface:roughness()
  local row = {
    D = D, ["rms [m]"] = r.Rq, ["peak_to_valley [m]"] = r.amplitude,
    ["in the base"] = share(D, options.base), ["beyond the grid"] = surface.aliased_share,
    like_base = correlation(surface, base),
    D_measured = surface:fractal_dimension{ method = "structure" }.D + 1,
  }
  book:write(row)
  print(("  %.1f   %6.2f        %6.1f           %.3f     %.4f       %.3f            %.2f"):format(
    D, r.Rq / um, r.amplitude / um, row["in the base"], row["beyond the grid"], row.like_base,
    row.D_measured))
  draw(surface, ("surface_%.1f"):format(D), ("D = %.1f"):format(D))
end

-- 2. What D does, whatever the phases. The first wave past the grid's limit of two cells is n = 11 at
--    span 1 and 150 cells; the measured D follows the one given.
book:expect("in the base", { decreasing_in = "D" })
book:expect("beyond the grid", { increasing_in = "D" })
book:expect("D_measured", { increasing_in = "D" })
if options.cells == 150 and options.span == 1 then
  for _, D in ipairs{ 2.0, 2.3, 2.5, 2.7, 2.9 } do
    book:expect("beyond the grid", { where = { D = D }, near = 1 - share(D, 10), rel = 1e-9 })
    book:expect("D_measured", { where = { D = D }, near = D, within = 0.25 })
  end
end

-- 3. Waves fall into place exactly: with the golden phases anyone can compute these heights again. They
--    were, with 420 bits. (L and G are those of the paper, in metres. With the phase kept in plain
--    doubles the last ones would be off by up to 26.)
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

-- 4. Profiles through the middle, and how the variance moves from base to grid.
local middle = lab.notebook "profiles"
for _, D in ipairs{ 2.0, 2.5, 2.9 } do
  local s = wm(D, 100):scaled{ amplitude = amplitude }:levelled{ degree = 0 }
  local p = s:profile{ row = options.cells // 2 }
  local x = p:positions()
  for k, z in ipairs(p:heights()) do middle:write{ D = D, ["x [m]"] = x[k], ["height [m]"] = z } end
end
middle:chart{
  x = "x", y = "height", one_line_per = "D", points = false, file = "fig2_profiles.svg",
  title = "The same phases at three D",
}
book:chart{
  x = "D", y = { "in the base", "beyond the grid" }, file = "fig2_variance.svg",
  title = "Where the variance is", x_label = "fractal dimension D", y_label = "share of the variance",
}

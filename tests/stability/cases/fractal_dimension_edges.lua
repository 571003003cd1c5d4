-- SPDX-License-Identifier: GPL-3.0-or-later
-- D from 2 to 3: the heights, and the share of their variance beyond the grid.
--
-- Wave n has amplitude γ^((D-3)n). At D = 2 the longest waves have nearly all the variance. At D = 3 all
-- waves have the same variance, and most are far beyond the grid. The program must report the share of the
-- variance beyond Nyquist, a quotient of two geometric series. A D outside 2 to 3 is no dimension of a
-- surface.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 7, title = "Fractal dimension from 2 to 3", edge = "D from 2 to 3, to one ulp past either end;"
    .. " spans 1 and 3; Hurst exponents from 1e-6 to 1",
  elsewhere = "As D approaches 3, most of the height is in waves shorter than a cell, which alias. The"
    .. " surface is grid noise, different on every grid, and there is no warning.",
  here = "Heights change with D without a jump, up to both ends. `aliased_share` is the share of the variance"
    .. " beyond the grid, and `band = \"resolved\"` leaves it out.",
}

-- Share of the variance beyond Nyquist (more than half a turn per grid step), wave by wave.
local function share(D, span, cells)
  local all, past = 0, 0
  for n = 100, 0, -1 do
    local power = 1.5 ^ (2 * (D - 3) * n)
    all = all + power
    if 1.5 ^ n * span / cells > 0.5 then past = past + power end
  end
  return past / all
end

local book = lab.notebook "aliased"
for _, D in ipairs{ 2, 2.1, 2.3, 2.5, 2.7, 2.9, 2.99, 2.999, 3 } do
  local row = { D = D }
  for _, span in ipairs{ 1, 3 } do
    local s = lab.surface.weierstrass_mandelbrot{ cells = 150, D = D, span = span, seed = 1 }
    local kept = lab.surface.weierstrass_mandelbrot{ cells = 150, D = D, span = span, seed = 1,
      band = "resolved" }
    local wanted = share(D, span, 150)
    row["share " .. span], row["error " .. span] = s.aliased_share, math.abs(s.aliased_share - wanted)
    row["left " .. span] = kept.aliased_share
    row["Rq " .. span], row["kept " .. span] = s:roughness().Rq, kept:roughness().Rq
  end
  book:write(row)
end
case:evidence(book, "Share of the variance beyond Nyquist, 150 x 150 nodes, against the sum over waves.",
  { { "D", "%g" },
  { "share 1", "%.4f", "span 1" }, { "error 1", "%.0e", "difference" }, { "share 3", "%.4f", "span 3" },
  { "error 3", "%.0e", "difference" }, { "left 3", "%.0f", "left in the resolved band" },
  { "Rq 3", "%.3f", "Rq, span 3" },
  { "kept 3", "%.3f", "Rq of the resolved band" } })
for _, span in ipairs{ 1, 3 } do
  case:expect(book, "error " .. span, { at_most = 1e-14 }) -- measured 1e-15
  case:expect(book, "left " .. span, { at_most = 0 })
  case:expect(book, "share " .. span, { increasing_in = "D" })
end

-- No jump at the ends: one ulp inside an end, the heights agree to rounding.
local ends = lab.notebook "ends"
for _, pair in ipairs{ { 2, 2 + 2 ^ -51 }, { 2.5, 2.5 + 2 ^ -51 }, { 3, 3 - 2 ^ -51 } } do
  local a = lab.surface.weierstrass_mandelbrot{ cells = 64, D = pair[1], seed = 2 }
  local b = lab.surface.weierstrass_mandelbrot{ cells = 64, D = pair[2], seed = 2 }
  local worst = 0
  for j = 0, 63 do
    for i = 0, 63 do worst = math.max(worst, math.abs(a:height(i, j) - b:height(i, j))) end
  end
  ends:write{ D = pair[1], Rq = a:roughness().Rq, change = worst / a:roughness().Rq }
end
case:evidence(ends, "Largest change of a height over Rq for one ulp of D inwards.",
  { { "D", "%g" }, { "Rq", "%.3f" }, { "change", "%.0e" } })
case:expect(ends, "change", { at_most = 3e-13 }) -- measured 3e-14

-- Hurst exponents of Gaussian surfaces, D = 3 - H: the requested height and slope are exact for any H.
local hurst = lab.notebook "hurst"
for _, H in ipairs{ 1e-6, 0.01, 0.1, 0.5, 0.9, 0.99, 1 } do
  local s = lab.surface.self_affine{ cells = 96, size = 1, hurst = H, rms_height = 1, short_wave = 2 / 96 }
  local t = lab.surface.self_affine{ cells = 96, size = 1, hurst = H, rms_slope = 0.3, short_wave = 6 / 96 }
  hurst:write{ H = H, height = math.abs(s:roughness().Rq - 1),
    slope = math.abs(t:spectrum().rms_slope / 0.3 - 1) }
end
case:evidence(hurst, "Gaussian surfaces of Hurst exponent H = 3 - D, waves down to two cells (height) and"
  .. " six cells (slope): relative error of the requested rms height and slope.",
  { { "H", "%g" }, { "height", "%.0e" },
  { "slope", "%.0e" } })
case:expect(hurst, "height", { at_most = 3e-15 }) -- measured 3e-16
case:expect(hurst, "slope", { at_most = 3e-15 }) -- measured 3e-16

for _, D in ipairs{ 2 - 2 ^ -51, 3 + 2 ^ -51, 1.5, 0 / 0, math.huge } do
  case:refused(("D = %.17g"):format(D):gsub("-nan", "nan"), function() lab.surface.weierstrass_mandelbrot{ cells = 16,
    D = D } end, "`D`")
end
case:refused("H = 0", function() lab.surface.self_affine{ cells = 16, size = 1, hurst = 0, rms_height = 1,
  short_wave = 0.2 } end, "`hurst`")
case:refused("waves shorter than two cells", function()
  lab.surface.self_affine{ cells = 16, size = 1, hurst = 0.5, rms_height = 1, short_wave = 0.1249 }
end, "`short_wave`")
case:finish{ worst = "3e-14 of Rq one ulp inside the ends", verdict = "right answer, then a clear error" }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Two bodies of one size, one of them turned: only their overlap may carry load.
--
-- A map of fixed size has a height at every node. A solver that fills the empty corners of a turned body with
-- the lowest height or with zero presses an invisible flat there. Crossed bars must carry load as their
-- common square does: outside the square the gap is missing and the pressure is zero.
--! error: the bodies face each other on

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 25, title = "Bodies that do not cover each other",
  edge = "turns by 1 to 90 deg on a free boundary, overlaps from 25 to 99 % of the tile; loads up to far past"
    .. " full contact of the overlap",
  elsewhere = "The turned map is filled up to its rectangle, and the filling carries load: 43 % of the"
    .. " contact nodes of two patches turned by 90 deg.",
  here = "Outside the overlap there is no pressure and no gap. Means are over the overlap, `pressure` is"
    .. " load over the tile, `overlap_fraction` is the overlap over the tile, and the first press warns.",
}

local al = lab.material{ young = "70 GPa", poisson = 0.33, hardness = "1.1 GPa" }
local function dome(cells, size)
  return lab.surface.sphere{ cells = cells, size = size, radius = "1 m", shape = "paraboloid", material = al }
end

-- 1. Crossed bars of four by one, against their common square pressed alone.
local bars = lab.notebook "bars"
for _, way in ipairs{ "box", "half_space", "capped", "hardening" } do
  local effects = { elasticity = way == "box" and "box" or "half_space" }
  if way == "capped" then effects.plasticity = {} end
  if way == "hardening" then effects.plasticity = { hardening = "50 MPa/um" } end
  local accuracy = { tolerance = 1e-11 }
  local function bar() return dome({ 32, 128 }, { "1 mm", "4 mm" }) end
  local function square() return dome(32, "1 mm") end
  local long = lab.contact{ lower = bar(), upper = bar(), boundary = "free", effects = effects, accuracy = accuracy }
  local short = lab.contact{ lower = square(), upper = square(), boundary = "free", effects = effects,
    accuracy = accuracy }
  long:rotate "90 deg"
  short:rotate "90 deg"
  for _, press in ipairs{ { load = 50 }, { approach = "0.1 um" } } do
    local a, b = long:copy():press(press), short:copy():press(press)
    local off, worst, P, Q = 0, 0, a:field "pressure", b:field "pressure"
    for j = 0, 127 do
      for i = 0, 31 do
        local p = P:value(i, j)
        if j < 48 or j >= 80 then off = off + p
        else worst = math.max(worst, math.abs(p - Q:value(i, j - 48)) / b.peak_pressure) end
      end
    end
    bars:write{ way = way .. (press.load and ", load" or ", approach"), overlap = a.overlap_fraction, off = off,
      worst = worst, load = math.abs(a.load / b.load - 1), certificate = a.residual }
  end
end
case:evidence(bars, "Bars of 32 x 128 nodes crossed at 90 deg, against their 32 x 32 common nodes.",
  { { "way", "%s" }, { "overlap", "%.2f" }, { "off", "%g", "pressure outside the overlap" },
  { "worst", "%.0e", "worst pressure, over the peak" }, { "load", "%.0e" }, { "certificate", "%.0e" } })
case:expect(bars, "off", { near = 0, within = 0 })
case:expect(bars, "worst", { at_most = 1e-7 })
case:expect(bars, "load", { at_most = 1e-9 })

-- 2. At any angle and any load, the contact area is at most the overlap.
local turns = lab.notebook "turns"
for _, angle in ipairs{ 1, 10, 45, 80 } do
  local rough = function(seed)
    return lab.surface.self_affine{ cells = 48, size = "1 mm", hurst = 0.8, rms_slope = 0.05, short_wave = "125 um",
      seed = seed, material = al }
  end
  local c = lab.contact{ lower = rough(1), upper = rough(2), boundary = "free",
    effects = { elasticity = "half_space" } }
  c:rotate(angle .. " deg")
  for _, p in ipairs{ 1e6, 1e9, 1e13 } do
    local st = c:press{ pressure = p }
    local gap, missing, carried = st:field "gap", 0, 0
    local P = st:field "pressure"
    for j = 0, 47 do
      for i = 0, 47 do
        local g = gap:value(i, j)
        if g ~= g then missing, carried = missing + 1, carried + P:value(i, j) end
      end
    end
    turns:write{ angle = angle, pressure = p, overlap = st.overlap_fraction, area = st.area_fraction,
      beyond = st.area_fraction > st.overlap_fraction and 1 or 0, carried = carried,
      unlike = math.abs(1 - missing / 48 ^ 2 - st.overlap_fraction), certificate = st.residual }
  end
end
case:evidence(turns, "Turned rough bodies of 48 x 48 nodes.",
  { { "angle", "%g", "deg" }, { "pressure", "%.0e", "Pa" }, { "overlap", "%.4f" }, { "area", "%.4f" },
  { "carried", "%g", "pressure outside the overlap" }, { "certificate", "%.0e" } })
case:expect(turns, "carried", { near = 0, within = 0 })
case:expect(turns, "beyond", { near = 0, within = 0 })
case:expect(turns, "unlike", { at_most = 1e-12 })
case:expect(turns, "certificate", { at_most = 1e-6 })
case:finish{ worst = "1e-7 of the peak", verdict = "right answer, with a warning" }

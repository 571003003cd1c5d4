-- SPDX-License-Identifier: GPL-3.0-or-later
-- The cells part of single rough contacts holds the answer of a four times finer grid, and is not many times too wide:
-- 24 contacts of bench/budget_coverage.lua. With the change of two grids as a drift, 23 of 96 were held.
--! output: held, and not too wide
local lab = require "asperity"
math.randomseed(3)
local body = lab.material{ young = 1, poisson = 0 }
local quantities = { "corrected_area_fraction", "approach", "energy", "mean_gap" }
local held, widths, errors = 0, {}, {}
for seed = 1, 24 do
  local hurst, slope, wave = 0.5 + 0.4 * math.random(), 0.05 * 4 ^ math.random(), 3.2 ^ math.random() / 16
  local share, boundary = 0.01 * 20 ^ math.random(), seed % 2 == 0 and "periodic" or "free"
  local pressed = {}
  local function press(cells)
    pressed[cells] = pressed[cells] or lab.contact{
      lower = lab.surface.self_affine{ cells = cells, size = 1, hurst = hurst, rms_slope = slope, short_wave = wave, seed = seed,
        material = body },
      upper = lab.rigid, boundary = boundary, effects = { elasticity = "half_space" } }:press{ pressure = share * slope }
    return pressed[cells]
  end
  for _, quantity in ipairs(quantities) do
    local truth = press(256)[quantity]
    local b = lab.budget{ ask = function(x) return press(x.cells)[quantity] end, cells = { 32, 64 } }
    if b.low <= truth and truth <= b.high then held = held + 1 end
    widths[#widths + 1], errors[#errors + 1] = (b.high - b.low) / 2 / truth, math.abs(b.value / truth - 1)
  end
end
table.sort(widths)
table.sort(errors)
assert(held >= 87, "held " .. held)
assert(widths[48] < 8 * errors[48], "too wide") -- 4.7 times over 480 contacts
print "held, and not too wide"

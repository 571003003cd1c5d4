-- SPDX-License-Identifier: GPL-3.0-or-later
-- Thousands of small presses in an ensemble: a surface per seed on 256 x 256 cells, tolerance 1e-2, elastic
-- or capped at its hardness. Options: cases, capped (how many, first, reach the hardness), cells.
-- bench/ensemble_presses.cpp compares with a C++ loop.
--
--   asperity run bench/ensemble_presses.lua --threads 2 -- cases=16000
local lab = require "asperity"
local arguments = require "asperity.arguments"
local options = arguments({ cases = 1000, cells = 256, capped = 0 }, ...)

local material = lab.material{ young = 1e9, poisson = 0, hardness = 5e7 }
local seeds = {}
for k = 1, options.cases do seeds[k] = k end
local cells, capped = options.cells, options.capped
local rows = lab.ensemble{ over = { seed = seeds }, run = function(case)
  local surface = lab.surface.self_affine{ cells = cells, size = 1, hurst = 0.8, rms_slope = 0.1, roll_off = 0.5,
    short_wave = 1 / 32, seed = case.seed, material = material }
  local effects = { elasticity = "half_space", plasticity = case.seed <= capped and {} or nil }
  local contact = lab.contact{ lower = surface, upper = lab.rigid, boundary = "periodic", effects = effects,
    accuracy = { tolerance = 1e-2 } }
  local st = contact:press{ pressure = 5e6 }
  return { area = st.corrected_area_fraction, approach = st.approach }
end }
local area, approach = 0, 0
for _, row in ipairs(rows) do area, approach = area + row.area, approach + row.approach end
print(("%d presses, area fraction %.17g, approach %.17g"):format(#rows, area / #rows, approach / #rows))

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Cases of an ensemble over ranks: eight presses of one to two seconds. Wall time:
--
--   time mpirun --bind-to none -n 2 asperity run bench/ensemble_cases.lua --threads 1 --store-limit 0 --out run
local lab = require "asperity"
local al = lab.material{ young = "70 GPa", poisson = 0.33 }
local rows = lab.ensemble{ over = { seed = { 1, 2, 3, 4, 5, 6, 7, 8 } }, run = function(case)
  local s = lab.surface.self_affine{ cells = 1536, size = "1 mm", hurst = 0.8, rms_slope = 0.1, short_wave = 16e-3 / 1536,
    seed = case.seed, material = al }
  local c <close> = lab.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
    effects = { elasticity = "half_space" } }
  return { area = c:press{ pressure = "100 MPa" }.area_fraction }
end }
for _, row in ipairs(rows) do print(row.seed, row.area) end

-- SPDX-License-Identifier: GPL-3.0-or-later
-- One contact over MPI ranks: time and peak memory per rank. whole=1: lab.contact in one process.
--
--   mpirun --bind-to none -n 2 asperity run bench/spread.lua --threads 1 --store-limit 0 --out run -- cells=2048
--   asperity run bench/spread.lua --threads 1 --store-limit 0 --out run -- cells=2048 whole=1
local lab = require "asperity"
local options = require "asperity.arguments"({ cells = 2048, whole = 0 }, ...)
local cells, whole = options.cells, options.whole == 1

local keys = { cells = cells, size = "1 mm", hurst = 0.8, rms_slope = 0.1, short_wave = 16e-3 / cells, seed = 1,
  material = lab.material{ young = "70 GPa", poisson = 0.33 } }
local effects = { elasticity = "half_space" }
local pressure = 0.05 * 0.1 * 70e9 / (1 - 0.33 ^ 2)
local bench = whole and { lab.surface.self_affine, lab.contact } or
  { lab.spread.self_affine, lab.spread.contact }
local s = bench[1](keys)
local st = bench[2]{ lower = s, upper = lab.rigid, boundary = "periodic", effects = effects }:press{
  pressure = pressure }
print(("%d cells a side, %s: %.1f s, %.1f transform pairs, %.1f MB a rank; area fraction %.9g, approach %.9g m, %s")
  :format(cells, whole and "one process" or s.ranks .. (s.ranks == 1 and " rank" or " ranks"),
    st.cost.seconds, st.cost.transforms / 2, st.cost.bytes / 1e6, st.area_fraction, st.approach, st.solver))

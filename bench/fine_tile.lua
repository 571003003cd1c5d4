-- SPDX-License-Identifier: GPL-3.0-or-later
-- The largest event: a tile of 2 mm at a stylus spacing of 0.25 um, 8192 x 8192 cells, pressed at 152.78 MPa.
-- Needs about 20 GiB.
--
--   asperity run bench/fine_tile.lua --limit-memory 24G
--   asperity run bench/fine_tile.lua -- cells=2048
local lab = require "asperity"
local options = require "asperity.arguments"({ cells = 8192 }, ...)

local function specimen(seed)
  return lab.surface.self_affine{
    cells = options.cells, size = "2 mm", hurst = 0.8, roll_off = "250 um", short_wave = "4 um", ra = "3 um",
    seed = seed, material = lab.material "Al-2011",
  }
end
local c = lab.contact{
  lower = specimen(1), upper = specimen(2), boundary = "periodic",
  effects = { elasticity = "half_space", plasticity = {} },
}
print(c:explain())
local st = c:press{ pressure = "152.78 MPa" }
print(st)
print(("%d cells: %.0f s, %.0f pairs of transforms, %.1f GiB above the surfaces at the peak"):format(
  options.cells, st.cost.seconds, st.cost.transforms / 2, st.cost.bytes / 2 ^ 30))

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Registration of a worn map of 1024 x 1024 cells, for turns up to 5 degrees and over the full circle:
-- processor seconds over all threads, their limit, and the result.
--
--   asperity run bench/registration.lua
--   asperity run bench/registration.lua -- cells=2048
local lab = require "asperity"
local options = require "asperity.arguments"({ cells = 1024 }, ...)

local before = lab.surface.self_affine{
  cells = options.cells, size = "1 mm", hurst = 0.8, rms_height = "1 um", roll_off = "100 um", short_wave = "5 um",
}
local after = before:cut{ fraction = 0.4 }:rotated "3 deg"
for _, search in ipairs{ { "5 deg", 5 }, { "360 deg", 10 } } do
  local angle, most = table.unpack(search)
  local start = os.clock()
  local found = after:registered_to(before, { angle = angle })
  print(("turns up to %s: %.1f s (%d s on 1024 x 1024 cells); turned by %.4f deg, shift %.4f and %.4f um, overlap %.2f"):format(
    angle, os.clock() - start, most, found.angle / lab.units.deg, found.shift.x / lab.units.um, found.shift.y / lab.units.um,
    found.overlap))
end

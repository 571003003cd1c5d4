-- SPDX-License-Identifier: GPL-3.0-or-later
-- The parameters and filters of a map of 2048 x 2048 cells: what each group takes when it is first read. Seconds are of the
-- processor, over all threads.
--
--   asperity run bench/areal_parameters.lua
--   asperity run bench/areal_parameters.lua -- cells=1024
local lab = require "asperity"
local options = require "asperity.arguments"({ cells = 2048 }, ...)

local map = lab.surface.self_affine{
  cells = options.cells, size = "1 mm", hurst = 0.8, rms_height = "1 um", long_wave = "0.25 mm", short_wave = "5 um", seed = 3,
}
local rims = map:cropped{ cells = options.cells - 1 } -- not periodic
local function read(...)
  local names = { ... }
  return function()
    local p = map:areal_parameters()
    for _, name in ipairs(names) do assert(p[name]) end
  end
end
for _, line in ipairs{
  { "heights, slopes and material ratio", read("Sq", "Sdr", "Sk", "Vmp") },
  { "autocorrelation: Sal and Str", read("Sal", "Str") },
  { "hills", read "S10z" },
  { "direction", read "Std" },
  { "an S-filter", function() map:filtered{ short_wave = "10 um" } end },
  { "an L-filter with rims", function() rims:filtered{ long_wave = "50 um" } end },
  { "the same, robust", function() rims:filtered{ long_wave = "50 um", robust = true } end },
} do
  local start = os.clock()
  line[2]()
  print(("%-36s %.2f s"):format(line[1], os.clock() - start))
end

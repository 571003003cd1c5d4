-- SPDX-License-Identifier: GPL-3.0-or-later
-- Times of parameter groups and filters of a map of 2048 x 2048 cells, and limits on two threads. Processor
-- seconds over all threads, a lower bound of wall time times threads. White noise has the most hills.
--
--   asperity run bench/areal_parameters.lua --threads 2
--   asperity run bench/areal_parameters.lua --threads 2 -- cells=1024
local lab = require "asperity"
local options = require "asperity.arguments"({ cells = 2048 }, ...)

local map = lab.surface.self_affine{
  cells = options.cells, size = "1 mm", hurst = 0.8, rms_height = "1 um", long_wave = "0.25 mm", short_wave = "5 um", seed = 3,
}
local noise = lab.surface.self_affine{
  cells = options.cells, size = "1 mm", hurst = 0.1, rms_height = "1 um", short_wave = 2.1e-3 / options.cells, seed = 3,
}
local rims = map:cropped{ cells = options.cells - 1 } -- not periodic
local holed = rims:masked{ mask = function(x, y) return (x // 40e-6 + y // 40e-6) % 11 == 0 end }
local function read(of, ...)
  local names = { ... }
  return function()
    local p = of:areal_parameters()
    for _, name in ipairs(names) do assert(p[name]) end
  end
end
for _, line in ipairs{
  { "heights, slopes and material ratio", 0.5, read(map, "Sq", "Sdr", "Sk", "Vmp") },
  { "the same of white noise", 0.5, read(noise, "Sq", "Sdr", "Sk", "Vmp") },
  { "autocorrelation: Sal and Str", 1.5, read(map, "Sal", "Str") },
  { "hills", 2, read(map, "S10z") },
  { "hills of white noise", 2, read(noise, "S10z") },
  { "direction", 0.5, read(map, "Std") },
  { "an S-filter", 0.5, function() map:filtered{ short_wave = "10 um" } end },
  { "an L-filter with rims", 0.5, function() rims:filtered{ long_wave = "50 um" } end },
  { "the same with holes", 0.5, function() holed:filtered{ long_wave = "50 um" } end },
  { "robust, with rims", 3, function() rims:filtered{ long_wave = "50 um", robust = true } end },
  { "robust, with holes", 3, function() holed:filtered{ long_wave = "50 um", robust = true } end },
} do
  local start = os.clock()
  line[3]()
  print(("%-36s %.2f s of the processor; may take %.1f s on two threads"):format(line[1], os.clock() - start, line[2]))
end

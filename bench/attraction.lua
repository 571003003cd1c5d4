-- SPDX-License-Identifier: GPL-3.0-or-later
-- Transforms of adhesive presses and of the same pressure without adhesion: 60 contacts of 64 x 64 cells,
-- random work and range, half spheres on a free boundary, half rough periodic tiles, by approach and by
-- pressure. Refused presses are counted separately.
--
--   asperity run bench/attraction.lua --threads 1
--   asperity run bench/attraction.lua --threads 1 -- scenes=240 seed=2
local lab = require "asperity"
local options = require "asperity.arguments"({ scenes = 60, cells = 64, seed = 1, tolerance = 1e-6 }, ...)

local body = lab.material{ young = 1, poisson = 0 }
local rows = lab.ensemble{
  over = { scene = (function() local list = {} for k = 1, options.scenes do list[k] = k end return list end)() },
  run = function(case)
    local state = (case.scene + 1000 * options.seed) * 7919 % 2147483647
    local function random(low, high) -- uniform in the logarithm
      state = state * 16807 % 2147483647
      return low * (high / low) ^ (state / 2147483647)
    end
    for _ = 1, 8 do random(1, 2) end
    local ball = case.scene % 2 == 0
    local face = ball and lab.surface.sphere{ cells = options.cells, size = 1, radius = random(0.5, 4), shape = "paraboloid", material = body } or
      lab.surface.self_affine{ cells = options.cells, size = 1, hurst = 0.8, rms_slope = random(0.03, 0.3), short_wave = 8 / options.cells,
                               roll_off = 0.5, seed = case.scene, material = body }
    -- Range relative to rms height; work relative to range times E*.
    local height = face:roughness().Rq
    local range = height * random(0.1, 1)
    local work = range * random(0.003, 0.3)
    local approach, pressure = height * random(0.03, 0.5), random(0.001, 0.02)
    local found = { ball = ball and 1 or 0, refused = 0 }
    local function count(name, attracted, asked)
      local effects = { elasticity = "half_space", adhesion = attracted and { work = work, range = range } or nil }
      local c <close> = lab.contact{ lower = face, upper = lab.rigid, boundary = ball and "free" or "periodic", effects = effects,
                                     accuracy = { tolerance = options.tolerance } }
      local ok, st = pcall(c.press, c, asked)
      if ok then found[name] = st.cost.transforms else found.refused = found.refused + 1 end
    end
    count("by approach", true, { approach = approach })
    count("by pressure", true, { pressure = pressure })
    count("without attraction", false, { pressure = pressure })
    return found
  end,
}
local refused, counts = 0, lab.notebook "transforms"
for _, row in ipairs(rows) do
  refused = refused + row.refused
  counts:write{ scene = row.scene, ball = row.ball, by_approach = row["by approach"], by_pressure = row["by pressure"],
                without = row["without attraction"] }
end
for _, name in ipairs{ "by approach", "by pressure", "without attraction" } do
  local sorted = {}
  for _, row in ipairs(rows) do sorted[#sorted + 1] = row[name] end
  table.sort(sorted)
  print(("%-20s %5.0f to %5.0f transforms, %4.0f in the middle of %d"):format(name, sorted[1] or 0, sorted[#sorted] or 0,
    sorted[(#sorted + 1) // 2] or 0, #sorted))
end
print(("refused: %d of %d presses"):format(refused, 3 * options.scenes))

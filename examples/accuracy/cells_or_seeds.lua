-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does the answer of a rough contact cost to 10, 3, 1 and 0.3 per cent, and which error
-- decides?
--
--   asperity run examples/accuracy/cells_or_seeds.lua -- faces=12
--
-- Found: for one face the cells decide. For the recipe the seeds decide: time belongs to faces, on
-- the coarsest grid whose error in the mean is below their scatter.
local lab = require "asperity"

local options = require "asperity.arguments"({ budget = 30, faces = 12, finest = 512 }, ...)
local slope, unit, tight = 0.1, lab.material{ young = 1, poisson = 0 }, 1e-8
local grids = { 64, 96, 128, 192, 256, 384 }
local quantities = { "corrected_area_fraction", "area_fraction", "approach", "energy", "mean_gap" }

local function answers(case)
  local face = lab.surface.self_affine{ cells = case.cells, size = 1, hurst = 0.8,
    rms_slope = slope, short_wave = 1 / 32, seed = case.seed, material = unit }
  return lab.contact{ lower = face, upper = lab.rigid, boundary = "periodic",
    effects = { elasticity = "half_space" }, accuracy = { tolerance = case.tolerance },
  }:sweep{ pressure = { 0.05 * slope } }:table(quantities)[1]
end

-- 1. Seconds of a run, the fastest of 15, and the results of the same faces in every setting.
local timed = lab.work_precision{ ask = function(knobs) return answers(knobs).approach end,
  truth = { cells = options.finest, tolerance = tight }, repeats = 15, at_most = options.budget,
  try = { { name = "tolerance 1e-2", cells = grids, tolerance = 1e-2 },
    { name = "tolerance 1e-4", cells = grids, tolerance = 1e-4 } } }:rows()
local seeds = {}
for seed = 1, options.faces do seeds[seed] = seed end
local runs = lab.ensemble{ run = answers, over = { seed = seeds, tolerance = { tight, 1e-2, 1e-4 },
  cells = { options.finest, table.unpack(grids) } } }
local function at(cells, tolerance) return runs:where{ cells = cells, tolerance = tolerance } end
local exact = at(options.finest, tight)

-- The error that 95 % of the faces do not exceed.
local function error_95(found, truth, y)
  local errors = {}
  for k, row in ipairs(found) do errors[k] = math.abs(row[y] / truth[k][y] - 1) end
  table.sort(errors)
  return errors[math.ceil(0.95 * #errors)]
end

-- 2. The errors of every setting, from fine to coarse. The error of a setting counts as the
--    largest among this grid and all finer grids at its tolerance: luck on one grid does not count.
local settings = {}
for _, y in ipairs(quantities) do
  local list, held_one, held_all, mean = {}, {}, {}, exact:mean(y)[1]
  for k = #timed, 1, -1 do
    local cells, tolerance = timed[k].cells, timed[k].tolerance
    if timed[k].seconds_low then -- on a slow machine the budget skips settings
      local found, tightly = at(cells, tolerance), at(cells, tight)
      local one, all = error_95(found, exact, y), math.abs(found:sum(y) / exact:sum(y) - 1)
      held_one[tolerance] = math.max(one, held_one[tolerance] or 0)
      held_all[tolerance] = math.max(all, held_all[tolerance] or 0)
      list[#list + 1] = { cells = cells, tolerance = tolerance, fastest = timed[k].seconds_low,
        median = timed[k].seconds, scatter = mean.sd / mean.mean, one = one, all = all,
        held_one = held_one[tolerance], held_all = held_all[tolerance],
        of_cells = error_95(tightly, exact, y), of_solver = error_95(found, tightly, y) }
    end
  end
  settings[y] = lab.table.from(list)
end

-- 3. The cheapest setting for each accuracy. "For 3 %" means: 95 of 100 draws are within 3 %. For
--    one face, 95 % of the faces have a smaller error. The recipe needs n faces: 1.96 times their
--    scatter over the root of n, plus the error of the mean over all faces, is at most 3 %.
--    A setting is tied if its fastest run is below the median of the cheapest setting.
local function faces_for(s, bound, way)
  if way == "one face" then return s.held_one <= bound and 1 or math.huge end
  local left = bound - s.held_all
  return left > 0 and math.ceil((1.96 * s.scatter / left) ^ 2) or math.huge
end
local function cheapest(y, bound, way)
  local plans = settings[y]:with{ faces = function(s) return faces_for(s, bound, way) end }
    :with{ seconds = function(s) return s.faces * s.fastest end }:sorted{ by = "seconds" }
  local best = plans[1]
  best.tied = -1
  for plan in plans:each() do
    if plan.seconds <= best.faces * best.median then best.tied = best.tied + 1 end
  end
  return best.faces < math.huge and best or {}
end

local costs = lab.notebook "costs"
for _, y in ipairs(quantities) do
  for _, bound in ipairs{ 0.1, 0.03, 0.01, 0.003 } do
    for _, way in ipairs{ "one face", "the recipe" } do
      local best, better = cheapest(y, bound, way), cheapest(y, bound / 2, way)
      best.quantity, best.bound, best.of, best.decides = y, bound, way, "cells"
      if best.faces then
        best.half = better.faces and better.seconds / best.seconds
        local cells, seeds = best.of_cells, 0
        if way == "the recipe" then
          cells, seeds = best.all, 1.96 * best.scatter / math.sqrt(best.faces)
        end
        best.error = math.max(seeds, cells, best.of_solver)
        best.decides = best.error == seeds and "seeds" or best.error == cells and "cells"
          or "solver"
      end
      costs:write(best)
    end
  end
end
print "Error of 95 in 100 draws of the corrected area, and the cost of half the error:"
costs:where{ quantity = quantities[1], bound = { 0.1, 0.03, 0.01 } }:show{ "bound [%]", "of",
  "faces", "cells", "tolerance", "seconds", "half", digits = 3 }
print "\nThe deciding error of each quantity, and the scatter of one face:"
costs:show{ "quantity", "bound [%]", "of", "faces", "cells", "tolerance", "tied", "seconds",
  "decides", "error [%]", "scatter [%]", digits = 3 }

-- 4. Error against seconds with the scatter of the faces as a band, and the best use of a time.
local mean = exact:sum "approach" / #exact
local off = exact:with{ off = function(row) return math.abs(row.approach / mean - 1) end }
  :sorted{ by = "off" }:column "off"
local low, high = off[math.floor(0.16 * #off + 0.5)], off[math.floor(0.84 * #off + 0.5)]
local function expected(s, n) return math.sqrt(s.scatter ^ 2 / n + s.all ^ 2) end
local times = { 0.01, 0.03, 0.1, 0.3, 1 }
local errors, fixed, uses = lab.notebook "errors", lab.notebook "fixed", lab.notebook "uses"
for s in settings.approach:where{ tolerance = 1e-4 }:each() do
  errors:write{ what = "one face, for itself", seconds = s.fastest, error = s.one }
  errors:write{ what = "one face, for its kind (band: 68 % of faces)", seconds = s.fastest,
    error = math.sqrt(s.scatter ^ 2 + s.one ^ 2), low = low, high = high }
  for _, n in ipairs{ 16, 256 } do
    errors:write{ what = n .. " faces, for their kind", seconds = n * s.fastest,
      error = expected(s, n) }
  end
  for _, time in ipairs(times) do
    local n = time // s.fastest
    if n >= 1 then
      fixed:write{ ["time [s]"] = time, cells = s.cells, faces = n, error = expected(s, n) }
    end
  end
end
errors:chart{ x = "seconds", y = "error", one_line_per = "what", interval = { "low", "high" },
  log_x = true, log_y = true, file = "cells_or_seeds.svg", y_label = "relative error",
  title = "What the approach of a rough contact costs" }
fixed:chart{ x = "cells", y = "error", one_line_per = "time", log_x = true, log_y = true,
  file = "fixed_budget.svg", title = "A fixed time, for cells or for faces",
  y_label = "expected relative error of the approach" }
for _, time in ipairs(times) do
  local best = fixed:where{ time = time }:sorted{ by = "error" }[1]
  if best then uses:write(best) end
end
print "\nThe best grid for the approach of the recipe, at a tolerance of 1e-4:"
uses:show{ "time [ms]", "cells", "faces", "error [%]", digits = 3 }

local finest = settings.approach[1]
local checks = lab.table.from{ { scatter = finest.scatter / finest.one,
  solver = finest.of_solver / finest.of_cells } }
checks:expect("scatter", { at_least = 5,
  label = "the seeds scatter more than 384² cells err, five times or more" })
checks:expect("solver", { at_most = 1, label = "a tolerance of 1e-4 errs less than 384² cells" })

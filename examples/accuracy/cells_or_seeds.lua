-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does the answer of a rough contact cost to 10, 3, 1 and 0.3 per cent, and which of its errors then decides?
--
--   asperity run examples/accuracy/cells_or_seeds.lua
--   asperity run examples/accuracy/cells_or_seeds.lua -- budget=120 faces=64
--
-- The same faces are pressed on every grid, to three tolerances. Against each face on the finest grid, solved to 1e-8, a
-- setting has an error on one face (the root of the mean square) and an error in the mean over all faces, which is
-- smaller, for part of what cells do is chance. The faces scatter. So an answer for one face costs what its cells and its
-- solver cost, and an answer for the recipe costs that n times, with n such that the scatter over the root of n and the
-- error in the mean, as squares, stay within what is asked.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"
local arguments = require "asperity.arguments"

local options = arguments({ budget = 30, faces = 12, finest = 512 }, ...)
local slope, unit = 0.1, lab.material{ young = 1, poisson = 0 }
local quantities = {
  { "corrected_area_fraction", "area, edge corrected" }, { "area_fraction", "area, nodes counted" },
  { "approach", "approach" }, { "energy", "energy" }, { "mean_gap", "mean gap" },
}
local drawn = "approach"
local bounds = { 0.1, 0.03, 0.01, 0.003 }
local grids, tolerances, tight = { 64, 96, 128, 192, 256, 384 }, { 1e-2, 1e-4 }, 1e-8

local function answers(x)
  local face <close> = lab.surface.self_affine{
    cells = x.cells, size = 1, hurst = 0.8, rms_slope = slope, short_wave = 1 / 32, seed = x.seed or 1, material = unit,
  }
  local contact <close> = lab.contact{
    lower = face, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" },
    accuracy = { tolerance = x.tolerance },
  }
  local st, found = contact:press{ pressure = 0.05 * slope }, {}
  for _, quantity in ipairs(quantities) do found[quantity[1]] = st[quantity[1]] end
  return found
end

-- 1. What a run takes: the fastest of 15. Two settings are told apart if one's median is below the other's fastest.
local study = lab.work_precision{
  ask = function(knobs) return answers(knobs)[drawn] end, truth = { cells = options.finest, tolerance = tight },
  try = {
    { name = "tolerance 1e-2", cells = grids, tolerance = 1e-2 },
    { name = "tolerance 1e-4", cells = grids, tolerance = 1e-4 },
  },
  repeats = 15, at_most = options.budget,
}
local function name_of(cells, tolerance) return ("%d², %g"):format(cells, tolerance) end
local seconds = {}
for _, row in ipairs(study:rows()) do
  if row.seconds_low then -- a budget leaves settings out on a slow machine
    seconds[name_of(row.cells, row.tolerance)] = { fastest = row.seconds_low, median = row.seconds }
  end
end

-- 2. What the same faces answer in every setting.
local seeds = {}
for k = 1, options.faces do seeds[k] = k end
local faces = lab.ensemble{ over = { seed = seeds }, run = function(case)
  local found = { truth = answers{ cells = options.finest, tolerance = tight, seed = case.seed } }
  for _, cells in ipairs(grids) do
    for _, tolerance in ipairs{ tight, table.unpack(tolerances) } do
      found[name_of(cells, tolerance)] = answers{ cells = cells, tolerance = tolerance, seed = case.seed }
    end
  end
  return found
end }

local function root_mean_square(of)
  local sum = 0
  for _, face in ipairs(faces) do sum = sum + of(face) ^ 2 end
  return math.sqrt(sum / #faces)
end
local function mean(of)
  local sum = 0
  for _, face in ipairs(faces) do sum = sum + of(face) end
  return sum / #faces
end

-- 3. The errors of every setting.
local found = {}
for _, quantity in ipairs(quantities) do
  local y = quantity[1]
  local truth = mean(function(face) return face.truth[y] end)
  local scatter = math.sqrt(#faces / (#faces - 1)) * root_mean_square(function(face) return face.truth[y] / truth - 1 end)
  found[y] = { scatter = scatter, truth = truth, settings = {} }
  for _, tolerance in ipairs(tolerances) do
    for _, cells in ipairs(grids) do
      local name, exact = name_of(cells, tolerance), name_of(cells, tight)
      if seconds[name] then
        table.insert(found[y].settings, {
          name = name, cells = cells, tolerance = tolerance, seconds = seconds[name],
          one = root_mean_square(function(face) return face[name][y] / face.truth[y] - 1 end),
          of_cells = root_mean_square(function(face) return face[exact][y] / face.truth[y] - 1 end),
          of_solver = root_mean_square(function(face) return face[name][y] / face[exact][y] - 1 end),
          all = math.abs(mean(function(face) return face[name][y] end) / truth - 1),
        })
      end
    end
  end
end

-- 4. The cheapest way to each accuracy. An error counts as the largest of the setting's own and those of all finer grids
--    at its tolerance, so that luck on one grid is not taken.
local function held(settings, setting, key)
  local worst = setting[key]
  for _, other in ipairs(settings) do
    if other.tolerance == setting.tolerance and other.cells > setting.cells then worst = math.max(worst, other[key]) end
  end
  return worst
end
local function faces_for(of, setting, bound)
  local left = bound ^ 2 - held(of.settings, setting, "all") ^ 2
  return left > 0 and math.max(1, math.ceil(of.scatter ^ 2 / left)) or nil
end
local function cheapest(of, runs_of)
  local best, tied = nil, {}
  for _, setting in ipairs(of.settings) do
    local n = runs_of(setting)
    if n then
      local plan = { setting = setting, n = n, seconds = n * setting.seconds.fastest, high = n * setting.seconds.median }
      tied[#tied + 1] = plan
      if not best or plan.seconds < best.seconds then best = plan end
    end
  end
  if not best then return nil end
  local names = {}
  for _, plan in ipairs(tied) do
    if plan ~= best and plan.seconds <= best.high then names[#names + 1] = plan.setting.name end
  end
  best.tied = #names
  return best
end
local function time_text(s) return s < 1 and ("%.3g ms"):format(1000 * s) or ("%.3g s"):format(s) end
local function tie_text(best) return best.tied > 0 and (" (%d tied)"):format(best.tied) or "" end

local lines = {}
local function add(...) for _, line in ipairs{ ... } do lines[#lines + 1] = line end end
add("## All errors of a rough contact", "",
  ("A self-affine surface (Hurst exponent 0.8, rms slope 0.1, shortest wave 1/32 of the side) on a rigid flat at 0.05 E* "
    .. "times its slope: what does an answer cost, for one face and for the recipe that made it? The errors are those of %d "
    .. "faces, each against itself on %d² cells, solved to 1e-8; *decides* names the largest. Seconds are the fastest of 15 "
    .. "runs on all processors, times the number of faces.")
    :format(options.faces, options.finest), "",
  "| quantity | for | one face: cells², tolerance | seconds | decides | the recipe: faces on cells², tolerance | seconds | "
    .. "decides |",
  "| --- | ---: | --- | ---: | --- | --- | ---: | --- |")
for _, quantity in ipairs(quantities) do
  local of = found[quantity[1]]
  for _, bound in ipairs(bounds) do
    local one = cheapest(of, function(setting) return held(of.settings, setting, "one") <= bound and 1 or nil end)
    local all = cheapest(of, function(setting) return faces_for(of, setting, bound) end)
    local row = { quantity[2], ("%g %%"):format(100 * bound) }
    for _, best in ipairs{ one or false, all or false } do
      if not best then
        for _, text in ipairs{ "none of these", "", "cells" } do row[#row + 1] = text end
      else
        local s = best.setting
        local sampling = best == all and of.scatter / math.sqrt(best.n) or 0
        local cells = best == all and s.all or s.of_cells
        row[#row + 1] = (best == all and best.n .. " on " or "") .. s.name .. tie_text(best)
        row[#row + 1] = time_text(best.seconds)
        row[#row + 1] = sampling >= math.max(cells, s.of_solver) and ("seeds, %.2g %%"):format(100 * sampling)
          or cells >= s.of_solver and ("cells, %.2g %%"):format(100 * cells) or ("solver, %.2g %%"):format(100 * s.of_solver)
      end
    end
    add("| " .. table.concat(row, " | ") .. " |")
  end
end
local scatters = {}
for k, quantity in ipairs(quantities) do
  scatters[k] = ("%s %.2g %%"):format(quantity[2], 100 * found[quantity[1]].scatter)
end
add("", ("One face scatters about the mean of its kind: %s. (n tied): so many other settings reach the same, and their "
    .. "fastest runs are below the median of the one named. A setting counts with its error or that of a finer grid at its "
    .. "tolerance, whichever is larger.")
  :format(table.concat(scatters, "; ")), "", "![Error against seconds](pictures/accuracy/cells_or_seeds.svg)", "")

-- 5. Error against seconds, with the scatter of the faces as a band, and what a fixed time is best spent on.
local of, chart, fixed = found[drawn], lab.notebook "errors", lab.notebook "fixed"
local off = {}
for k, face in ipairs(faces) do off[k] = math.abs(face.truth[drawn] / of.truth - 1) end
table.sort(off)
local low, high = off[math.max(1, math.floor(0.16 * #off + 0.5))], off[math.max(1, math.floor(0.84 * #off + 0.5))]
local best_for = {}
local budgets = { 0.01, 0.03, 0.1, 0.3, 1 }
for _, setting in ipairs(of.settings) do
  if setting.tolerance == 1e-4 then
    local t = setting.seconds.fastest
    chart:write{ what = "one face, for itself", seconds = t, error = setting.one, low = setting.one, high = setting.one }
    chart:write{ what = "one face, for its kind (band: 68 % of faces)", seconds = t,
                 error = math.sqrt(of.scatter ^ 2 + setting.one ^ 2), low = low, high = high }
    for _, n in ipairs{ 16, 256 } do
      local error = math.sqrt(of.scatter ^ 2 / n + setting.all ^ 2)
      chart:write{ what = n .. " faces, for their kind", seconds = n * t, error = error, low = error, high = error }
    end
    for _, budget in ipairs(budgets) do
      local n = budget // t
      if n >= 1 then
        local row = { time = "in " .. time_text(budget), cells = setting.cells, faces = n,
                      error = math.sqrt(of.scatter ^ 2 / n + setting.all ^ 2) }
        fixed:write(row)
        if not best_for[budget] or row.error < best_for[budget].error then best_for[budget] = row end
      end
    end
  end
end
chart:chart{ x = "seconds", y = "error", one_line_per = "what", interval = { "low", "high" }, log_x = true, log_y = true,
             file = "cells_or_seeds.svg", title = "What the approach of a rough contact costs", y_label = "relative error" }
fixed:chart{ x = "cells", y = "error", one_line_per = "time", log_x = true, log_y = true, file = "fixed_budget.svg",
             title = "A fixed time, for cells or for faces", y_label = "expected relative error of the approach" }

add("### Cells or seeds, at a fixed time", "",
  "The approach for the recipe, at a tolerance of 1e-4: as many faces as the time allows on each grid, and the best of the "
    .. "grids.", "",
  "| time | cells² | faces | expected error |", "| ---: | ---: | ---: | ---: |")
for _, budget in ipairs(budgets) do
  local best = best_for[budget]
  if best then
    add(("| %s | %d² | %d | %.2g %% |"):format(time_text(budget), best.cells, best.faces, 100 * best.error))
  end
end
add("", "![Expected error against cells](pictures/accuracy/fixed_budget.svg)", "",
  "For one face the cells decide. For the recipe the seeds decide: time belongs to faces, on the coarsest grid whose error "
    .. "in the mean stays below their scatter.")
accuracy.write(0, lines)
print(table.concat(lines, "\n"))

local checks = lab.notebook "checks"
local finest = found.approach.settings[#found.approach.settings]
checks:write{ scatter = found.approach.scatter / finest.one, solver = finest.of_solver / finest.of_cells }
checks:expect("scatter", { at_least = 5, label = "the seeds scatter more than 384² cells err, five times or more" })
checks:expect("solver", { at_most = 1, label = "a tolerance of 1e-4 errs less than 384² cells" })

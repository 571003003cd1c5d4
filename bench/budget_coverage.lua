-- SPDX-License-Identifier: GPL-3.0-or-later
-- Coverage of lab.budget: the cells part of single rough contacts, and inputs of every kind.
--
--   asperity run bench/budget_coverage.lua --threads 2 -- contacts=480 sets=300
--
-- Contacts: one face each (H 0.5 to 0.9, slopes 0.05 to 0.2, shortest waves 1/16 to 1/5 of the tile, loads 1
-- to 20 % of the slope, free and periodic), no replicates, 32 and 64 cells; truth on four times as many cells
-- a side. Inputs: models with known answers; the interval must contain the answer at the true inputs.
local lab = require "asperity"
local arguments = require "asperity.arguments"
local options = arguments({ contacts = 480, sets = 300, seed = 1, finest = 64 }, ...)
local quantities = { "corrected_area_fraction", "approach", "energy", "mean_gap" }
local fine = options.finest
local random = lab.notebook("coverage", { columns = { "of", "held [%]", "sets" } })
local function median(list)
  table.sort(list)
  return list[#list // 2 + 1]
end
local function found(of, held, sets, more)
  random:write{ of = of, ["held [%]"] = 100 * held / sets, sets = sets }
  print(("%-52s %5.1f %% of %d%s"):format(of, 100 * held / sets, sets, more or ""))
end

-- 1. Cells.
math.randomseed(options.seed)
local function between(a, b) return a + (b - a) * math.random() end
local scenes, list, body = {}, {}, lab.material{ young = 1, poisson = 0 }
for k = 1, options.contacts do
  list[k] = k
  scenes[k] = { hurst = between(0.5, 0.9), slope = 0.05 * 4 ^ math.random(), wave = (1 / 16) * 3.2 ^ math.random() * 64 / fine,
    share = 0.01 * 20 ^ math.random(), boundary = math.random() < 0.5 and "periodic" or "free" }
end
local function press(k, cells)
  local of = scenes[k]
  local face = lab.surface.self_affine{ cells = cells, size = 1, hurst = of.hurst, rms_slope = of.slope, short_wave = of.wave,
    seed = k, material = body }
  local pair = lab.contact{ lower = face, upper = lab.rigid, boundary = of.boundary, effects = { elasticity = "half_space" } }
  return pair:press{ pressure = of.share * of.slope }
end
local function key(quantity, cells) return quantity .. " on " .. math.tointeger(cells) end
local rows = {}
if options.contacts > 0 then
  rows = lab.ensemble{ over = { k = list }, run = function(case)
    local row = {}
    for _, cells in ipairs{ fine // 2, fine * 5 // 8, fine * 3 // 4, fine, 4 * fine } do
      local st = press(case.k, cells)
      for _, quantity in ipairs(quantities) do row[key(quantity, cells)] = st[quantity] end
    end
    return row
  end }
end
local all, widths, errors = 0, {}, {}
for _, quantity in ipairs(quantities) do
  local held, wide, wrong = 0, {}, {}
  for _, row in ipairs(rows) do
    local truth = row[key(quantity, 4 * fine)]
    local b = lab.budget{ ask = function(x) return row[key(quantity, x.cells)] end, cells = { fine // 2, fine } }
    if b.low <= truth and truth <= b.high then held = held + 1 end
    wide[#wide + 1], wrong[#wrong + 1] = (b.high - b.low) / 2 / truth, math.abs(b.value / truth - 1)
  end
  for k = 1, #wide do widths[#widths + 1], errors[#errors + 1] = wide[k], wrong[k] end
  all = all + held
  if #rows > 0 then
    found("cells: " .. quantity, held, #rows, (", median half-width %.2g %%, median error %.2g %%"):format(100 * median(wide),
      100 * median(wrong)))
  end
end
if #rows > 0 then
  local times = median(widths) / median(errors)
  found("cells: all", all, 4 * #rows, (", median half-width %.1f times the median error"):format(times))
  lab.notebook("cells"):write{ held = all / 4 / #rows, times = times }
end

-- 2. Inputs.
local function normal() return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random()) end
local function holds(of, trial)
  local held, sets = 0, options.sets
  for k = 1, sets do
    local keys, truth = trial(k)
    local b = lab.budget(keys)
    if b.low <= truth and truth <= b.high then held = held + 1 end
  end
  found(of, held, sets)
end
local function first(x) return x.a end
local function sum(x) return x.a + x.b end
local function readings(n)
  local values, mean, squares = {}, 0, 0
  for k = 1, n do values[k] = normal() mean = mean + values[k] / n end
  for k = 1, n do squares = squares + (values[k] - mean) ^ 2 end
  return mean, math.sqrt(squares / (n - 1) / n)
end
holds("normal", function() return { ask = first, inputs = { a = { value = normal(), u = 1 } } }, 0 end)
for _, n in ipairs{ 3, 5, 10 } do
  holds("mean of " .. n .. " readings, degrees = " .. n - 1, function()
    local mean, u = readings(n)
    return { ask = first, inputs = { a = { value = mean, u = u, degrees = n - 1 } } }, 0
  end)
end
holds("two means of 3 readings, a product", function()
  local a, ua = readings(3)
  local b, ub = readings(3)
  return { ask = function(x) return (10 + x.a) * (10 + x.b) end,
    inputs = { a = { value = a, u = ua, degrees = 2 }, b = { value = b, u = ub, degrees = 2 } } }, 100
end)
holds("uniform", function()
  return { ask = first, inputs = { a = { value = math.sqrt(3) * (2 * math.random() - 1), u = 1, shape = "uniform" } } }, 0
end)
holds("triangular", function()
  return { ask = first, inputs = { a = { value = math.sqrt(6) * (math.random() - math.random()), u = 1, shape = "triangular" } } }, 0
end)
holds("lognormal, u = 40 %", function()
  local s = math.sqrt(math.log(1.16))
  return { ask = first, inputs = { a = { value = 1, u = 0.4, shape = "lognormal" } } }, math.exp(s * normal() - s * s / 2)
end)
holds("1/a, a lognormal, u = 40 %", function()
  local s = math.sqrt(math.log(1.16))
  return { ask = function(x) return 1 / x.a end, inputs = { a = { value = 1, u = 0.4, shape = "lognormal" } } },
    1 / math.exp(s * normal() - s * s / 2)
end)
local draws = {}
for k = 1, 400 do draws[k] = -math.log(1 - (k - 0.5) / 400) end
holds("own sample, exponential", function()
  return { ask = first, inputs = { a = { sample = draws } } }, -math.log(1 - math.random())
end)
for _, r in ipairs{ 0.8, -0.8, -0.99 } do
  holds("two inputs of correlation " .. r .. ", sum", function()
    local a, b = normal(), normal()
    return { ask = sum, inputs = { a = { value = a, u = 1 }, b = { value = r * a + math.sqrt(1 - r * r) * b, u = 1 } },
      correlation = { { "a", "b", r } } }, 0
  end)
end
holds("a calibration of 6 rows, its line beyond them", function()
  local measured = {}
  for k = 1, 6 do measured[k] = { x = k, y = 2 + 0.5 * k + 0.1 * normal() } end
  local line = lab.calibrate{ data = lab.table.from(measured), y = "y", parameters = { p = 1, q = 1 },
    model = function(q, row) return q.p + q.q * row.x end }
  return { ask = function(x) return x.p + 8 * x.q end, inputs = { line = line } }, 6
end)
holds("0 or 1", function()
  return { ask = function(x) return x.a > 0.5 and 1 or 0 end, inputs = { a = { value = 0, u = 1 } } }, normal() > 0.5 and 1 or 0
end)
holds("4 specimens of 4 repeats, as much between as within", function()
  local value, specimen, seed = {}, {}, {}
  for s = 1, 4 do
    local of = normal()
    for k = 1, 4 do value[#value + 1], specimen[#value + 1], seed[#seed + 1] = of + normal(), s, k end
  end
  return { ask = function(x) return value[4 * x.specimen - 4 + x.seed] end,
    replicate = { specimen = specimen, seed = seed } }, 0
end)
holds("6 faces, cells with a drift and chance", function()
  local at = {}
  for k = 1, 6 do
    local face, drift = normal(), 1 + 0.3 * normal()
    at[k] = { [32] = face + drift * 0.5 + normal(), [64] = face + drift * 0.2 + 0.5 * normal() }
  end
  return { ask = function(x) return at[x.seed][x.cells] end, cells = { 32, 64 }, replicate = { seed = { 1, 2, 3, 4, 5, 6 } } }, 0
end)
holds("one face, a drift of order 1 to 2 alone", function()
  local order = 1 + math.random()
  return { ask = function(x) return (32 / x.cells) ^ order end, cells = { 32, 64 } }, 0
end)

-- 3. Requirements.
if #rows > 0 then
  local cells = lab.notebook "cells"
  cells:expect("held", { at_least = 0.91 })
  cells:expect("times", { at_most = 6 })
end
random:expect("held [%]", { at_least = 90 })

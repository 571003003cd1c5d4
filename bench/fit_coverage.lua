-- SPDX-License-Identifier: GPL-3.0-or-later
-- Coverage of the 95 % intervals of table:fit and lab.calibrate, and their warnings; then intervals of
-- calibrations with a parameter pushed against its bound by noise.
--
--   asperity run bench/fit_coverage.lua
--   asperity run bench/fit_coverage.lua -- sets=100 seed=2
local lab = require "asperity"
local options = require "asperity.arguments"({ sets = 1000, seed = 1 }, ...)
local random, pi = math.random, math.pi
local function normal() return math.sqrt(-2 * math.log(1 - random())) * math.cos(2 * pi * random()) end
local function rows_of(count, make)
  local rows = {}
  for k = 1, count do rows[k] = make(k) end
  return rows
end
-- `between` and `within`: scatter of specimens and of repeats.
local function repeats(xs, count, between, within, truth)
  local rows = {}
  for s, x in ipairs(xs) do
    local own = between * normal()
    for _ = 1, count do rows[#rows + 1] = { specimen = "S" .. s, x = x, y = truth(x, own, within * normal()) } end
  end
  return rows
end
local function spread(n, ratio) return rows_of(n, function(k) return ratio ^ ((k - 1) / (n - 1) - .5) end) end
local function fit(keys)
  return function(rows)
    keys.x, keys.y = "x", "y"
    return lab.table.from(rows):fit(keys)
  end
end
local function line_of(q, row) return q.a + q.b * row.x end
local function calibrate(keys)
  return function(rows)
    keys.y, keys.data, keys.model = "y", lab.table.from(rows), keys.model or line_of
    keys.parameters = keys.parameters or { a = { start = .1 }, b = { start = .5 } }
    return lab.calibrate(keys)
  end
end
local function relative(x, own, error) return (.2 + .3 * x) * (1 + own) * (1 + error) end
local function absolute(x, own, error) return 1 + x + own + error end
local law = { a = .2, b = .3 }
local kinds = {
  { "fit: line, 8 points", fit{ model = "linear" }, { intercept = 1, slope = 1 },
    function() return rows_of(8, function(k) return { x = k, y = 1 + k + normal() } end) end },
  { "fit: line, 3 points", fit{ model = "linear" }, { intercept = 1, slope = 1 },
    function() return rows_of(3, function(k) return { x = k, y = 1 + k + normal() } end) end },
  { "fit: power law, absolute scatter", fit{ model = "power" }, { a = 2, b = .8 },
    function() return rows_of(10, function(k) return { x = k, y = 2 * k ^ .8 + .2 * normal() } end) end },
  { "fit: exponential decay", fit{ model = function(q, row) return q.a * math.exp(-q.k * row.x) end, start = { a = 1, k = .5 } }, { a = 2, k = .3 },
    function() return rows_of(12, function(k) return { x = k, y = 2 * math.exp(-.3 * k) + .03 * normal() } end) end },
  { "fit: line, relative 20 %, x 1..100", fit{ model = "linear", scatter = "relative" }, { intercept = 3, slope = 2 },
    function() return rows_of(10, function(k) local x = 100 ^ ((k - 1) / 9) return { x = x, y = (3 + 2 * x) * (1 + .2 * normal()) } end) end },
  { "fit: power law, relative 10 %, x 1..1000", fit{ model = "power", scatter = "relative" }, { a = 2, b = .8 },
    function() return rows_of(10, function(k) local x = 1000 ^ ((k - 1) / 9) return { x = x, y = 2 * x ^ .8 * math.exp(.1 * normal()) } end) end },
  { "fit: 4 specimens x 5, scatter alike", fit{ model = "linear", specimen = "specimen" }, { intercept = 1, slope = 1 },
    function() return repeats({ 1, 2, 3, 4 }, 5, .3, .3, absolute) end },
  { "fit: known u, 8 points", fit{ model = "linear", u = "u" }, { intercept = 1, slope = 1 },
    function() return rows_of(8, function(k) local u = .1 * k return { x = k, u = u, y = 1 + k + u * normal() } end) end },
  { "fit: known u, 3 points", fit{ model = "linear", u = .5 }, { intercept = 1, slope = 1 },
    function() return rows_of(3, function(k) return { x = k, y = 1 + k + .5 * normal() } end) end },
  { "calibrate: 2 groups x 7, repeats scatter", calibrate{ scatter = "relative", specimen = "specimen" }, law,
    function() return repeats({ .5, 2 }, 7, 0, .1, relative) end },
  { "calibrate: 4 specimens x 4, 10 % between", calibrate{ scatter = "relative", specimen = "specimen" }, law,
    function() return repeats(spread(4, 4), 4, .1, .1, relative) end },
  { "calibrate: 8 specimens x 3, 10 % between", calibrate{ scatter = "relative", specimen = "specimen" }, law,
    function() return repeats(spread(8, 4), 3, .1, .1, relative) end },
  { "calibrate: 8 specimens x 3, 5 % between", calibrate{ scatter = "relative", specimen = "specimen" }, law,
    function() return repeats(spread(8, 4), 3, .05, .1, relative) end },
  { "calibrate: 2 groups x 3 specimens x 5", calibrate{ scatter = "relative", specimen = "specimen" }, law,
    function() return repeats({ .5, .5, .5, 2, 2, 2 }, 5, .1, .1, relative) end },
  { "calibrate: Michaelis-Menten", calibrate{ parameters = { a = { start = .8 }, b = { start = 2 } },
      model = function(q, row) return q.a * row.x / (q.b + row.x) end }, { a = 1, b = 3 },
    function() return rows_of(10, function(k) return { x = k, y = k / (3 + k) + .02 * normal() } end) end },
  { "calibrate: known u, 2 rows", calibrate{ u = .05 }, law,
    function() return rows_of(2, function(k) return { x = k, y = .2 + .3 * k + .05 * normal() } end) end },
  { "not met: line through a parabola", fit{ model = "linear" }, { intercept = 0, slope = 1 },
    function() return rows_of(12, function(k) local x = k / 12 return { x = x, y = x + 2 * (x - .5) ^ 2 + .05 * normal() } end) end },
  { "not met: errors of correlation .8", fit{ model = "linear" }, { intercept = 1, slope = 1 },
    function() local e = normal() return rows_of(20, function(k) e = .8 * e + .6 * normal() return { x = k, y = 1 + k + e } end) end },
  { "not met: 6 rows, each four times", fit{ model = "linear" }, { intercept = 1, slope = 1 },
    function()
      local rows = rows_of(6, function(k) return { x = k, y = 1 + k + .2 * normal() } end)
      for k = 7, 24 do rows[k] = rows[(k - 1) % 6 + 1] end
      return rows
    end },
  { "not met: u four times too large", fit{ model = "linear", u = 1 }, { intercept = 1, slope = 1 },
    function() return rows_of(10, function(k) return { x = k, y = 1 + k + .25 * normal() } end) end },
}
local function holds(low, high, truth) return low and high and low <= truth and truth <= high end
print(("%-44s %-34s %s"):format("95 % intervals, " .. options.sets .. " sets of each kind", "held", "warned"))
for place, kind in ipairs(kinds) do
  math.randomseed(options.seed, place)
  local name, run, truth, make = table.unpack(kind)
  local held, warned, refused = {}, 0, 0
  for _ = 1, options.sets do
    local ok, found = pcall(run, make())
    if not ok then refused = refused + 1
    else
      if #found.warnings > 0 then warned = warned + 1 end
      for parameter, value in pairs(truth) do
        local of = found.parameters[parameter]
        held[parameter] = (held[parameter] or 0) + (holds(of.low, of.high, value) and 1 or 0)
      end
    end
  end
  local names, shares = {}, {}
  for parameter in pairs(truth) do names[#names + 1] = parameter end
  table.sort(names)
  for _, parameter in ipairs(names) do
    shares[#shares + 1] = ("%s %.1f %%"):format(parameter, 100 * (held[parameter] or 0) / (options.sets - refused))
  end
  print(("%-44s %-34s %.1f %%%s"):format(name, table.concat(shares, ", "), 100 * warned / options.sets,
    refused > 0 and ", refused " .. refused or ""))
end

-- Fourteen angles of two specimens with similar real areas: little beyond alpha + tau0 is determined.
local truth = { tau0 = .2, alpha = .25 }
print "\n15 calibrations of each difference of c, tau0 with lower=0, alpha free or with lower=0"
for _, lower in ipairs{ -math.huge, 0 } do
  for _, ratio in ipairs{ 1.01, 1.05, 1.1, 1.3 } do
    math.randomseed(4 + options.seed)
    local at_bound, printed, wrong, combinations = 0, 0, 0, 0
    for _ = 1, 15 do
      local rows = repeats({ 1, ratio }, 7, 0, .1, function(c, _, error) return math.atan((.25 + .2 * c) * (1 + error)) end)
      local found = lab.calibrate{ data = lab.table.from(rows), y = "y", specimen = "specimen", scatter = "relative",
        parameters = { tau0 = { start = .3, lower = 0 }, alpha = { start = .1, lower = lower } },
        model = function(q, row) return math.atan(q.alpha + q.tau0 * row.x) end }
      if found.parameters.tau0.at_lower or found.parameters.alpha.at_lower then
        at_bound = at_bound + 1
        combinations = combinations + #found.combinations
        for name, value in pairs(truth) do
          local of = found.parameters[name]
          for _, ends in ipairs{ { of.low, of.high }, { of.profile_low, of.profile_high } } do
            if ends[1] or ends[2] then
              printed = printed + 1
              if (ends[1] or value) > value or (ends[2] or value) < value then wrong = wrong + 1 end
            end
          end
        end
      end
    end
    print(("c %2.0f %% apart, alpha %s: %2d at a bound, intervals printed %d, wrong %d; combinations %d"):format(
      100 * (ratio - 1), lower == 0 and "above 0" or "free   ", at_bound, printed, wrong, combinations))
  end
end

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 8a: does a rougher fractal surface make a stiffer or a softer contact?
--
--   asperity run examples/paper/fig8a_stiffness.lua
--
-- For boxes the secant stiffness (load over approach) falls by 31 % (preset A) and 12 % (preset B)
-- from D = 2.0 to 2.9, because among many independent heights the highest stands alone and the flat
-- has further to go. The fall is a property of boxes and of means over seeds, and of the definition
-- of "one amplitude". On a half-space (`-- half_space=12`) the stiffness changes by -7 and +6 %.

local lab = require "asperity"
local paper = require "asperity.paper"

local options = require "asperity.arguments"({ seeds = 20, cells = 150, half_space = 0 }, ...)
local seeds, cells = paper.count(options.seeds), options.cells

-- 1. The height of the surfaces by eq. (2) at D = 2. It is the height of the boxes under the
--    unscaled surfaces.
local height_at_2 = lab.ensemble{ over = { preset = paper.presets, seed = seeds },
  run = function(case)
    local given = { preset = case.preset, D = 2, seed = case.seed, cells = cells, unscaled = true }
    return { height = paper.surface(given).peak_to_valley }
  end }

-- 2. Every surface under the load p = 0.01 E, with three definitions of "one amplitude": equal
--    peak-to-valley heights, six rms heights, or no scaling. The unit of stiffness is E per
--    amplitude, and the approach is in amplitudes.
local rows = lab.ensemble{ over = { preset = paper.presets, D = paper.dimensions, seed = seeds,
    scaling = { "peak to valley", "six rms", "none" } },
  run = function(case)
    local unscaled = case.scaling == "none"
    local surface = paper.surface{ preset = case.preset, D = case.D, seed = case.seed,
      cells = cells, unscaled = unscaled }
    local A = surface.peak_to_valley
    if case.scaling == "six rms" then surface = surface:scaled{ rms = A / 6 } end
    if unscaled then A = height_at_2:mean("height", { where = { preset = case.preset } })[1].mean end
    local st = paper.contact(surface, A):press{ pressure = paper.pressure }
    return { approach = st.approach / A, area = st.area_fraction, spots = st.spots,
      secant = st.secant_stiffness * A / paper.young, tangent = st.stiffness * A / paper.young }
  end }
rows:write "stiffness_of_each.csv"

-- 3. The means over seeds of equal peak-to-valley heights.
local each = rows:where{ scaling = "peak to valley" }
local means = paper.means(each, { "preset", "D" }, "stiffness.csv")
lab.say("Boxes under a rigid flat at p = 0.01 E: means of %d seeds; side of A: L, of B: 3 L", #seeds)
means:show{ "preset", "D", "approach", "approach_sd", "area", "area_sd", "tangent", "secant",
  "secant_sd", "spots", digits = 4 }
means:expect("approach", { at_least = 0.2, at_most = 0.5 }) -- as in the paper

-- 4. From D = 2.0 to 2.9 with the three scalings: the mean of the ratios of each seed. Only equal
--    peak-to-valley heights show both trends; the other scalings are negative controls. The tangent
--    stiffness of boxes equals the area fraction and rises.
local ratios = rows:where{ D = 2.9 }
  :joined(rows:where{ D = 2.0 }, { by = { "scaling", "preset", "seed" }, suffix = "_at_2" })
  :with{
    area = function(row) return row.area / row.area_at_2 end,
    secant = function(row) return row.secant / row.secant_at_2 end,
    ["seeds_softer [%]"] = function(row) return row.secant < row.secant_at_2 and 100 or 0 end,
  }
local scaling = paper.means(ratios, { "scaling", "preset" }, "scaling.csv")
print "\nD = 2.9 against D = 2.0"
scaling:show{ "scaling", "preset", "area", "secant", "seeds_softer [%]", digits = 3 }
for _, preset in ipairs(#seeds >= 20 and paper.presets or {}) do
  local where = { preset = preset }
  means:expect("secant", { where = where, decreasing_in = "D" })
  means:expect("tangent", { where = where, increasing_in = "D" })
  means:expect("approach", { where = where, increasing_in = "D" })
  means:expect("spots", { where = where, increasing_in = "D" })
  means:expect("tangent", { where = where, decreasing_in = "D", should_fail = true,
    label = "control: the tangent" })
  local function of(name) return { scaling = name, preset = preset } end
  scaling:expect("secant", { where = of "peak to valley", at_most = 1 })
  scaling:expect("area", { where = of "peak to valley", at_least = 1 })
  scaling:expect("area", { where = of "six rms", at_least = 1, should_fail = true,
    label = "control: equal rms heights" })
  scaling:expect("secant", { where = of "none", at_most = 1, should_fail = true,
    label = "control: unscaled heights" })
end

-- 5. An independent computation of these 20 seeds agrees to the last digit printed.
if #seeds == 20 and cells == 150 then
  each:expect("approach", { at_least = 0.2, at_most = 0.5, label = "each one deformed as in the paper" })
  local within = { { "approach", 1e-4 }, { "area", 1e-4 }, { "secant", 1e-5 } }
  paper.agree(means:where{ preset = "A" }, { "D" }, within, {
    { 2.0, .2623, .1274, .03877 }, { 2.1, .2731, .1293, .03720 }, { 2.2, .2842, .1312, .03575 },
    { 2.3, .2958, .1330, .03437 }, { 2.4, .3105, .1357, .03271 }, { 2.5, .3263, .1385, .03110 },
    { 2.6, .3409, .1420, .02977 }, { 2.7, .3556, .1464, .02847 }, { 2.8, .3676, .1497, .02747 },
    { 2.9, .3809, .1535, .02642 } })
  paper.agree(means:where{ preset = "B" }, { "D" }, within, {
    { 2.0, .3211, .1325, .03141 }, { 2.1, .3267, .1345, .03085 }, { 2.3, .3377, .1390, .02980 },
    { 2.5, .3503, .1442, .02873 }, { 2.7, .3606, .1505, .02793 }, { 2.8, .3612, .1533, .02787 },
    { 2.9, .3616, .1549, .02777 } })
  paper.agree(scaling, { "preset", "scaling" }, { { "area", 0.01 }, { "secant", 0.01 } }, {
    { "A", "peak to valley", 1.24, .69 }, { "A", "six rms", .90, .50 }, { "A", "none", 2.03, 1.16 },
    { "B", "peak to valley", 1.17, .89 }, { "B", "six rms", .97, .74 }, { "B", "none", 2.29, 1.81 },
  })
end

-- 6. The surfaces on a half-space: young 1, poisson 0, free. `half_space` is the number of seeds.
--    With seeds 1 to 12 the real area falls, from 0.038 to 0.0065 and from 0.019 to 0.006.
if options.half_space > 0 then
  local ends = paper.on_half_space(options.half_space)
  local change = ends:where{ D = 2.9 }
    :joined(ends:where{ D = 2.0 }, { by = "preset", suffix = "_at_2" })
    :with{ area_left = function(row) return row.area / row.area_at_2 end,
      ["secant_change [%]"] = function(row) return 100 * (row.secant / row.secant_at_2 - 1) end }
  lab.say("\nOn an elastic half-space under 0.006 E: means of %d seeds", options.half_space)
  change:show{ "preset", "area_at_2", "area", "secant_change [%]", "spots_at_2", "spots", digits = 3 }
  change:write "half_space.csv"
  change:expect("area_left", { at_most = 0.4, label = "the area falls with D" })
  local known = { { "A", 0.038, 0.0065, -7 }, { "B", 0.019, 0.006, 6 } }
  paper.agree(change, { "preset" }, { { "area_at_2", 5e-4 }, { "area", 1e-4 }, { "secant_change [%]", 0.5 } },
    options.half_space == 12 and known or {})
end

-- 7. The charts.
each:chart{ x = "D", y = "secant", one_line_per = "preset", spread = true,
  file = "fig8a_stiffness.svg", title = "Rougher is softer: stiffness under p = 0.01 E",
  x_label = "fractal dimension D", y_label = "secant stiffness, E per amplitude" }
each:chart{ x = "D", y = "tangent", one_line_per = "preset", spread = true,
  file = "fig8a_tangent.svg", title = "The tangent stiffness is the area fraction, and rises",
  x_label = "fractal dimension D", y_label = "tangent stiffness, E per amplitude" }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 8b: does a rougher fractal surface slide with more or with less friction?
--
--   asperity run examples/paper/fig8b_friction.lua
--
-- Friction rises with D, and more for smaller r = alpha / (tau0/E); this holds for boxes only. The
-- coefficient without a cap is alpha + tau0 a/p exactly, and on a half-space (`-- half_space=12`)
-- the area fraction a falls with D. A cap at the strength at the boxes' yield pressure preserves
-- the order of the four curves; a cap fixed in stress breaks the order for large r.

local lab = require "asperity"
local paper = require "asperity.paper"

local options = require "asperity.arguments"({ seeds = 20, cells = 150, half_space = 0 }, ...)
local seeds, cells = paper.count(options.seeds), options.cells
local E = paper.young
local tau0 = 0.01 * E

-- 1. Twelve laws: four ratios r, each without cap, with the cap of a yield pressure, and with a
--    fixed cap.
local ratios = { 0.1, 1, 10, 100 }
local caps = { none = {}, yield = { yield_pressure = 0.2 * E }, ["2 tau0"] = { tau_max = 2 * tau0 } }
local laws = {}
for _, r in ipairs(ratios) do
  for cap, law in lab.sorted(caps) do
    law.tau0, law.alpha = tau0, r * tau0 / E
    table.insert(laws, { r = r, cap = cap, law = lab.friction(law) })
  end
end

-- 2. Every surface is pressed once and slides under all twelve laws.
local pressed = lab.ensemble{ over = { preset = paper.presets, D = paper.dimensions, seed = seeds },
  run = function(case)
    local surface = paper.surface{ preset = case.preset, D = case.D, seed = case.seed, cells = cells }
    local st = paper.contact(surface):press{ pressure = paper.pressure }
    local slides = {}
    for k, entry in ipairs(laws) do
      local exact = entry.law.alpha + entry.law.tau0 * st.area_fraction / paper.pressure
      slides[k] = { r = entry.r, cap = entry.cap, mu = entry.law:on(st).mu, exact = exact }
    end
    return { slides = slides }
  end }

-- 3. Ratios of each seed to its value at D = 2, then means over seeds.
local rows = paper.unfolded(pressed, "slides")
local rises = rows
  :joined(rows:where{ D = 2.0 }, { by = { "preset", "cap", "r", "seed" }, suffix = "_at_2" })
  :with{ rise = function(row) return row.mu / row.mu_at_2 end }
local means = paper.means(rises, { "preset", "cap", "r", "D" }, "friction.csv")

-- 4. The table, and expectations: the trend in D, the order in r, the closed form.
lab.say("mu / mu(D = 2.0) at p = 0.01 E, tau0 = 0.01 E: mean of %d seeds", #seeds)
paper.show_across(means:where{ D = { 2.0, 2.3, 2.5, 2.7, 2.9 } },
  { keys = { "preset", "cap", "D" }, across = "r", values = ratios, of = "rise", digits = 5 })
for _, preset in ipairs(paper.presets) do
  for _, cap in ipairs(#seeds >= 20 and { "none", "yield" } or {}) do
    for _, r in ipairs(ratios) do
      means:expect("rise", { where = { preset = preset, cap = cap, r = r }, increasing_in = "D" })
    end
    for k = 2, #paper.dimensions do
      local where = { preset = preset, cap = cap, D = paper.dimensions[k] }
      means:expect("rise", { where = where, decreasing_in = "r" })
    end
  end
  means:expect("rise", { where = { preset = preset, cap = "2 tau0", D = 2.9, r = { 10, 100 } },
    decreasing_in = "r", should_fail = true, label = "control: a fixed cap puts r = 100 above r = 10" })
end
means:with{ off = function(row) return row.mu / row.exact - 1 end }:expect("off", {
  where = { cap = "none", D = 2.9 }, near = 0, within = 1e-12, label = "alpha + tau0 a/p" })

-- 5. An independent computation of these 20 seeds agrees to the last digit printed.
if #seeds == 20 and cells == 150 then
  for _, line in ipairs{ -- preset, cap, D, the rise at each r
    { "A", "none", 2.5, 1.0999, 1.0922, 1.0524, 1.0099 },
    { "A", "none", 2.9, 1.2381, 1.2194, 1.1239, 1.0234 },
    { "A", "yield", 2.9, 1.2382, 1.2203, 1.1268, 1.0253 },
    { "A", "2 tau0", 2.9, 1.2381, 1.2194, 1.1718, 1.2315 },
    { "B", "none", 2.9, 1.1726, 1.1614, 1.0979, 1.0199 },
    { "B", "yield", 2.9, 1.1727, 1.1626, 1.1044, 1.0314 },
    { "B", "2 tau0", 2.9, 1.1726, 1.1614, 1.1330, 1.1677 },
  } do
    for k, r in ipairs(ratios) do
      local where = { preset = line[1], cap = line[2], D = line[3], r = r }
      means:expect("rise", { where = where, near = line[3 + k], within = 1e-4 })
    end
  end
  paper.agree(means:where{ r = 10 }, { "preset", "cap", "D" }, { { "mu", 1e-5 } }, { -- the coefficient itself
    { "A", "none", 2.0, .22744 }, { "A", "none", 2.9, .25350 }, { "A", "yield", 2.0, .22570 },
    { "A", "yield", 2.9, .25183 }, { "A", "2 tau0", 2.0, .20615 }, { "A", "2 tau0", 2.9, .23678 },
    { "B", "none", 2.0, .23248 }, { "B", "none", 2.9, .25492 },
  })
end

-- 6. The surfaces on a half-space. `half_space` is the number of seeds. With seeds 1 to 12 friction
--    falls with D, and the number of spots rises, from 38 to 226 and from 59 to 218.
if options.half_space > 0 then
  local ends = paper.on_half_space(options.half_space)
  lab.say("\nOn an elastic half-space under 0.006 E, r = 0.1: means of %d seeds", options.half_space)
  ends:show{ "preset", "D", "mu", "spots", digits = 3 }
  ends:write "half_space.csv"
  if options.half_space == 12 then
    paper.agree(ends, { "preset", "D" }, { { "mu", 0.001 } },
      { { "A", 2.0, 0.071 }, { "A", 2.9, 0.020 }, { "B", 2.0, 0.040 }, { "B", 2.9, 0.019 } })
  end
end

-- 7. The chart, without a cap and with the fixed cap.
for _, drawn in ipairs{
  { "none", "fig8b_friction.svg", "Rougher grips better, most by adhesion" },
  { "2 tau0", "fig8b_fixed_cap.svg", "Control: a fixed cap breaks the order" },
} do
  means:chart{ x = "D", y = "rise", one_line_per = "r", where = { preset = "A", cap = drawn[1] },
    file = drawn[2], title = drawn[3], x_label = "fractal dimension D", y_label = "μ / μ(D = 2)" }
end

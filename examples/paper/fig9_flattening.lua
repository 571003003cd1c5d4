-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 9: does compression take the fractal dimension of a surface away?
--
--   asperity run examples/paper/fig9_flattening.lua
--
-- D - 1, the excess over a straight line, falls at every D: 20 % of flattening leaves 82 to 94 % on
-- preset A and 89 to 94 % on preset B. Not found: the "similar proportional decrease" that the
-- paper reports for its discs. Eight events on specimens (fig5_dimension.lua), with about the same
-- loss of amplitude, leave 69 and 58 %.

local lab = require "asperity"
local paper = require "asperity.paper"

local options = require "asperity.arguments"({ seeds = 20, cells = 150 }, ...)
local seeds, cells = paper.count(options.seeds), options.cells

-- 1. One surface before and after flattening, and one profile.
local surface = paper.surface{ preset = "A", D = 2.5, seed = 1, cells = cells }:levelled{ degree = 0 }
local st = paper.contact(surface):press{ flatten = 0.2 }
print "Fig. 9: compression takes the fractal dimension away\n"
print("One of them: " .. tostring(surface) .. ".")
lab.say("Flattened by a fifth under %.4f E, it touches on %.1f %% of its area in %d spots.\n",
  st.pressure / paper.young, 100 * st.area_fraction, st.spots)
local heights = surface:roughness()
local colours = { heights.valley, heights.peak }
surface:picture("surface_before.png", { title = "before", view = "relief", range = colours })
st:deformed "lower":picture("surface_after.png", { title = "flattened by a fifth", view = "relief",
  range = colours })

local trace = lab.notebook "profile"
local profile = surface:profile{ row = cells // 2 }
local x = profile:positions()
for _, share in ipairs{ "0 %", "10 %", "20 %" } do
  for k, z in ipairs(profile:cut{ fraction = lab.quantity(share) }:heights()) do
    trace:write{ ["x [m]"] = x[k], ["height [m]"] = z, flattened = share }
  end
end

-- 2. D - 1 by the length method, each profile flattened to its own max - c (max - min), as a stylus
--    would see it. One plane across the whole surface misses most profiles: its effect is three
--    times smaller on smooth surfaces and nine times smaller on rough surfaces. The length method
--    measures heights and D together: on a surface stretched a thousandfold little falls.
local shares = { 0, 0.05, 0.1, 0.15, 0.2 }
local function excess(profiles, c)
  local sum = 0
  for _, p in ipairs(profiles) do sum = sum + p:cut{ fraction = c }:fractal_dimension().D - 1 end
  return sum / #profiles
end
local found = lab.ensemble{ over = { preset = paper.presets, D = paper.dimensions, seed = seeds },
  run = function(case)
    local surface = paper.surface{ preset = case.preset, D = case.D, seed = case.seed, cells = cells }
    local profiles, cuts = surface:profiles(), {}
    for k, c in ipairs(shares) do cuts[k] = { c = c, excess = excess(profiles, c) } end
    local by_plane = surface:cut{ fraction = 0.2 }:fractal_dimension().D - 1
    return { cuts = cuts, plane_left = by_plane / cuts[1].excess }
  end }
local steep = lab.ensemble{ over = { preset = paper.presets, seed = seeds }, run = function(case)
  local surface = paper.surface{ preset = case.preset, D = 2.5, seed = case.seed, cells = cells }
  local profiles = surface:scaled{ amplitude = 1000 * surface.peak_to_valley }:profiles()
  return { before = excess(profiles, 0), after = excess(profiles, 0.2) }
end }

-- 3. Means over seeds. The remaining share of D - 1 is the ratio of the means.
local means = paper.means(paper.unfolded(found, "cuts"), { "preset", "D", "c" })
local book = means:joined(means:where{ c = 0 }, { by = { "preset", "D" }, suffix = "_before" })
  :with{ left = function(row) return row.excess / row.excess_before end }
local control = paper.means(steep, { "preset" })
  :with{ left = function(row) return row.after / row.before end }
book:write "flattening.csv"
control:write "controls.csv"
lab.say("D - 1 of profiles that are flattened by a share c of their height: mean of %d seeds", #seeds)
paper.show_across(book, { keys = { "preset", "D" }, across = "c", values = shares, of = "excess",
  digits = 4 })
print "\nLeft of D - 1 at c = 0.2, by profile and by one plane:"
book:where{ c = 0.2 }:show{ "preset", "D", "left", "plane_left", digits = 3 }
print "\nThe same by profile at D = 2.5, a thousand times steeper:"
control:show{ "preset", "left", digits = 3 }

-- 4. The trend of the figure at every D and on both presets.
for _, preset in ipairs(paper.presets) do
  for _, D in ipairs(paper.dimensions) do
    book:expect("excess", { where = { preset = preset, D = D }, decreasing_in = "c" })
  end
end
control:expect("left", { at_most = 0.95, should_fail = true, label = "control: steep heights lose little" })

-- 5. An independent computation of these 20 seeds agrees to the last digit printed.
if #seeds == 20 and cells == 150 then
  for _, line in ipairs{ -- preset, D, D - 1 at c = 0, 0.1, 0.2
    { "A", 2.0, .0051, .0047, .0042 }, { "A", 2.1, .0080, .0073, .0065 }, { "A", 2.2, .0125, .0115, .0104 },
    { "A", 2.3, .0199, .0185, .0166 }, { "A", 2.4, .0311, .0292, .0264 }, { "A", 2.5, .0481, .0457, .0416 },
    { "A", 2.6, .0727, .0697, .0642 }, { "A", 2.7, .1066, .1033, .0963 }, { "A", 2.8, .1520, .1485, .1402 },
    { "A", 2.9, .2110, .2074, .1982 }, { "B", 2.0, .0238, nil, .0211 }, { "B", 2.1, .0307, nil, .0273 },
    { "B", 2.3, .0528, nil, .0473 }, { "B", 2.5, .0911, nil, .0827 }, { "B", 2.7, .1501, nil, .1391 },
    { "B", 2.8, .1898, nil, .1778 }, { "B", 2.9, .2355, nil, .2226 },
  } do
    for k, c in pairs{ [3] = 0, [4] = 0.1, [5] = 0.2 } do
      local where = { preset = line[1], D = line[2], c = c }
      if line[k] then book:expect("excess", { where = where, near = line[k], within = 1e-4 }) end
    end
  end
  paper.agree(book:where{ c = 0.2 }, { "preset", "D" }, { { "left", 1e-3 } }, {
    { "A", 2.1, .822 }, { "A", 2.3, .835 }, { "A", 2.5, .865 }, { "A", 2.7, .904 }, { "A", 2.9, .939 },
    { "B", 2.1, .889 }, { "B", 2.3, .895 }, { "B", 2.5, .908 }, { "B", 2.7, .927 }, { "B", 2.9, .945 },
  })
  control:expect("left", { where = { preset = "A" }, near = .968, within = 1e-3 })
end

-- 6. The chart and the profile.
book:chart{ x = "c", y = "left", one_line_per = "D",
  where = { preset = "A", D = { 2.1, 2.3, 2.5, 2.7, 2.9 } }, file = "fig9_flattening.svg",
  title = "Fractal dimension under compression", x_label = "flattened by, of the height",
  y_label = "what is left of D - 1" }
trace:chart{ x = "x", y = "height", one_line_per = "flattened", points = false,
  file = "profile.svg", title = "One profile, flattened" }

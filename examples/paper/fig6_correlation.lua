-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 6: do fractal dimension and roughness fall together?
--
--   asperity run examples/paper/fig6_correlation.lua
--
-- ln(D - 1) against ln(Ra / 1 um) is closer to a straight line for events than for stress, clearer
-- on whole maps than on stylus scans (the paper's method). Each map alone is nearly straight both
-- ways, but stress changes Ra by 6 %, and D - 1 by no more than the difference between specimens;
-- eight events change Ra by a fifth. Interpolation at every turn (control) reduces D - 1, not Ra.

local lab = require "asperity"
local laboratory = require "asperity.laboratory"
local paper = require "asperity.paper"
local um = lab.units.um

local options = require "asperity.arguments"({ pairs = 8, cells = 256 }, ...)

-- 1. ln(D - 1) and ln(Ra / 1 um) of every specimen and state, over the map and by five stylus
--    scans. The control: no load, but interpolation at every turn.
local found = lab.ensemble{ over = { kind = laboratory.kinds, pair = paper.count(options.pairs) },
  run = function(case)
    local lower, upper = laboratory.specimens{ kind = case.kind, pair = case.pair, cells = options.cells }
    local interpolated, states = {}, {}
    for k = 1, 8 do interpolated[k] = laboratory.interpolated(interpolated[k - 1] or lower, 1) end
    for way, surfaces in lab.sorted{ ["six stresses"] = laboratory.after_stress(lower, upper),
      ["eight events"] = laboratory.after_events(lower, upper, { seed = case.pair }),
      ["interpolated"] = interpolated } do
      for k, surface in ipairs(surfaces) do
        local scans = laboratory.scanned(surface, case.pair)
        table.insert(states, { by = way, state = k, ln_Ra = math.log(surface:roughness().Ra / um),
          ln_excess = math.log(laboratory.excess(surface)), ln_scanned_Ra = math.log(scans.Ra / um),
          ln_scanned_excess = math.log(scans.excess) })
      end
    end
    return { states = states }
  end }
local rows = paper.unfolded(found, "states", "correlation.csv")

-- 2. The line through each set, and the lines through all sets.
local function line(where, of)
  local set = rows:where(where)
  return laboratory.line(set:column(of .. "Ra"), set:column(of .. "excess"))
end
local sets, fits = lab.notebook "sets", lab.notebook "fits"
for _, kind in ipairs(laboratory.kinds) do
  for _, way in ipairs{ "six stresses", "eight events", "interpolated" } do
    for pair = 1, options.pairs do
      local one = line({ kind = kind, by = way, pair = pair }, "ln_")
      sets:write{ kind = kind, by = way, pair = pair, slope = one.slope, r2 = one.r2 }
    end
    local all = line({ kind = kind, by = way }, "ln_")
    local scans = line({ kind = kind, by = way }, "ln_scanned_")
    fits:write{ kind = kind, by = way, slope = all.slope, intercept = all.intercept, r2 = all.r2,
      scanned_slope = scans.slope, scanned_r2 = scans.r2 }
  end
end
lab.say("Fig. 6: ln(D - 1) against ln(Ra / 1 um), lower specimens of %d pairs of each kind", options.pairs)
print "One set at a time:"
local means = paper.means(sets, { "kind", "by" })
  :with{ least_r2 = function(row) return sets:where{ kind = row.kind, by = row.by }:min "r2" end }
means:show{ "kind", "by", "slope", "slope_sd", "least_r2", digits = 4 }
print "All sets on one line, by maps and by five stylus scans of each specimen:"
fits:show{ "kind", "by", "slope", "intercept", "r2", "scanned_slope", "scanned_r2", digits = 3 }

-- 3. Expectations. Each loaded set is nearly a straight line, and not a steep one. The slopes of
--    the control are 17 and 10.
local loaded = { by = { "six stresses", "eight events" } }
means:expect("least_r2", { where = loaded, at_least = 0.98 })
means:expect("slope", { where = loaded, at_most = 3 })
if options.pairs == 8 and options.cells == 256 then
  paper.agree(fits, { "kind", "by" }, { { "r2", 0.006 }, { "scanned_r2", 0.006 } }, {
    { "self-affine", "six stresses", 0.33, 0.00 }, { "self-affine", "eight events", 0.89, 0.42 },
    { "bead-blasted", "six stresses", 0.21, 0.03 }, { "bead-blasted", "eight events", 0.87, 0.63 },
  })
end
for _, kind in ipairs(laboratory.kinds) do
  means:expect("slope", { where = { kind = kind, by = "interpolated" }, at_most = 3,
    should_fail = true, label = "control: a store that interpolates takes roughness along with dimension" })
  if options.pairs >= 3 then
    local of_stress = fits:where{ kind = kind, by = "six stresses" }[1].r2
    fits:expect("r2", { where = { kind = kind, by = "eight events" }, at_least = of_stress,
      label = "events lie closer to one line than stresses" })
  end
end

-- 4. The charts.
for _, kind in ipairs(laboratory.kinds) do
  rows:chart{ x = "ln_Ra", y = "ln_excess", one_line_per = "by", where = { kind = kind },
    lines = false, file = "fig6_" .. kind .. ".svg",
    title = "Dimension against roughness, " .. kind, x_label = "ln(Ra / 1 µm)",
    y_label = "ln(D − 1)" }
end

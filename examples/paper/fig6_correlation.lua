-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 6: do fractal dimension and roughness fall together?
--
--   asperity run examples/paper/fig6_correlation.lua
--   asperity run examples/paper/fig6_correlation.lua -- pairs=2
--   asperity run examples/paper/fig6_correlation.lua -- pairs=8 cells=512
--
-- The paper: ln(D - 1) against ln(Ra / 1 um) is closer to a straight line when N varies than when stress
-- does.
-- Here: so it is, of 8 sets of each kind, by whole maps: r2 of one line through all is 0.89 against 0.33
-- (self-affine), 0.87 against 0.21 (bead-blasted). The reason is plain: each map's set by itself is nearly straight
-- either way (r2 above 0.99), with slopes of 1.6 to 2.3 in the mean. But stress moves Ra by 6 %, and with it D - 1
-- no further than one specimen is from the next; eight events move Ra by a fifth.
-- The paper's points are stylus scans. By the mean of five scans a specimen, steps of 0.25 to 250 um, the ordering is
-- the same and less of it is seen: r2 of 0.42 and 0.63 with N, 0.00 and 0.03 with stress. Both are printed.
-- The control: a store that interpolates at every turn takes D - 1 and leaves Ra, with slopes of 17 and 10:
-- straight too, but nothing like a loaded specimen.
-- Not predicted: slope and intercept of the paper's discs, which depend on the shape of their ground.

local lab = require "asperity"
local arguments = require "asperity.arguments"
local laboratory = require "asperity.laboratory"
local paper = require "asperity.paper"
local um = lab.units.um

local options = arguments({ pairs = 8, cells = 256 }, ...)
local cells = options.cells

-- 1. Ra and D - 1 of every specimen in every state.
local found = lab.ensemble{
  over = { kind = laboratory.kinds, pair = paper.count(options.pairs) },
  run = function(case)
    local laboratory = require "asperity.laboratory"
    local lower, upper = laboratory.specimens{ kind = case.kind, pair = case.pair, cells = cells }
    local function measured(surfaces)
      local rows = {}
      for k, surface in ipairs(surfaces) do
        rows[k] = { Ra = surface:roughness().Ra, excess = laboratory.excess(surface) }
        local scans = laboratory.scanned(surface, case.pair)
        rows[k].scanned_Ra, rows[k].scanned_excess = scans.Ra, scans.excess
      end
      return rows
    end
    -- The control: no load, but stored as if every turn interpolated.
    local interpolated = {}
    for k = 1, 8 do interpolated[k] = laboratory.interpolated(interpolated[k - 1] or lower, 1) end
    return {
      ["six stresses"] = measured(laboratory.after_stress(lower, upper)),
      ["eight events"] = measured(laboratory.after_events(lower, upper, { seed = case.pair })),
      ["interpolated"] = measured(interpolated),
    }
  end,
}

-- 2. ln(D - 1) against ln(Ra / 1 um): a row for every specimen and state.
local book, fits = lab.notebook "correlation", lab.notebook "fits"
local ways = { "six stresses", "eight events", "interpolated" }
for _, case in ipairs(found) do
  for _, way in ipairs(ways) do
    for k, row in ipairs(case[way]) do
      book:write{ kind = case.kind, pair = case.pair, by = way, state = k,
        ln_Ra = math.log(row.Ra / um), ln_excess = math.log(row.excess),
        ln_scanned_Ra = math.log(row.scanned_Ra / um), ln_scanned_excess = math.log(row.scanned_excess) }
    end
  end
end
local function fit(where, of)
  local x, y = {}, {}
  for k, row in ipairs(paper.where(book:rows(), where)) do
    x[k], y[k] = row["ln_" .. (of or "") .. "Ra"], row["ln_" .. (of or "") .. "excess"]
  end
  return laboratory.line(x, y)
end

-- 3. What a reader checks: the line through each set by itself, and through all sets at once.
print(("Fig. 6: ln(D - 1) against ln(Ra / 1 um), lower specimens of %d pairs of each kind"):format(
  options.pairs))
for _, kind in ipairs(laboratory.kinds) do
  print(("\n%s     one set at a time           all sets on one line"):format(kind))
  print "                   slope      least r2      slope   intercept    r2"
  for _, way in ipairs(ways) do
    local slopes, least = {}, 1
    for pair = 1, options.pairs do
      local line = fit{ kind = kind, pair = pair, by = way }
      slopes[pair], least = line.slope, math.min(least, line.r2)
    end
    local slope, scatter = laboratory.average(slopes)
    local all = fit{ kind = kind, by = way }
    print(("  %-12s  %5.2f +- %.2f    %.4f      %5.2f     %6.2f    %.3f"):format(way, slope, scatter, least,
      all.slope, all.intercept, all.r2))
    local scans = fit({ kind = kind, by = way }, "scanned_")
    fits:write{ kind = kind, by = way, slope = all.slope, intercept = all.intercept, r2 = all.r2,
      slope_of_sets = slope, least_r2_of_sets = least, scanned_slope = scans.slope, scanned_r2 = scans.r2 }
  end
  print "  by five stylus scans a specimen, all sets on one line:"
  for _, row in ipairs(paper.where(fits:rows(), { kind = kind })) do
    print(("  %-12s                             %5.2f                %.3f"):format(row.by, row.scanned_slope,
      row.scanned_r2))
  end
end

-- 4. What must hold. Loaded, a set by itself is nearly a straight line either way, and not a steep one.
for _, kind in ipairs(laboratory.kinds) do
  for _, way in ipairs{ "six stresses", "eight events" } do
    fits:expect("least_r2_of_sets", { where = { kind = kind, by = way }, at_least = 0.98 })
    fits:expect("slope_of_sets", { where = { kind = kind, by = way }, at_most = 3 })
  end
  fits:expect("slope_of_sets", { where = { kind = kind, by = "interpolated" }, at_most = 3,
    should_fail = true, label = "control: a store that interpolates takes roughness along with dimension" })
  -- The numbers of this script's head.
  if options.pairs == 8 and cells == 256 then
    local head = { ["self-affine"] = { { 0.33, 0.00 }, { 0.89, 0.42 } }, ["bead-blasted"] = { { 0.21, 0.03 }, { 0.87, 0.63 } } }
    for k, way in ipairs{ "six stresses", "eight events" } do
      local where, said = { kind = kind, by = way }, head[kind][k]
      fits:expect("r2", { where = where, near = said[1], within = 0.006 })
      fits:expect("scanned_r2", { where = where, near = said[2], within = 0.006 })
    end
  end
  if options.pairs >= 3 then
    local of_stress = paper.where(fits:rows(), { kind = kind, by = "six stresses" })[1].r2
    fits:expect("r2", { where = { kind = kind, by = "eight events" }, at_least = of_stress,
      label = "events lie closer to one line than stresses" })
  end
end

-- 5. The figure.
for _, kind in ipairs(laboratory.kinds) do
  book:chart{
    x = "ln_Ra", y = "ln_excess", one_line_per = "by", where = { kind = kind }, lines = false,
    file = "fig6_" .. kind .. ".svg", title = "Dimension against roughness, " .. kind,
    x_label = "ln(Ra / 1 µm)", y_label = "ln(D − 1)",
  }
end
print "\nDrawn: fig6_self-affine.svg, fig6_bead-blasted.svg."

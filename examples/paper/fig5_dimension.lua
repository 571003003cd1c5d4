-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 5: does loading take the fractal dimension of two rough specimens away, and which loading most?
--
--   asperity run examples/paper/fig5_dimension.lua
--
-- D - 1, the excess over a straight line, falls for every one of 8 pairs of each kind, and profiles
-- get shorter at every resolution. A plane cut of the same volumes reduces D - 1 too, so D - 1 does
-- not show how specimens yield; the real area does (fig7_tilt.lua). Eight bilinear interpolations
-- without load (control) multiply D - 1 by 0.67, so we never resample a specimen that turns.

local lab = require "asperity"
local laboratory = require "asperity.laboratory"
local paper = require "asperity.paper"

local options = require "asperity.arguments"({ pairs = 8, cells = 256 }, ...)

-- 1. The lower specimen of every pair, after one event at each stress and after each of eight
--    events at 152.78 MPa: D - 1 and its profile lengths. Then the controls: eight moves without
--    load, and a plane cut. The smallest step is one cell of 3.9 um; the paper's is 0.25 um. D
--    itself is 1.002 to 1.004 here: the length method measures roughness and dimension together,
--    and these heights are too flat for it.
local found = lab.ensemble{ over = { kind = laboratory.kinds, pair = paper.count(options.pairs) },
  run = function(case)
    local lower, upper = laboratory.specimens{ kind = case.kind, pair = case.pair, cells = options.cells }
    local virgin, by_stress, by_N, lengths = laboratory.excess(lower), {}, {}, {}
    for k, surface in ipairs(laboratory.after_stress(lower, upper)) do
      by_stress[k] = { stress = laboratory.stresses[k], excess = laboratory.excess(surface) }
    end
    local turned = laboratory.after_events(lower, upper, { seed = case.pair })
    for N, surface in ipairs(turned) do by_N[N] = { N = N, excess = laboratory.excess(surface) } end
    local steps, before = laboratory.lengths(lower)
    local _, once = laboratory.lengths(turned[1])
    local _, eight = laboratory.lengths(turned[8])
    for k, step in ipairs(steps) do
      lengths[k] = { step = step, virgin = before[k], ["1 event"] = once[k], ["8 events"] = eight[k],
        left = eight[k] / once[k] }
    end

    local bench = laboratory.bench(lower, upper)
    for seed = 1, 8 do bench:place{ seed = seed } end
    return { by_stress = by_stress, by_N = by_N, lengths = lengths, virgin = virgin,
      left_stress = by_stress[6].excess / by_stress[1].excess,
      left_N = by_N[8].excess / by_N[1].excess,
      placed = laboratory.excess(bench:upper()) / laboratory.excess(upper),
      interpolated = laboratory.excess(laboratory.interpolated(lower, 8)) / virgin,
      plane = laboratory.excess(laboratory.cut_to_a_plane(lower, upper, laboratory.stresses[6]))
        / laboratory.excess(laboratory.cut_to_a_plane(lower, upper, laboratory.stresses[1])) }
  end }

-- 2. One row per specimen and state, one per specimen and step, and the means of the ratios.
local stresses = paper.unfolded(found, "by_stress", "stress.csv")
local events = paper.unfolded(found, "by_N", "events.csv")
local length = paper.unfolded(found, "lengths", "length.csv")
local means = paper.means(found, { "kind" }, "means.csv")

-- 3. The tables: means over specimens.
lab.say("Fig. 5: D - 1 by profile length, lower specimens of %d pairs of each kind", options.pairs)
print "One event at each stress:"
paper.means(stresses, { "kind", "stress" }):show{ "kind", "stress [MPa]", "excess", digits = 5 }
print "Events at 152.78 MPa:"
paper.means(events, { "kind", "N" }):show{ "kind", "N", "excess", digits = 4 }
print "D - 1 of virgin specimens. Ratios: left_stress and plane 203.72 / 20.37 MPa, plane by a cut;"
print "left_N eight events / one; placed and interpolated eight moves without load; sd over pairs:"
means:show{ "kind", "virgin", "left_stress", "left_stress_sd", "left_N", "left_N_sd", "placed",
  "interpolated", "interpolated_sd", "plane", "plane_sd", digits = 4 }
print "L/L0 - 1, eight events / one, at the finest and the coarsest step:"
local by_step = paper.means(length, { "step", "kind" })
local fine, coarse = by_step:min "step", by_step:max "step"
by_step:where{ step = { fine, coarse } }:show{ "kind", "step [um]", "left", digits = 3 }

-- 4. Expectations for every pair and for the means. A move without load changes nothing.
--    Interpolation alone causes most of the effect of eight events.
local bands = { ["self-affine"] = { 0.66, 0.72 }, ["bead-blasted"] = { 0.55, 0.62 } }
for mean in means:each() do
  for pair = 1, options.pairs do
    local where = { kind = mean.kind, pair = pair }
    stresses:expect("excess", { where = where, decreasing_in = "stress" })
    events:expect("excess", { where = where, decreasing_in = "N" })
    length:expect("8 events", { where = where, decreasing_in = "step", label = "longer at finer steps" })
  end
  local where, band = { kind = mean.kind }, bands[mean.kind]
  means:expect("left_N", { where = where, at_most = mean.left_stress,
    label = "eight events take more than ten times the stress" })
  if options.pairs >= 8 then
    means:expect("left_stress", { where = where, at_least = 0.86, at_most = 0.94 })
    means:expect("left_N", { where = where, at_least = band[1], at_most = band[2] })
  end
  means:expect("interpolated", { where = where, at_least = 0.99, should_fail = true,
    label = "control: no load, a store that interpolates" })
end
length:expect("left", { at_most = 0.99, label = "eight events shorten at every step" })
means:expect("placed", { near = 1, within = 1e-12, label = "no load, put down eight times" })

-- 5. The charts: D - 1 against stress and events, and profile length against resolution.
stresses:chart{ x = "stress [MPa]", y = "excess", one_line_per = "kind", spread = true,
  file = "fig5_stress.svg", title = "Fractal dimension after one event", y_label = "D − 1" }
events:chart{ x = "N", y = "excess", one_line_per = "kind", spread = true, file = "fig5_events.svg",
  title = "Fractal dimension after N events at 152.78 MPa", y_label = "D − 1" }
for _, kind in ipairs(laboratory.kinds) do
  length:chart{ x = "step [um]", y = { "virgin", "1 event", "8 events" }, log_x = true,
    log_y = true, where = { kind = kind, pair = 1 }, file = "fig5_length_" .. kind .. ".svg",
    title = "Profile length against resolution, " .. kind, y_label = "L / L0 − 1" }
end

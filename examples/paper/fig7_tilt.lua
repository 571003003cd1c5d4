-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 7: do pressed specimens slide with more friction on a flat, and after which loading?
--
--   asperity run examples/paper/fig7_tilt.lua
--
-- Friction rises with the number of events ONLY IF SUMMITS STAY ELASTIC ON QUARTZ: their pressures
-- then exceed the hardness H that capped the presses. With this cap on quartz too, real area over
-- load rises by a factor of 1.06 only. With the stress of one event friction changes by less than
-- the paper's 20 %.

local lab = require "asperity"
local laboratory = require "asperity.laboratory"
local paper = require "asperity.paper"

local defaults = { pairs = 8, cells = 256, tau = 500e6, alpha = 0.2, scatter = 0.1, first = 1 }
local options = require "asperity.arguments"(defaults, ...)
local law = lab.friction{ tau0 = options.tau, alpha = options.alpha }

-- 1. The lower specimen of every pair and state, on flat quartz and on the tilt stage, five trials
--    each: friction, alpha + tau0 A/F, and the real area per load A/F of an elastic solve. Trials
--    on a flat differ by `scatter` only, which is an input. Only ratios of A/F are predictions:
--    tau0 and alpha are illustrative. Then the controls: yielding spots on quartz, and a plane cut.
local function tilted(surfaces, column, values, seed)
  local rows = {}
  for k, surface in ipairs(surfaces) do
    local t = lab.tilt_stage{ contact = laboratory.on_quartz(surface), friction = law,
      mass = "4.3 g", specimen_area = math.pi * 0.0125 ^ 2, probe_pressure = laboratory.probe,
      scatter = options.scatter }:raise{ seed = seed + k }
    rows[k] = { [column] = values[k], mu = t.mu, spread = t.spread, area_per_load = t.area_per_load }
  end
  return rows
end
local function rise(first, last, hardness)
  return laboratory.area_per_load(last, hardness) / laboratory.area_per_load(first, hardness)
end
local found = lab.ensemble{ over = { kind = laboratory.kinds,
    pair = paper.count(options.pairs, options.first) },
  run = function(case)
    local lower, upper = laboratory.specimens{ kind = case.kind, pair = case.pair, cells = options.cells }
    local pressed = laboratory.after_stress(lower, upper)
    local turned = laboratory.after_events(lower, upper, { seed = case.pair })
    local by_stress = tilted(pressed, "stress", laboratory.stresses, 1000 * case.pair)
    local by_N = tilted(turned, "N", paper.count(8), 1000 * case.pair + 100)
    local H = lower.material.hardness
    local mean_1, peak_1, above_1, nodes_1 = laboratory.over_hardness(turned[1])
    local mean_8, peak_8, above_8, nodes_8 = laboratory.over_hardness(turned[8])
    return { mu_20_MPa = by_stress[1].mu, mu_204_MPa = by_stress[6].mu,
      mu_1_event = by_N[1].mu, mu_8_events = by_N[8].mu,
      mean_over_H = (mean_1 + mean_8) / 2, peak_over_H = (peak_1 + peak_8) / 2,
      load_above_H = (above_1 + above_8) / 2, nodes_1 = nodes_1, nodes_8 = nodes_8,
      by_stress = by_stress, by_N = by_N,
      rise_stress = by_stress[6].area_per_load / by_stress[1].area_per_load,
      rise_N = by_N[8].area_per_load / by_N[1].area_per_load,
      rise_N_at_H = rise(turned[1], turned[8], H), rise_N_at_3H = rise(turned[1], turned[8], 3 * H),
      rise_plane = rise(laboratory.cut_to_a_plane(lower, upper, laboratory.stresses[1]),
        laboratory.cut_to_a_plane(lower, upper, laboratory.stresses[6])) }
  end }

-- 2. One row per specimen and state, and means over specimens.
local stresses = paper.unfolded(found, "by_stress", "stress.csv")
local events = paper.unfolded(found, "by_N", "events.csv")
local by_stress, by_N = paper.means(stresses, { "kind", "stress" }), paper.means(events, { "kind", "N" })
local means = paper.means(found, { "kind" }):with{
  mu_stress = function(row) return row.mu_204_MPa / row.mu_20_MPa end,
  mu_N = function(row) return row.mu_8_events / row.mu_1_event end }
means:write "means.csv"

-- 3. The tables: means over specimens.
lab.say("Fig. 7: lower specimens of %d pairs of each kind on flat quartz, tau0 = %.0f [MPa], alpha = %g",
  options.pairs, options.tau, options.alpha)
print "One event at each stress; A/F is in 1/Pa:"
by_stress:show{ "kind", "stress [MPa]", "area_per_load", "mu", digits = 5 }
print "Events at 152.78 MPa, with the spread of five trials:"
by_N:show{ "kind", "N", "area_per_load", "mu", "spread", digits = 5 }
print "Ratios of A/F: stress and plane 203.72 / 20.37 MPa, plane by a cut of the same volumes; N"
print "eight events / one, spots on quartz stay elastic, yield at 3 H or at H; sd over pairs:"
means:show{ "kind", "rise_stress", "rise_stress_sd", "rise_N", "rise_N_sd", "rise_N_at_3H",
  "rise_N_at_3H_sd", "rise_N_at_H", "rise_N_at_H_sd", "rise_plane", "rise_plane_sd", digits = 4 }
print "Elastic spots on quartz (N = 1 and 8), the touching nodes, and the ratios of mu:"
means:show{ "kind", "mean_over_H", "peak_over_H", "load_above_H [%]", "nodes_1", "nodes_8",
  "mu_stress", "mu_N", digits = 3 }

-- 4. Expectations for means over specimens. Single specimens scatter too much.
for mean in means:each() do
  local where = { kind = mean.kind }
  means:expect("rise_N", { where = where, at_least = mean.rise_stress,
    label = "elastic spots, A/F: eight events above ten times the stress" })
  means:expect("rise_N_at_H", { where = where, at_least = 1.2, should_fail = true,
    label = "spots that yield at H, as in the presses: no rise of A/F with N" })
  means:expect("rise_plane", { where = where, at_least = 0.9, at_most = 1.4, should_fail = true,
    label = "control: A/F, 203.72/20.37, cut by a plane" })
end
means:expect("mu_N", { at_least = 1.1, label = "elastic spots: friction rises with N" })
means:expect("mean_over_H", { at_least = 1.2,
  label = "but they carry more than the hardness that capped the presses" })
if options.pairs >= 8 then
  means:expect("rise_N", { at_least = 1.3 })
  means:expect("rise_N_at_3H", { at_least = 1.2 })
  means:expect("mu_stress", { at_least = 0.8, at_most = 1.2,
    label = "friction against stress stays within the paper's own 20 %" })
end
if options.pairs >= 24 then means:expect("rise_stress", { at_least = 0.9, at_most = 1.4 }) end

-- 5. The charts.
stresses:chart{ x = "stress [MPa]", y = "mu", one_line_per = "kind", spread = true,
  file = "fig7_stress.svg", title = "Friction on quartz after one event", y_label = "μ" }
events:chart{ x = "N", y = "mu", one_line_per = "kind", spread = true, file = "fig7_events.svg",
  title = "Friction on quartz after N events at 152.78 MPa", y_label = "μ" }

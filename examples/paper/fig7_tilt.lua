-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 7: do pressed specimens slide with more friction on a flat, and after which loading?
--
--   asperity run examples/paper/fig7_tilt.lua
--   asperity run examples/paper/fig7_tilt.lua -- pairs=2
--   asperity run examples/paper/fig7_tilt.lua -- pairs=24 tau=300e6 alpha=0.3 scatter=0
--   asperity run examples/paper/fig7_tilt.lua -- first=25 pairs=48
--
-- The paper: on flat quartz, under their own weight, friction of specimens pressed once does not depend on
-- the stress; it rises with the number N of events, and five trials of one specimen agree within 20 %.
-- Here: the rise with N is found IF SUMMITS STAY ELASTIC ON QUARTZ, and only then. Friction is alpha + tau0 A/F,
-- and what is predicted is A/F, real area over load, from an elastic solve at 3 MPa. Its spots carry, over N = 1 and
-- 8, a mean pressure of 2.3 H (self-affine) and 3.0 H (bead-blasted), 6.4 and 8.5 H at the highest node, and 90 % of
-- the load stands on nodes above the hardness H that capped the presses. With that cap on the quartz too, which is the
-- ordinary assumption and the rule of every other script here, area is F/H whatever the surface and the rise is gone:
-- 1.06 and 1.07; at 3 H 1.32 and 1.29 are left of it. Elastic, over 8 pairs, A/F rises from one event to eight by a
-- factor 1.49 +- 0.41 and 1.58 +- 0.25 (scatter of single pairs). The program prints both, and the pressures in H.
-- Stress: not flat. From 20 to 204 MPa A/F rises by 10 to 20 %: 1.19 and 1.16 over 24 pairs (standard errors 0.04 and
-- 0.03), 1.17 and 1.17 over the 48 after them (0.03). Means of 8 pairs run from 1.08 to 1.36, so 24 are asked for a band;
-- of friction that is within the paper's 20 %.
-- Control: had yielding cut the summits to one plane, taking the same volumes, area would rise tenfold with stress.
-- Compared are directions; no measured value of the paper is. Bands are those of this project's own prototype.
-- Not predicted: mu itself. tau0 = 500 MPa and alpha = 0.2 are illustrative, effective numbers, calibrated
-- by whoever uses them; only ratios of A/F are predictions. Trials on a flat differ by `scatter` alone,
-- which is entered and not predicted; the scatter over pairs is. At 256 cells only 69 to 122 nodes touch
-- the quartz, in the mean over pairs.

local lab = require "asperity"
local arguments = require "asperity.arguments"
local laboratory = require "asperity.laboratory"
local paper = require "asperity.paper"
local MPa = lab.units.MPa

local options = arguments({ pairs = 8, cells = 256, tau = 500e6, alpha = 0.2, scatter = 0.1, first = 1 }, ...)
local cells = options.cells
local enough = options.pairs >= 8 -- bands of means are asked of no fewer
local law = lab.friction{ tau0 = options.tau, alpha = options.alpha }

-- 1. The lower specimen of every pair in every state, on flat quartz and on the tilt stage, five trials each:
--    friction, and real area per load. Then the controls: spots that yield on the quartz, and a plane cut.
local pairs_of = paper.count(options.pairs)
for k = 1, #pairs_of do pairs_of[k] = options.first + k - 1 end
local found = lab.ensemble{
  over = { kind = laboratory.kinds, pair = pairs_of },
  run = function(case)
    local laboratory = require "asperity.laboratory"
    local lower, upper = laboratory.specimens{ kind = case.kind, pair = case.pair, cells = cells }
    local function tilted(surfaces, seed)
      local rows = {}
      for k, surface in ipairs(surfaces) do
        local stage = lab.tilt_stage{
          contact = laboratory.on_quartz(surface), friction = law, mass = "4.3 g",
          specimen_area = math.pi * 0.0125 ^ 2, probe_pressure = laboratory.probe, scatter = options.scatter,
        }
        local t = stage:raise{ repeats = 5, seed = seed + k }
        rows[k] = { mu = t.mu, spread = t.spread, area_per_load = t.area_per_load }
      end
      return rows
    end
    local function rise(first, last, hardness)
      return laboratory.area_per_load(last, hardness) / laboratory.area_per_load(first, hardness)
    end
    local pressed = laboratory.after_stress(lower, upper)
    local turned = laboratory.after_events(lower, upper, { seed = case.pair })
    local by_stress, by_N = tilted(pressed, 1000 * case.pair), tilted(turned, 1000 * case.pair + 100)
    local H = lower.material.hardness
    local mean_1, peak_1, above_1, nodes_1 = laboratory.over_hardness(turned[1])
    local mean_8, peak_8, above_8, nodes_8 = laboratory.over_hardness(turned[8])
    return {
      mean_over_H = (mean_1 + mean_8) / 2, peak_over_H = (peak_1 + peak_8) / 2,
      load_above_H = (above_1 + above_8) / 2, nodes_1 = nodes_1, nodes_8 = nodes_8,
      by_stress = by_stress, by_N = by_N,
      stress = by_stress[6].area_per_load / by_stress[1].area_per_load,
      N = by_N[8].area_per_load / by_N[1].area_per_load,
      N_at_H = rise(turned[1], turned[8], H), N_at_3H = rise(turned[1], turned[8], 3 * H),
      plane = rise(laboratory.cut_to_a_plane(lower, upper, laboratory.stresses[1]),
        laboratory.cut_to_a_plane(lower, upper, laboratory.stresses[6])),
    }
  end,
}

-- 2. A row for every specimen and state, and the means of the ratios.
local stresses, events, means = lab.notebook "stress", lab.notebook "events", lab.notebook "means"
stresses:units{ stress = "Pa", area_per_load = "1/Pa" }
events:units{ area_per_load = "1/Pa" }
for _, case in ipairs(found) do
  for k, row in ipairs(case.by_stress) do
    row.kind, row.pair, row.stress = case.kind, case.pair, laboratory.stresses[k]
    stresses:write(row)
  end
  for N, row in ipairs(case.by_N) do
    row.kind, row.pair, row.N = case.kind, case.pair, N
    events:write(row)
  end
end

-- 3. What a reader checks: means over specimens.
print(("Fig. 7: lower specimens of %d pairs of each kind on flat quartz, tau0 = %.0f MPa, alpha = %g"):format(
  options.pairs, options.tau / MPa, options.alpha))
for _, mean in ipairs(paper.means(found, { "kind" })) do
  local by_stress = paper.means(paper.where(stresses:rows(), { kind = mean.kind }), { "stress" })
  local by_N = paper.means(paper.where(events:rows(), { kind = mean.kind }), { "N" })
  print("\n" .. mean.kind)
  print(laboratory.across("one event at (MPa)", by_stress, "stress", MPa, 2))
  print(laboratory.across("  A/F (1/GPa)", by_stress, "area_per_load", 1e-9, 3))
  print(laboratory.across("  mu", by_stress, "mu", 1, 3))
  print(laboratory.across("events at 152.78 MPa", by_N, "N", 1, 0))
  print(laboratory.across("  A/F (1/GPa)", by_N, "area_per_load", 1e-9, 3))
  print(laboratory.across("  mu", by_N, "mu", 1, 3))
  print(laboratory.across("  of five trials +-", by_N, "spread", 1, 3))
  print "  ratios of A/F:"
  for _, line in ipairs{
    { "stress", "203.72 / 20.37 MPa" }, { "N", "eight events / one, spots on quartz stay elastic" },
    { "N_at_3H", "eight events / one, spots on quartz yield at 3 H" },
    { "N_at_H", "eight events / one, spots on quartz yield at H" },
    { "plane", "203.72 / 20.37 MPa, the same volumes cut off by a plane" },
  } do
    print(("    %-56s %s"):format(line[2], laboratory.with_scatter(mean, line[1])))
  end
  print(("  elastic spots on quartz carry %.1f H in the mean and %.1f H at the highest node (N = 1 and 8)"):format(
    mean.mean_over_H, mean.peak_over_H))
  print(("  %.0f %% of the load stands on nodes above H; %.0f nodes touch at N = 1, %.0f at N = 8"):format(
    100 * mean.load_above_H, mean.nodes_1, mean.nodes_8))
  mean.mu_stress, mean.mu_N = by_stress[6].mu / by_stress[1].mu, by_N[8].mu / by_N[1].mu
  print(("  mu: 203.72 / 20.37 MPa %.2f, eight events / one %.2f"):format(mean.mu_stress, mean.mu_N))
  means:write(mean)
end

-- 4. What must hold, of means over specimens: single ones scatter too much to be asked.
for _, mean in ipairs(means:rows()) do
  local where = { kind = mean.kind }
  means:expect("N", { where = where, at_least = mean.stress,
    label = "elastic spots, A/F: eight events above ten times the stress" })
  means:expect("mu_N", { where = where, at_least = 1.1, label = "elastic spots: friction rises with N" })
  means:expect("mean_over_H", { where = where, at_least = 1.2,
    label = "but they carry more than the hardness that capped the presses" })
  if enough then
    means:expect("N", { where = where, at_least = 1.3, label = "A/F, N = 8 / N = 1" })
    means:expect("mu_stress", { where = where, at_least = 0.8, at_most = 1.2,
      label = "friction against stress stays within the paper's own 20 %" })
    means:expect("N_at_3H", { where = where, at_least = 1.2, label = "A/F, N = 8 / N = 1, spots at 3 H" })
  end
  if options.pairs >= 24 then
    means:expect("stress", { where = where, at_least = 0.9, at_most = 1.4,
      label = ("A/F, 203.72/20.37, mean of %d pairs"):format(options.pairs) })
  end
  means:expect("N_at_H", { where = where, at_least = 1.2, should_fail = true,
    label = "spots that yield at H, as in the presses: no rise of A/F with N" })
  means:expect("plane", { where = where, at_least = 0.9, at_most = 1.4, should_fail = true,
    label = "control: A/F, 203.72/20.37, cut by a plane" })
end

-- 5. The figure.
stresses:chart{
  x = "stress", y = "mu", one_line_per = "kind", spread = true, file = "fig7_stress.svg",
  title = "Friction on quartz after one event", x_label = "stress of the event", y_label = "μ",
}
events:chart{
  x = "N", y = "mu", one_line_per = "kind", spread = true, file = "fig7_events.svg",
  title = "Friction on quartz after events", x_label = "number of events N at 152.78 MPa", y_label = "μ",
}
print "\nDrawn: fig7_stress.svg, fig7_events.svg."

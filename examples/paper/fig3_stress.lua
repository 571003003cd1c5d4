-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 3: how much smoother does one loading event make two rough specimens, and does its stress matter?
--
--   asperity run examples/paper/fig3_stress.lua
--   asperity run examples/paper/fig3_stress.lua -- pairs=2
--   asperity run examples/paper/fig3_stress.lua -- pairs=8 cells=512
--
-- The paper: Ra and amplitude of blasted aluminium discs, pressed in pairs for ten minutes, fall as the
-- stress of the one event rises from 20 to 204 MPa.
-- Here: so they do, Ra for every one of 8 pairs of each kind, the amplitude in the mean. Ra at 204 MPa is
-- 0.946 +- 0.007 of that at 20 MPa for self-affine specimens, 0.944 +- 0.005 for bead-blasted ones; the
-- amplitude 0.940 and 0.959, since the highest summit of a specimen need not have met the other. Five
-- stylus traces say the same of Ra with more scatter: 0.943 +- 0.019 and 0.941 +- 0.015. An event of 204
-- MPa takes 6 % of the virgin Ra. The control: specimens that do not yield come back as they were.
-- Compared are directions: no measured value of the paper is. The bands asked below are those of this project's own
-- prototype.
-- Not predicted: absolute Ra (the virgin one is given, 3 um) and anything that a disc does beyond one tile
-- of a millimetre. What yields is taken away, not piled up beside. Hardness is that of ten minutes.

local lab = require "asperity"
local arguments = require "asperity.arguments"
local laboratory = require "asperity.laboratory"
local paper = require "asperity.paper"
local um, MPa = lab.units.um, lab.units.MPa

local options = arguments({ pairs = 8, cells = 256 }, ...)
local cells = options.cells
local enough = options.pairs >= 8 -- a trend of means is asked of no fewer

-- 1. Every pair under each of the six stresses, each time from the same virgin pair. Measured twice: over
--    the whole map, and as the paper did, with a stylus along five lines. What is left, 203.72 / 20.37 MPa.
local found = lab.ensemble{
  over = { kind = laboratory.kinds, pair = paper.count(options.pairs) },
  run = function(case)
    local laboratory = require "asperity.laboratory"
    local lower, upper = laboratory.specimens{ kind = case.kind, pair = case.pair, cells = cells }
    local rows = {}
    for k, surface in ipairs(laboratory.after_stress(lower, upper)) do
      rows[k] = laboratory.roughness(surface, case.pair)
    end
    -- The control: specimens that do not yield.
    local elastic = lab.contact{
      lower = lower, upper = upper, boundary = "periodic", effects = { elasticity = "half_space" },
    }
    elastic:press{ pressure = laboratory.stresses[6] }
    elastic:release()

    local result, virgin = laboratory.left(rows), lower:roughness().Ra
    result.rows = rows
    result.lost, result.lost_elastic = 1 - rows[6].Ra / virgin, 1 - elastic:lower():roughness().Ra / virgin
    return result
  end,
}

-- 2. A row for every specimen and stress, and a row of ratios for every specimen.
local book, ratios, means = lab.notebook "stress", lab.notebook "ratios", lab.notebook "means"
book:units{ stress = "Pa", Ra = "m", amplitude = "m", traced_Ra = "m", traced_amplitude = "m" }
for _, case in ipairs(found) do
  for k, row in ipairs(case.rows) do
    row.kind, row.pair, row.stress = case.kind, case.pair, laboratory.stresses[k]
    book:write(row)
  end
  case.rows = nil
  ratios:write(case)
end

-- 3. What a reader checks: means over specimens, and how far one event goes.
print(("Fig. 3: one event at each stress, lower specimens of %d pairs of each kind"):format(
  options.pairs))
for _, mean in ipairs(paper.means(ratios:rows(), { "kind" })) do
  print(("\n%s, micrometres   over the map         by the stylus"):format(mean.kind))
  print "  stress (MPa)      Ra     amplitude      Ra     amplitude"
  for _, row in ipairs(paper.means(paper.where(book:rows(), { kind = mean.kind }), { "stress" })) do
    print(("     %6.2f        %.3f     %6.2f      %.3f     %6.2f"):format(row.stress / MPa, row.Ra / um,
      row.amplitude / um, row.traced_Ra / um, row.traced_amplitude / um))
  end
  print(("  203.72/20.37 MPa, map:    Ra %s, amplitude %s"):format(
    laboratory.with_scatter(mean, "Ra"), laboratory.with_scatter(mean, "amplitude")))
  print(("  203.72/20.37 MPa, stylus: Ra %s, amplitude %s"):format(
    laboratory.with_scatter(mean, "traced_Ra"), laboratory.with_scatter(mean, "traced_amplitude")))
  print(("  an event of 203.72 MPa takes %.1f %% of the virgin Ra; without yielding, %.1g %%"):format(
    100 * mean.lost, 100 * math.abs(mean.lost_elastic)))
  means:write(mean)
end

-- 4. What must hold: of every pair, and of the means.
for _, kind in ipairs(laboratory.kinds) do
  for pair = 1, options.pairs do
    book:expect("Ra", { where = { kind = kind, pair = pair }, decreasing_in = "stress" })
    book:expect("traced_Ra", { where = { kind = kind, pair = pair }, decreasing_in = "stress" })
  end
  if enough then book:expect("amplitude", { where = { kind = kind }, decreasing_in = "stress" }) end
  means:expect("Ra", { where = { kind = kind }, at_least = 0.92, at_most = 0.97, label = "Ra 203.72/20.37" })
  means:expect("amplitude", { where = { kind = kind }, at_most = 1, label = "amplitude 203.72/20.37" })
end
ratios:expect("lost_elastic", { at_least = 0.01, should_fail = true,
  label = "control: specimens that do not yield lose their Ra" })

-- 5. The figure.
book:chart{
  x = "stress", y = "Ra", one_line_per = "kind", spread = true, file = "fig3_Ra.svg",
  title = "Roughness after one event", x_label = "stress of the event", y_label = "Ra",
}
book:chart{
  x = "stress", y = "traced_amplitude", one_line_per = "kind", spread = true, file = "fig3_amplitude.svg",
  title = "Amplitude of stylus traces after one event", x_label = "stress of the event",
  y_label = "amplitude",
}
print "\nDrawn: fig3_Ra.svg, fig3_amplitude.svg."

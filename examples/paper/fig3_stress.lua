-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 3: how much smoother does one loading event make two rough specimens, and does its stress matter?
--
--   asperity run examples/paper/fig3_stress.lua
--
-- Ra falls with stress for every one of 8 pairs of each kind, and an event of 204 MPa reduces the
-- virgin Ra by 6 %. The amplitude falls in the mean, because the highest summit need not touch.
-- Specimens that do not yield (control) do not change.

local lab = require "asperity"
local laboratory = require "asperity.laboratory"
local paper = require "asperity.paper"

local options = require "asperity.arguments"({ pairs = 8, cells = 256 }, ...)

-- 1. Every pair under each of the six stresses, from the same virgin pair. Measured over the whole
--    map, and like the paper with a stylus along five lines. The control: specimens that do not
--    yield, at the highest stress. Yielded material is removed, not piled up. The hardness holds
--    for a dwell of ten minutes.
local least, most = laboratory.stresses[1], laboratory.stresses[6] -- 20.37 and 203.72 MPa
local function pressed(contact, stress)
  contact:press{ pressure = stress }
  contact:release()
  return contact:lower()
end
local rows = lab.ensemble{ over = { kind = laboratory.kinds, pair = paper.count(options.pairs),
    stress = laboratory.stresses },
  run = function(case)
    local lower, upper = laboratory.specimens{ kind = case.kind, pair = case.pair, cells = options.cells }
    local after, virgin = pressed(laboratory.bench(lower, upper), case.stress), lower:roughness().Ra
    local row = laboratory.roughness(after, case.pair)
    row.lost = 1 - after:roughness().Ra / virgin
    if case.stress == most then
      local elastic = lab.contact{ lower = lower, upper = upper, boundary = "periodic",
        effects = { elasticity = "half_space" } }
      row.lost_if_elastic = 1 - pressed(elastic, most):roughness().Ra / virgin
    end
    return row
  end }

-- 2. The ratios 203.72 / 20.37 MPa of every specimen, and their means.
local ratios = laboratory.left(rows, "stress", least, most, { "kind", "pair" })
local means = paper.means(ratios, { "kind" }, "means.csv")
rows:write "stress.csv"
ratios:write "ratios.csv"

-- 3. The tables: means over specimens, and the effect of one event.
lab.say("Fig. 3: one event at each stress, lower specimens of %d pairs of each kind", options.pairs)
print "Over the map, and by the stylus (traced):"
paper.means(rows, { "kind", "stress" }):show{ "kind", "stress [MPa]", "Ra [um]", "amplitude [um]",
  "traced_Ra [um]", "traced_amplitude [um]", digits = 5 }
print "Ratios 203.72 / 20.37 MPa, and their scatter over the pairs (sd):"
means:show{ "kind", "Ra", "Ra_sd", "amplitude", "amplitude_sd", "traced_Ra", "traced_Ra_sd",
  "traced_amplitude", "traced_amplitude_sd", digits = 3 }
print "Share of the virgin Ra that an event of 203.72 MPa takes, with and without yielding:"
means:show{ "kind", "lost [%]", "lost_if_elastic [%]", digits = 2 }

-- 4. Expectations for every pair and for the means.
for _, kind in ipairs(laboratory.kinds) do
  for pair = 1, options.pairs do
    rows:expect("Ra", { where = { kind = kind, pair = pair }, decreasing_in = "stress" })
    rows:expect("traced_Ra", { where = { kind = kind, pair = pair }, decreasing_in = "stress" })
  end
  if options.pairs >= 8 then
    rows:expect("amplitude", { where = { kind = kind }, decreasing_in = "stress" })
  end
end
means:expect("Ra", { at_least = 0.92, at_most = 0.97, label = "Ra 203.72/20.37" })
means:expect("amplitude", { at_most = 1, label = "amplitude 203.72/20.37" })
ratios:expect("lost_if_elastic", { at_least = 0.01, should_fail = true,
  label = "control: specimens that do not yield lose their Ra" })

-- 5. The charts.
rows:chart{ x = "stress [MPa]", y = "Ra [um]", one_line_per = "kind", spread = true,
  file = "fig3_Ra.svg", title = "Roughness after one event" }
rows:chart{ x = "stress [MPa]", y = "traced_amplitude [um]", one_line_per = "kind", spread = true,
  file = "fig3_amplitude.svg", title = "Amplitude of stylus traces after one event" }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Fig. 4: what do repeated events at one stress do to two rough specimens that are turned between them?
--
--   asperity run examples/paper/fig4_events.lua
--
-- Ra falls for every one of 8 pairs of each kind. Eight events reduce the virgin Ra by 23 and 24 %,
-- one event of 204 MPa by 6 %. The turns are the cause: without turns (control), events two to
-- eight change nothing.

local lab = require "asperity"
local laboratory = require "asperity.laboratory"
local paper = require "asperity.paper"

local options = require "asperity.arguments"({ pairs = 8, cells = 256, events = 8 }, ...)
local cells, events = options.cells, options.events

-- 1. Every pair through the events at 152.78 MPa, turned before each event but the first, or
--    without turns as a control. For comparison, one event of 203.72 MPa on the virgin pair. A
--    turned disc touches fresh ground away from its axis. A quarter turn and a shift by whole
--    cells, drawn from a seed, represent this on a periodic tile. The paper names hardening; its
--    strength is unknown, so `plasticity={ hardening= }` is not used.
local found = lab.ensemble{ over = { kind = laboratory.kinds, pair = paper.count(options.pairs),
    handling = { "turned", "left lying" } },
  run = function(case)
    local lower, upper = laboratory.specimens{ kind = case.kind, pair = case.pair, cells = cells }
    local after = laboratory.after_events(lower, upper, { events = events, seed = case.pair,
      turning = case.handling == "turned" })
    local heaviest = laboratory.bench(lower, upper)
    heaviest:press{ pressure = laboratory.stresses[6] }
    heaviest:release()

    local states, virgin = {}, lower:roughness().Ra
    for N, surface in ipairs(after) do
      states[N] = laboratory.roughness(surface, case.pair)
      states[N].N = N
    end
    return { states = states, lost = 1 - after[events]:roughness().Ra / virgin,
      lost_once = 1 - heaviest:lower():roughness().Ra / virgin }
  end }

-- 2. One row per specimen, handling and event, and the ratios of the last event to the first.
local rows = paper.unfolded(found, "states", "events.csv")
local ratios = laboratory.left(rows, "N", 1, events, { "kind", "handling", "pair" })
local means = paper.means(ratios, { "kind", "handling" })
  :with{ times_one_event = function(row) return row.lost / row.lost_once end }
ratios:write "ratios.csv"
means:write "means.csv"

-- 3. The tables: means over specimens.
lab.say("Fig. 4: events of 152.78 MPa, lower specimens of %d pairs of each kind", options.pairs)
print "Turned between events, over the map and by the stylus (traced):"
paper.means(rows:where{ handling = "turned" }, { "kind", "N" }):show{ "kind", "N", "Ra [um]",
  "amplitude [um]", "traced_Ra [um]", "traced_amplitude [um]", digits = 4 }
print "Last event / first event, and the scatter over the pairs (sd):"
means:show{ "kind", "handling", "Ra", "Ra_sd", "amplitude", "amplitude_sd", "traced_Ra",
  "traced_Ra_sd", "traced_amplitude", "traced_amplitude_sd", digits = 3 }
lab.say("Share of the virgin Ra that %d events take, and one event of 203.72 MPa:", events)
means:show{ "kind", "handling", "lost [%]", "lost_once [%]", digits = 3 }

-- 4. Expectations for every pair and for the means. Without turns the expectations of the means
--    must fail.
for _, kind in ipairs(laboratory.kinds) do
  for pair = 1, options.pairs do
    local where = { kind = kind, pair = pair, handling = "turned" }
    rows:expect("Ra", { where = where, decreasing_in = "N" })
    rows:expect("traced_Ra", { where = where, decreasing_in = "N" })
  end
  for _, handling in ipairs(events == 8 and { "turned", "left lying" } or {}) do
    local where, control = { kind = kind, handling = handling }, handling ~= "turned"
    means:expect("Ra", { where = where, at_least = 0.77, at_most = 0.83, should_fail = control })
    means:expect("amplitude", { where = where, at_least = 0.7, at_most = 0.85, should_fail = control })
    means:expect("times_one_event", { where = where, at_least = 3, should_fail = control,
      label = handling .. ": Ra lost in 8 events over Ra lost at 203.72 MPa" })
  end
end

-- 5. The charts.
for _, kind in ipairs(laboratory.kinds) do
  rows:chart{ x = "N", y = "Ra [um]", one_line_per = "handling", spread = true,
    where = { kind = kind }, file = "fig4_Ra_" .. kind .. ".svg",
    title = "Roughness after N events at 152.78 MPa, " .. kind }
end
rows:chart{ x = "N", y = "traced_amplitude [um]", one_line_per = "kind", spread = true,
  where = { handling = "turned" }, file = "fig4_amplitude.svg",
  title = "Amplitude of stylus traces after N events at 152.78 MPa" }

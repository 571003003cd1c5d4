-- SPDX-License-Identifier: GPL-3.0-or-later
-- Eight events: two specimens of 1024 x 1024 cells, pressed eight times at 152.78 MPa and placed anew
-- between, with five stylus traces, roughness and profile dimension after each.
--
--   asperity run bench/eight_events.lua
--   asperity run bench/eight_events.lua -- cells=512 events=4
local lab = require "asperity"
local laboratory = require "asperity.laboratory"
local options = require "asperity.arguments"({ cells = 1024, events = 8 }, ...)

local begun = os.time()
local lower, upper = laboratory.specimens{ kind = "self-affine", pair = 1, cells = options.cells }
local stylus = lab.stylus{ tip = "2 um", spacing = "0.25 um", length = "2 mm" }
local bench = laboratory.bench(lower, upper)
local book = lab.notebook "events"
print "event  pairs   press    grids   Ra of map   Ra of traces   D - 1 of map   yielded"
for N = 1, options.events do
  if N > 1 then bench:place{ seed = N } end
  local st = bench:press(laboratory.event)
  bench:release()
  local worn, traces = bench:lower(), 0
  for _, trace in ipairs(stylus:scan(worn, { count = 5, seed = N })) do
    traces = traces + trace:levelled():roughness().Ra / 5
  end
  local row = {
    N = N, pairs = st.cost.transforms / 2, seconds = st.cost.seconds,
    grids = st.cost.bytes / (8 * options.cells ^ 2), ["Ra [m]"] = worn:roughness().Ra,
    ["trace_Ra [m]"] = traces, excess = laboratory.excess(worn), plastic = st.plastic_fraction,
  }
  book:write(row)
  print(("%5d  %5.1f  %5.2f s  %6.1f  %7.3f um  %10.3f um  %13.5f  %5.1f %%"):format(N, row.pairs, row.seconds,
    row.grids, row["Ra [m]"] / lab.units.um, traces / lab.units.um, row.excess, 100 * row.plastic))
end
print(("%d events in about %d s in all"):format(options.events, os.time() - begun))

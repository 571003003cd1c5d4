-- SPDX-License-Identifier: GPL-3.0-or-later
-- Draws and replays the events of a press log: `asperity press-log FILE` runs this script. Arguments: log, area,
-- skip, columns ("load=Kraft,time=Zeit"), turn_step, specimen (a script), cells, seed, and other keys of
-- lab.protocol.read with a number, a quantity or a word.
local lab = require "asperity"
local um, MPa, deg = lab.units.um, lab.units.MPa, lab.units.deg

local options = require "asperity.arguments"({
  log = "", area = "", skip = 0, columns = "", turn_step = "", specimen = "", cells = 128, seed = 1,
  events = "", noise = "", zero = "", zero_drift = "", same_load = "", shortest_hold = "", evidence = "",
  overshoot = "", least_overshoot = "", least_turn = "", equal_times = "", dates = "", decimal = "",
  thousands = "", separator = "",
}, ...)

-- 1. The events.
local keys = {}
for name, value in lab.sorted(options) do
  if value ~= "" then keys[name] = tonumber(value) or value end
end
for _, name in ipairs{ "log", "specimen", "cells", "seed", "columns" } do keys[name] = nil end
if options.skip == 0 then keys.skip = nil end
if options.columns ~= "" then
  keys.columns = {}
  for pair in options.columns:gmatch "[^,]+" do
    local name, head = pair:match "^%s*([^=]-)%s*=%s*(.-)%s*$"
    if not name then
      error("`columns` is `" .. options.columns .. "`; give names with titles, as in load=Standardkraft,time=Prüfzeit", 0)
    end
    keys.columns[name] = head
  end
end
local p = lab.protocol.read(options.log, keys)
print(p)
if p.recording then
  print "\n  stretch      from [s]     to [s]   load         lines"
  for _, span in ipairs(p.recording.spans) do
    local load = span.kind == "turn" and ("%.4g deg"):format(span.angle / deg)
      or options.area ~= "" and ("%.4g MPa"):format(span.load / MPa) or ("%.5g"):format(span.load)
    if span.kind ~= "rest" then
      print(("  %-8s %12.6g %10.6g   %-10s   %d to %d"):format(span.kind, span.begin, span["end"], load,
        span.first_line, span.last_line))
    end
  end
end
p:chart("press_log.svg", { title = options.log:match "[^/]*$" })
print "\nDrawn: press_log.svg. Look at it before you believe the numbers."

-- 2. The bodies.
local free = false
for _, event in ipairs(p:events()) do
  if event.load and options.area == "" and options.specimen == "" then
    error("`" .. options.log .. "` records loads, not pressures; give the area of the specimen that was pressed, as in "
      .. "--area \"490 mm^2\"", 0)
  end
  local quarters = event.angle and event.angle / (90 * deg) or 0
  free = free or math.abs(quarters - math.floor(quarters + 0.5)) > 1e-9
end
local function rough_pair()
  local aluminium = lab.material "Al-2011"
  local function face(seed)
    return lab.surface.self_affine{ cells = options.cells, size = "1 mm", hurst = 0.8, ra = "3 um",
      roll_off = "250 um", short_wave = 4 / options.cells .. " mm", seed = seed, material = aluminium }
  end
  return lab.contact{ lower = face(2 * options.seed - 1), upper = face(2 * options.seed),
    boundary = free and "free" or "periodic",
    effects = { elasticity = "half_space", plasticity = {}, creep = {} } }
end
local bench = options.specimen == "" and rough_pair() or dofile(options.specimen)
if type(bench) == "function" then bench = bench(p) end

-- 3. The replay.
local before = bench:lower():roughness().Ra
local book, pressed = lab.notebook "events", 0
print "\n  event                            yielded    touching"
for event, st in p:on(bench) do
  if st then
    pressed = pressed + 1
    book:write{ press = pressed, ["pressure [Pa]"] = st.pressure, ["dwell [s]"] = event.dwell or 0,
      area = st.area_fraction }
    local yielded, share = pcall(function() return st.plastic_fraction end)
    print(("  %-32s %7s    %.4f"):format(event.text, yielded and ("%.2f %%"):format(100 * share) or "-", st.area_fraction))
  elseif event.kind == "rotate" then
    print(("  turned by %.4g deg"):format(event.angle / deg))
  end
end
print(("\nRa of the lower body: %.3f um, before the first press %.3f um"):format(bench:lower():roughness().Ra / um,
  before / um))
bench:log "done.csv"
print "Written: done.csv, with the result of each press; lab.protocol.read reads it back."

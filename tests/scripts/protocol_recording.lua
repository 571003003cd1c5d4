-- SPDX-License-Identifier: GPL-3.0-or-later
-- A recorded press log becomes a protocol, is drawn, run, logged, and read again as the same protocol.
--! output: as recorded
--! error: looks like a recording, so its events are detected
--! not error: result pressure
--! file: done.csv: time [s], rotation [deg], load [N], dwell [min], result pressure [Pa], result approach [m]
--! file: chart.svg: hold 100 N, 39.5 s
--! file: manifest.json: recorded.csv
--! file: journal.jsonl: "event":"chart","protocol":
local lab = require "asperity"
local MPa = lab.units.MPa

-- 20 s without load, a hold of 40 s, a quarter turn, a hold of 30 s; on a load cell with an offset of 3 N.
local function write(name, titles, scale)
  local file = assert(io.open(name, "w"))
  file:write(titles, "\n")
  local k, angle = 0, 0
  local function put(seconds, load)
    for _ = 1, 2 * seconds do
      local noise = 0.2 * ((k * 7919) % 13 / 6 - 1)
      file:write(("%.1f,%.4f,%d\n"):format(k / 2, scale * (load + 3 + noise), angle))
      k = k + 1
    end
  end
  put(20, 0) put(40, 100) put(10, 0)
  angle = 90
  put(10, 0) put(30, 60) put(10, 0)
  file:close()
end
write("recorded.csv", "time [s],load [N],angle [deg]", 1)
local p = lab.protocol.read "recorded.csv"
local kinds = {}
for _, event in ipairs(p:events()) do kinds[#kinds + 1] = event.kind end
assert(table.concat(kinds, " ") == "press release rotate press release", tostring(p))
local first, turn, second = p:events()[1], p:events()[3], p:events()[4]
assert(math.abs(first.load - 100) < 0.2 and math.abs(first.dwell - 40) <= 1 and math.abs(first.time - 20) <= 1)
assert(math.abs(turn.angle - math.pi / 2) < 1e-9)
assert(math.abs(second.load - 60) < 0.2 and math.abs(second.dwell - 30) <= 1)
assert(tostring(p):find "recorded.csv lines %d+ to %d+")
assert(tostring(p):find("2 holds, 0 peaks, 2 releases, 1 turn", 1, true))

-- The events found, and the thresholds.
local r = p.recording
assert(r.samples == 240 and r.missing == 0 and math.abs(r.zero_low - 3) < 0.1 and r.interval == 0.5)
assert(r.spans[1].kind == "rest" and r.spans[2].kind == "rise" and r.spans[3].kind == "hold")
assert(r.spans[3].load_error > 0 and r.spans[3].load_error < 0.1)
assert(lab.protocol{ { release=true } }.recording == nil)

-- Options, and a table of events with its usual meaning.
local pressures = lab.protocol.read("recorded.csv", { area="2 mm^2" })
assert(math.abs(pressures:events()[1].pressure - 50 * MPa) < 0.1 * MPa)
local rows = lab.protocol.read("recorded.csv", { events="rows" })
assert(#rows > 200)
local plain = lab.protocol.read("recorded.csv", { events="detect", zero="2.5 N", noise="0.2 N", turn_step="90 deg" })
assert(math.abs(plain:events()[1].load - 100.5) < 0.2)
local with = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").with
local function refused(options, text) with(text, lab.protocol.read, "recorded.csv", options) end
refused({ events="rows", noise="1 N" }, "with events=\"rows\" nothing is detected, so only `events` may be given")
refused({ noise="1 MPa" }, "`noise` is a pressure, and \"recorded.csv\" records a force")
refused({ events="detct" }, "did you mean `detect`?")
refused({ zero_drft=0.1 }, "did you mean `zero_drift`?")
refused({ turn_step="60 deg" }, "which is no multiple of 60 deg")
refused({ zero="1 um" }, "`zero` is a length; give a load such as \"2 N\"")

-- Drawn, done, logged, read again.
p:chart("chart.svg", { title="what the press did" })
local s = lab.surface.sine{ cells=16, size="1 mm", amplitude="1 um", material=lab.material "Al-2011" }
local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
for _ in p:on(c) do end
c:log "done.csv"
local again = lab.protocol.read "done.csv"
assert(again == p and again.recording == nil)

-- By hand, and nothing.
local fresh = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
local ok, message = pcall(fresh.log, fresh, "none.csv")
assert(not ok and message:find("nothing was done to this contact yet", 1, true), message)
fresh:press{ load="5 N" }
fresh:rotate "90 deg"
fresh:press{ approach="0.1 um" }
local by_hand = lab.protocol.read(fresh:log "by_hand.csv")
assert(#by_hand == 4 and by_hand:events()[2].kind == "release" and by_hand:events()[4].pressure > 0)
lab.protocol{ { press={ load="5 N", dwell="1 min" } }, { release=true } }:chart "without_record.png"
print "as recorded"

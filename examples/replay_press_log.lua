-- SPDX-License-Identifier: GPL-3.0-or-later
-- What did the press do, and what did it do to the surfaces? Replays a recorded press log.
--
--   asperity run examples/replay_press_log.lua
--
-- The script finds the events of a recorded press (rise, hold, peak, release, turn), draws them
-- over the record, and replays them on a pair of rough faces. The heaviest press, 204 MPa, has 19 %
-- of the area in contact. Ra of the lower face falls from 3.00 to 2.71 um.

local lab = require "asperity"
local recording = ((arg and arg[0] or ""):match "^(.*)/" or ".") .. "/data/press_recording.csv"
local options = require "asperity.arguments"({ log = recording, area = "490.87 mm^2",
  turn_step = "90 deg", overshoot = "press", cells = 128, seed = 1 }, ...)
local own = options.log == recording

-- 1. The events of the record: time, load and angle, with noise, a drifting zero, uneven time steps
--    and missing cells. The load is the load of the whole disc; `area` gives the mean pressure of a
--    tile. An overshoot is a separate press, because flattening depends on the highest load. The
--    record data/press_recording.csv is SYNTHETIC: data/make_press_recording.lua made it, with its
--    noise. For your own: -- log=my_log.csv area="490.87 mm^2" turn_step="90 deg"
local p = lab.protocol.read(options.log, { events = "detect", area = options.area,
  turn_step = options.turn_step, overshoot = options.overshoot })
print(p)

-- 2. A chart to look at before the replay.
p:chart("press_log.svg", { title = "What the press did" .. (own and " (synthetic record)" or "") })

-- 3. The replay on a pair of rough faces. Creep depends on the dwell.
local function face(seed)
  return lab.surface.self_affine{ cells = options.cells, size = "1 mm", hurst = 0.8, ra = "3 um",
    roll_off = "250 um", short_wave = "32 um", seed = seed, material = lab.material "Al-2011" }
end
local lower, upper = face(2 * options.seed - 1), face(2 * options.seed)
local bench = lab.contact{ lower = lower, upper = upper, boundary = "periodic",
  effects = { elasticity = "half_space", plasticity = {}, creep = {} } }
local book = lab.notebook("events", { units = { pressure = "MPa", dwell = "s", taken = "um^3" } })
for event, st in p:on(bench) do
  if st then
    book:write{ press = #book + 1, event = event.text, pressure = st.pressure, dwell = event.dwell,
      taken = st.plastic_volume, area = st.area_fraction, ["yielded [%]"] = 100 * st.plastic_fraction }
  end
end
print "\nThe presses: yielded now, volume taken, touching"
book:show{ "event", "yielded [%]", "taken [um^3]", "area", digits = 4 }
local Ra, virgin_Ra = bench:lower():roughness().Ra, lower:roughness().Ra
lab.say("\nRa of the lower face: %.3f [um], before the first press %.3f [um]", Ra, virgin_Ra)

-- 4. The replay as a log. It reads back as the same protocol.
bench:log "done.csv"
local again = lab.protocol.read "done.csv"
print("Written: done.csv, with what each press measured. It reads back as "
  .. (again == p and "the same protocol." or "ANOTHER PROTOCOL."))

-- 5. Expectations.
local same = lab.notebook "replay"
same:write{ same = again == p and 1 or 0, worn = Ra / virgin_Ra }
same:expect("same", { at_least = 1, label = "the log of the run reads back as the protocol" })
same:expect("worn", { at_most = 1, label = "the faces have worn" })
if own and options.overshoot == "press" then
  -- Contents of the synthetic record: 10, 75 and 60, 100 kN on a disc of 25 mm, an overshoot of
  -- 6 %. Each press has its pressure in MPa and its dwell in s.
  for k, wanted in ipairs{ { 20.37, 300 }, { 1.06 * 152.79 }, { 152.79, 600 }, { 122.23, 120 },
    { 203.72, 600 } } do
    local pressure, dwell, where = wanted[1], wanted[2], { press = k }
    book:expect("pressure [MPa]", { where = where, near = pressure, rel = dwell and 0.005 or 0.03 })
    if dwell then book:expect("dwell", { where = where, near = dwell, within = 5 }) end
  end
  book:expect("area", { where = { press = 5 }, at_least = 0.01 })
end

-- SPDX-License-Identifier: GPL-3.0-or-later
-- What did the press do, and what did it do to the surfaces? Replays a recorded press log.
--
--   asperity run examples/replay_press_log.lua
--   asperity run examples/replay_press_log.lua -- log=my_log.csv area="490.87 mm^2" turn_step="90 deg"
--   asperity run examples/replay_press_log.lua -- cells=256 overshoot=ignore
--
-- A logger beside the press wrote time, load and angle all the time: noise, a zero that drifts, steps of time
-- that jitter, cells that are missing. The events in it (rise, hold, peak, release, turn) are found, printed
-- with the lines they came from, drawn over the record to be looked at, and only then done to a pair of rough
-- faces; what was done, and what it measured, is written as a log that reads back as the same protocol.
-- The load is that of the whole disc: with `area` it becomes the mean pressure that a tile of it carries.
-- An overshoot stays a press of its own, since flattening goes by the highest load reached; creep goes by the
-- dwell. The log that comes with it, data/press_recording.csv, is SYNTHETIC: data/make_press_recording.lua
-- made it, noise and all.

local lab = require "asperity"
local arguments = require "asperity.arguments"
local um, MPa, deg = lab.units.um, lab.units.MPa, lab.units.deg

local options = arguments({
  log = "", area = "490.87 mm^2", turn_step = "90 deg", overshoot = "press", cells = 128, seed = 1,
}, ...)
local own = options.log == ""
local folder = (arg and arg[0] or ""):match "^(.*)/" or "."
local path = own and folder .. "/data/press_recording.csv" or options.log

-- 1. What the press did.
local p = lab.protocol.read(path, {
  events = "detect", area = options.area, turn_step = options.turn_step, overshoot = options.overshoot,
})
print(p)

-- 2. Look before it is run.
p:chart("press_log.svg", { title = "What the press did" .. (own and " (synthetic record)" or "") })
print "\nDrawn: press_log.svg."

-- 3. Done to a pair of rough faces.
local aluminium = lab.material "Al-2011"
local function face(seed)
  return lab.surface.self_affine{ cells = options.cells, size = "1 mm", hurst = 0.8, ra = "3 um",
    roll_off = "250 um", short_wave = "32 um", seed = seed, material = aluminium }
end
local bench = lab.contact{ lower = face(2 * options.seed - 1), upper = face(2 * options.seed), boundary = "periodic",
  effects = { elasticity = "half_space", plasticity = {}, creep = {} } }
local book, pressed = lab.notebook "events", 0
print "\n  event                            yielded now    volume taken   touching"
for event, st in p:on(bench) do
  if st then
    pressed = pressed + 1
    book:write{ press = pressed, ["pressure [Pa]"] = st.pressure, ["dwell [s]"] = event.dwell,
      ["taken [m^3]"] = st.plastic_volume, ["area"] = st.area_fraction }
    print(("  %-32s %6.2f %%      %8.3g um^3    %.4f"):format(event.text, 100 * st.plastic_fraction,
      st.plastic_volume / um ^ 3, st.area_fraction))
  elseif event.kind == "rotate" then
    print(("  turned by %.0f deg"):format(event.angle / deg))
  end
end
local Ra = bench:lower():roughness().Ra
print(("\nRa of the lower face: %.3f um, before the first press %.3f um"):format(Ra / um,
  face(2 * options.seed - 1):roughness().Ra / um))

-- 4. What was done, as a log; it says the same as the record.
bench:log "done.csv"
local again = lab.protocol.read "done.csv"
print("Written: done.csv, with what each press measured. It reads back as "
  .. (again == p and "the same protocol." or "ANOTHER PROTOCOL."))

-- 5. What must hold.
local same = lab.notebook "replay"
same:write{ same = again == p and 1 or 0, worn = Ra / face(2 * options.seed - 1):roughness().Ra }
same:expect("same", { at_least = 1, label = "the log of the run reads back as the protocol" })
same:expect("worn", { at_most = 1, label = "the faces have worn" })
if own and options.overshoot == "press" then
  -- What was put into the synthetic record: 10, 75 and 60, 100 kN on a disc of 25 mm, an overshoot of 6 %.
  local truth = { { 20.37, 300 }, { 1.06 * 152.79 }, { 152.79, 600 }, { 122.23, 120 }, { 203.72, 600 } }
  for k, wanted in ipairs(truth) do
    book:expect("pressure", { where = { press = k }, near = wanted[1] * MPa, rel = wanted[2] and 0.005 or 0.03 })
    if wanted[2] then book:expect("dwell", { where = { press = k }, near = wanted[2], within = 5 }) end
  end
  book:expect("area", { where = { press = 5 }, at_least = 0.01 })
end

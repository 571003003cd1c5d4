-- SPDX-License-Identifier: GPL-3.0-or-later
-- What would a logger write next to a press? Makes press_recording.csv, the synthetic recording of
-- examples/replay_press_log.lua: no press was there.
--
--   asperity run examples/data/make_press_recording.lua
--
-- The time step of 2 s varies by a third. The load cell has Gaussian noise of 0.12 kN, reads
-- 0.31 kN without load and drifts by 0.08 kN. Some cells are missing. The angle has a resolution of
-- 0.1 deg.
local lab = require "asperity"

-- The steps of a disc of 25 mm: duration (s), load at its end (kN), angle at its end (deg).
local steps = {
  { 60, 0 }, { 22, 10 }, { 300, 10 }, { 9, 0 },              -- 10 kN for 5 min
  { 40, 0 }, { 6, 0, 90 }, { 60, 0 },                        -- a quarter turn
  { 48, 79.5 }, { 12, 75 }, { 600, 75 }, { 15, 0 },          -- 75 kN for 10 min, after an overshoot
  { 30, 0 }, { 8, 0, 180 }, { 80, 0 },                       -- a second quarter turn
  { 35, 60 }, { 120, 60 },                                   -- 60 kN for 2 min
  { 25, 100 }, { 600, 100 }, { 20, 0 }, { 90, 0 },           -- 100 kN for 10 min
}
local corners, total = { { time = 0, load = 0, angle = 0 } }, 0
for k, step in ipairs(steps) do
  total = total + step[1]
  corners[k + 1] = { time = total, load = step[2], angle = step[3] or corners[k].angle }
end

local file = assert(io.open("press_recording.csv", "w"))
file:write("# SYNTHETIC: made by make_press_recording.lua, no press was there\n",
  "time [s]; load [kN]; angle [deg]\n")
local k, time, rows = 1, 0, 0
while time < total do
  while corners[k + 1].time < time do k = k + 1 end
  local from, to = corners[k], corners[k + 1]
  local share = (time - from.time) / (to.time - from.time)
  -- A Gaussian number from two uniform numbers.
  local noise = math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random())
  local load = from.load + share * (to.load - from.load) + 0.31 + 0.08 * time / total + 0.12 * noise
  -- During a constant load, one cell in fifty is missing.
  local missing = from.load == to.load and share > 0.1 and share < 0.9 and math.random() < 0.02
  file:write(("%.2f; %s; %.1f\n"):format(time, missing and "" or ("%.3f"):format(load),
    from.angle + share * (to.angle - from.angle)))
  time, rows = time + 2 * (1 + 0.33 * (2 * math.random() - 1)), rows + 1
end
file:close()
lab.say("%d samples in %.0f [min] written to press_recording.csv", rows, total)

local recording = lab.protocol.read("press_recording.csv", { turn_step = "90 deg" })
local kinds = {}
for n, event in ipairs(recording:events()) do kinds[n] = event.kind end
local wanted = "press release rotate press press release rotate press press release"
lab.table.from{ { same = table.concat(kinds, " ") == wanted and 1 or 0 } }:expect("same",
  { at_least = 1, label = "the events are those that were put in" })

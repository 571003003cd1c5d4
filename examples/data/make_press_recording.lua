-- SPDX-License-Identifier: GPL-3.0-or-later
-- What would a logger write beside a press? Makes press_recording.csv, the synthetic recording that
-- examples/replay_press_log.lua reads: no press was there.
--
--   asperity run examples/data/make_press_recording.lua
--
-- Discs of 25 mm are pressed with 10 kN, turned, pressed with 75 kN, turned, and pressed in two steps with 60
-- and 100 kN, for some minutes each. The clock jitters by a third of its two seconds; the load cell has
-- Gaussian noise of 0.12 kN, reads 0.31 kN without load and drifts by 0.08 kN; the second press shoots over by
-- 6 %; some cells are missing; the angle is read to 0.1 deg.

local lab = require "asperity"

-- What was done: time it takes (s), load at its end (kN), angle at its end (deg).
local steps = {
  { 60, 0 }, { 22, 10 }, { 300, 10 }, { 9, 0 },              -- 10 kN for 5 min
  { 40, 0 }, { 6, 0, 90 }, { 60, 0 },                        -- a quarter turn
  { 48, 79.5 }, { 12, 75 }, { 600, 75 }, { 15, 0 },          -- 75 kN for 10 min, after an overshoot
  { 30, 0 }, { 8, 0, 180 }, { 80, 0 },                       -- another
  { 35, 60 }, { 120, 60 }, { 25, 100 }, { 600, 100 }, { 20, 0 }, -- 60 kN for 2 min, then 100 kN for 10 min
  { 90, 0 },
}
local corners, total = { { time = 0, load = 0, angle = 0 } }, 0
for _, step in ipairs(steps) do
  total = total + step[1]
  corners[#corners + 1] = { time = total, load = step[2], angle = step[3] or corners[#corners].angle }
end

-- Two uniform numbers make a Gaussian one.
local function gaussian()
  return math.sqrt(-2 * math.log(1 - math.random())) * math.cos(2 * math.pi * math.random())
end

local file = assert(io.open("press_recording.csv", "w"))
file:write("# SYNTHETIC: made by make_press_recording.lua, no press was there\n",
  "time [s]; load [kN]; angle [deg]\n")
local k, time, rows = 1, 0, 0
while time < total do
  while corners[k + 1].time < time do k = k + 1 end
  local from, to = corners[k], corners[k + 1]
  local share = (time - from.time) / (to.time - from.time)
  local load = from.load + share * (to.load - from.load) + 0.31 + 0.08 * time / total + 0.12 * gaussian()
  local angle = from.angle + share * (to.angle - from.angle)
  -- Where the load stays, one cell in fifty is missing.
  local missing = from.load == to.load and share > 0.1 and share < 0.9 and math.random() < 0.02
  file:write(("%.2f; %s; %.1f\n"):format(time, missing and "" or ("%.3f"):format(load), angle))
  time, rows = time + 2 * (1 + 0.33 * (2 * math.random() - 1)), rows + 1
end
file:close()
print(rows .. " samples in " .. math.floor(total / 60) .. " min written to press_recording.csv")

-- Read again, its events are those that were put in.
local kinds = {}
for _, event in ipairs(lab.protocol.read("press_recording.csv", { turn_step = "90 deg" }):events()) do
  kinds[#kinds + 1] = event.kind
end
local wanted = "press release rotate press press release rotate press press release"
local book = lab.notebook "made"
book:write{ same = table.concat(kinds, " ") == wanted and 1 or 0 }
book:expect("same", { at_least = 1, label = "its events are those that were put in" })

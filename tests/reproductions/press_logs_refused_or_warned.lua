-- SPDX-License-Identifier: GPL-3.0-or-later
-- Press logs: a saturated sensor is named, filtered noise makes no presses, doubtful entries cause warnings, units of gauges
-- are read, and forms that are not read are refused with the remedy.
--! error: the sensor may be at its limit
--! error: "1,250" may have a decimal comma
--! error: ends after the start of line 3
--! error: it is read as 0, a release
--! error: did you mean `rotation [deg]`?
local lab = require "asperity"

local state = 1
local function normal()
  local sum = -6
  for _ = 1, 12 do
    state = state * 16807 % 2147483647
    sum = sum + state / 2147483647
  end
  return sum
end
-- Three holds at ten samples a second, with noise through a filter of y(k) = r y(k-1) + e; cut at `limit`.
local function recording(name, noise, r, limit)
  local file <close> = assert(io.open(name, "w"))
  file:write "time [s],load [kN]\n"
  local k, y, before = 0, 0, 0
  local function go(to, seconds)
    local from = before
    for step = 1, 10 * seconds do
      y = r * y + math.sqrt(1 - r * r) * noise * normal()
      k = k + 1
      local load = from + (to - from) * step / (10 * seconds) + y
      file:write(("%.1f,%.6f\n"):format(k / 10, math.min(load, limit)))
    end
    before = to
  end
  go(0, 20)
  for _, load in ipairs{ 50, 100, 78 } do
    go(load, 2)
    go(load, 30)
    go(0, 2)
    go(0, 20)
  end
  return name
end
local function presses(path)
  local count = 0
  for _, event in ipairs(lab.protocol.read(path):events()) do count = count + (event.text:find "press" and 1 or 0) end
  return count
end
assert(presses(recording("whole.txt", 0.1, 0, math.huge)) == 3)
pcall(lab.protocol.read, recording("clipped.txt", 0.1, 0, 50)) -- named among the warnings
for seed = 1, 5 do
  state = seed
  local found = presses(recording("filtered.txt", 0.3, 0.9, math.huge))
  assert(found == 3, found .. " presses of three in filtered noise, seed " .. seed)
end

local function log(text)
  local file <close> = assert(io.open("log.txt", "w"))
  file:write(text)
  file:close()
  return lab.protocol.read "log.txt"
end
log "pressure [MPa];dwell [s]\n1,250;5\n100;5\n"
log "time [min],pressure [MPa],dwell [min]\n0,1,20\n10,1,5\n"
log "pressure [MPa],rotation [deg]\n1,0\n,90\n1,0\n"
log "pressure [MPa],angle [deg],dwell [s]\n1,90,1\n"
for _, unit in ipairs{ "psi", "ksi", "lbf", "kip", "kgf", "tf", "daN", "atm" } do
  local kind = ({ psi="pressure", ksi="pressure", atm="pressure" })[unit] or "load"
  assert(#log(kind .. " [" .. unit .. "]\n1\n") == 1, unit)
end
local with = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").with
local function refused(text, words) with(words, log, text) end
refused("time,pressure [MPa]\n03/04/2026 10:00,1\n", 'dates="day first" or dates="month first"')
assert(#log "Machine 7\n\ntime [s],pressure [MPa]\n0,1\n" == 1) -- the lines above are left out with a warning
refused("pressure [MPa],dwell [s]\n10 N,1\n", "is a force where a pressure is wanted")
refused("pressure [MPa],dwell [s]\n1,1\nTotal\n2,2\n", "put # before a line that is no row")
refused("load [N],load [kN]\n1,1\n", 'begin its title with "result "')
refused("\x1F\x8B\x08 log", "packed with gzip")
refused('pressure [MPa],dwell [s]\n"1,500",1\n', "may have a decimal comma or separated thousands")
-- Each refusal names the sign of thousands.
refused("load [N];dwell [s]\n1\xE2\x80\xAF234,5;1\n", 'thousands=" " if')
refused("load [N];dwell [s]\n1.234,5;1\n", 'thousands="." if')
refused("load [N];dwell [s]\n1'234.5;1\n", "thousands=\"'\" if")
refused("time,load [N],dwell [s]\n23:50:00,1,1\n00:05:00,2,1\n", "times of day that go past midnight need their dates")
-- A logger with a column for the day and one for the time of day.
do
  local file <close> = assert(io.open("log.txt", "w"))
  file:write "Datum;Uhrzeit;Kraft [kN];Winkel [\xC2\xB0]\n"
  for k = 0, 240 do
    local load = k < 20 and 0 or k < 90 and 75 or k < 140 and 0 or k < 210 and 50 or 0
    file:write(("23.11.2026;10:%02d:%02d;%d,%03d;%d\n"):format(k // 60, k % 60, load, 300 + k * 7 % 50, k < 120 and 0 or 90))
  end
end
assert(#lab.protocol.read "log.txt" == 5)

-- Replay a press log
-- Question: A logger recorded the load and the angle of a press for
--   eleven minutes. Which press did the damage?
-- Predict: The loads were 60, 100 and 60 kN. Then the upper disc was
--   turned and pressed with 60 kN again. Compared with the first press,
--   does the third remove nothing, little or much (over a third)? And
--   the fourth?
-- Minutes: 20
--
-- The record of a real press is a column of numbers: noisy, with a zero
-- that is not zero, one sample every five seconds. Asperity finds the
-- events in it (rise, hold, release, turn), reports how certain they
-- are, and repeats them on a pair of rough faces. So you can follow an
-- experiment of somebody else, and repeat it with one change.
--
-- A face that has yielded has a new shape. So look at the state of both
-- faces before each press, and at their place on each other.
--
-- The record is **synthetic**: it was written for this lesson, without
-- a press.
--
-- *Then try:* the knob `third`, the load of the third hold, up to and
-- above the 100 kN of the second. Or turn the disc before the third
-- press: `turned_at = 66`.

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local my_guess = { third=nil, fourth=nil } -- volume of each press
guess.names(my_guess, "third", "fourth")
guess.choices(my_guess, "nothing", "little", "much")
local turned_at = 98 -- the sample of the turn by 90 degrees
local third = lab.knob{ name="third", from="20 kN", to="140 kN",
  value="60 kN" }

-- 1. The record: a load in kN every 5 s.
local loads = [[0.3 0.3 0.3 0.3 0.4 0.3 0.4 0.2 0.3 0.2 0.2 30.3 60.3
60.3 60.3 60.5 60.4 60.2 60.3 60.3 60.3 60.4 60.3 60.1 60.3 60.3 60.2
60.2 60.2 30.3 0.3 0.3 0.4 0.2 0.2 0.3 0.4 0.2 0.4 0.2 0.2 50.3 100.2
100.3 100.3 100.4 100.3 100.3 100.4 100.3 100.3 100.4 100.2 100.3 100.4
100.3 100.3 100.3 100.3 50.3 0.2 0.4 0.3 0.4 0.3 0.3 0.4 0.3 0.3 0.2 0.3
30.4 60.3 60.4 60.4 60.3 60.5 60.2 60.3 60.1 60.4 60.3 60.4 60.3 60.1
60.4 60.2 60.2 60.3 30.4 0.3 0.3 0.1 0.4 0.3 0.3 0.3 0.3 0.3 0.2 0.3 0.3
0.4 0.3 0.3 0.3 0.3 30.3 60.3 60.3 60.4 60.3 60.3 60.6 60.4 60.4 60.3
60.2 60.4 60.3 60.3 60.4 60.4 60.3 60.3 30.5 0.3 0.2 0.4 0.3 0.3 0.4 0.3
0.5 0.3 0.3 0.4]]
local function record(name, turn)
  local rows = {}
  for load in loads:gmatch "%S+" do
    local k = #rows
    rows[k + 1] = { ["time [s]"]=5 * k,
      ["angle [deg]"]=k < turn and 0 or 90,
      ["load [kN]"]=load * (k > 70 and k < 90 and third / 6e4 or 1) }
  end
  return lab.protocol.read(lab.table.from(rows):write(name),
    { area="490.87 mm^2", turn_step="90 deg" })
end

-- 2. The same events on two rough faces, as recorded and without the
-- turn. A press can bring something new: another place of the faces on
-- each other, or more load than before at this place. An increase up to
-- 1 % may be noise of the record, so it has no expectation.
local book = lab.notebook "presses"
local function face(seed)
  return lab.surface.self_affine{ cells=128, size="500 um", hurst=0.8,
    ra="3 um", roll_off="250 um", short_wave="16 um", seed=seed,
    material=lab.material "Al-2011" }
end
local function follow(way, protocol)
  local bench = lab.contact{ lower=face(1), upper=face(2),
    boundary="periodic",
    effects={ elasticity="half_space", plasticity={}, creep={} } }
  local rows = protocol:apply(bench, { columns={ "kind", "press",
    "pressure", "plastic_volume", "lower.Ra" } })
  local highest = 0
  for _, row in ipairs(rows) do
    if row.kind == "rotate" then highest = 0 end
    if row.press then
      local new = highest == 0 and "another place"
        or row.pressure > 1.01 * highest and "more load"
        or row.pressure > highest and "a little" or "nothing"
      book:write{ way=way, press=row.press, new=new,
        share=row.plastic_volume / rows[1].plastic_volume,
        ["pressure [Pa]"]=row.pressure, ["Ra [m]"]=row["lower.Ra"],
        ["volume [m^3]"]=row.plastic_volume }
      highest = math.max(highest, row.pressure)
    end
  end
  return bench
end
local p = record("press.csv", turned_at)
print(p)

-- A chart of the record: a line for each press that was found.
local log = lab.notebook("log", { units={ time="min", load="kN" } })
local function draw(part, time, load)
  log:write{ part=part, ["time [s]"]=time, ["load [N]"]=load }
end
for _, row in ipairs(lab.table.read "press.csv":rows()) do
  local part, press = "at rest", 0
  for _, event in ipairs(p:events()) do
    if event.kind == "press" then
      press = press + 1
      local since = row.time - event.time
      local during = since >= -10 and since <= event.dwell + 10
      part = during and "press " .. press or part
    end
  end
  draw(part, row.time, row.load)
end
for _, event in ipairs(p:events()) do
  if event.kind == "rotate" then
    for k = -1, 1 do
      draw("turn", event.time + 10 * k, k == 0 and 2e4 or 0)
    end
  end
end
log:chart{ x="time", y="load", one_line_per="part", points=false,
  title="The record of the press (synthetic)", file="press.svg" }

local bench = follow("as recorded", p)
follow("without the turn", record("lying.csv", math.huge))
book:show{ "way", "press", "pressure [MPa]", "volume [um^3]", "share",
  "new", digits=5 }
book:chart{ x="press", y="share", one_line_per="way", file="volume.svg",
  title="Which press did the damage" }

-- 3. Expectations, and the reason.
lab.table.from{ { same=lab.protocol.read(bench:log "done.csv") == p
  and 1 or 0 } }:expect("same", { at_least=1, label="same protocol" })
book:expect("share", { where={ way="as recorded", press=2 },
  at_least=0.3, label="more load removes more" })
book:expect("share", { where={ new="more load" }, at_least=0.02,
  label="more load than before removes something" })
book:expect("share", { where={ new="nothing" }, at_most=1e-3,
  label="nothing new removes nothing" })
book:expect("share", { where={ new="another place" }, at_least=0.3,
  label="at another place the same load removes much again" })
book:expect("share", { where={ way="without the turn", press=4 },
  at_least=0.3, should_fail=true, label="without the turn as well" })
for press, name in pairs{ [3]="third", [4]="fourth" } do
  local share = book:where{ way="as recorded", press=press }[1].share
  guess{ said=my_guess[name], name=name, of="the " .. name .. " press",
    found=share < 1e-3 and "nothing" or share < 1 / 3 and "little"
      or "much", replies={
      nothing="A new place or more load brings other tops together.",
      little="It depends on load and place: was either new?",
      much="The faces fit each other up to the highest load here." } }
end
require "asperity.prose"[[Why: pressed faces fit each other up to the
highest load at their place; a press below this load removes nothing. A
turn brings other tops over each other, which yield as in a first press.
So damage depends on the history, not on the load alone.

The 0.3 kN at rest are a zero. It was found and taken off, see above.]]

-- Replay a press log
-- Question: A logger beside a press wrote down load and angle for
--   eleven minutes. Which press did the damage?
-- Predict: It pressed with 60, 100 and 60 kN; then the upper disc was
--   turned, and pressed with 60 kN again. Put the four presses in order
--   of the volume they take. How much does the third take?
-- Minutes: 20
--
-- What a real press did is a column of numbers: noisy, with a zero that
-- is not zero, a sample every five seconds. Asperity finds the events
-- in it (rise, hold, release, turn), says how sure it can be, and does
-- the same to a pair of rough faces. So an experiment can be followed
-- that somebody else did, and repeated with one thing changed.
--
-- Ground that has yielded keeps its new shape. So ask of each press
-- what the faces were like when it came, and how they lay.
--
-- The record is **synthetic**: written for this lesson, no press was
-- there.
--
-- *Your prediction:* put its number into `my_guess` in the script; the
-- last lines compare it with what was found.
--
-- *Then try:* `third = 110`, a third hold higher than any before. Or
-- turn after the second press: `turned_at = 66`.

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local prose = require "asperity.prose"
local um = lab.units.um
local my_guess = nil -- volume of the third press over that of the first
local turned_at = 98 -- the sample at which it was turned by 90 degrees
local third = 60 -- load of the third hold in kN

-- 1. What the logger wrote: load in kN every 5 s.
local loads = [[
  0.3 0.3 0.3 0.3 0.4 0.3 0.4 0.2 0.3 0.2 0.2 30.3 60.3 60.3 60.3 60.5
  60.4 60.2 60.3 60.3 60.3 60.4 60.3 60.1 60.3 60.3 60.2 60.2 60.2
  30.3 0.3 0.3 0.4 0.2 0.2 0.3 0.4 0.2 0.4 0.2 0.2 50.3 100.2 100.3
  100.3 100.4 100.3 100.3 100.4 100.3 100.3 100.4 100.2 100.3 100.4
  100.3 100.3 100.3 100.3 50.3 0.2 0.4 0.3 0.4 0.3 0.3 0.4 0.3 0.3 0.2
  0.3 30.4 60.3 60.4 60.4 60.3 60.5 60.2 60.3 60.1 60.4 60.3 60.4 60.3
  60.1 60.4 60.2 60.2 60.3 30.4 0.3 0.3 0.1 0.4 0.3 0.3 0.3 0.3 0.3
  0.2 0.3 0.3 0.4 0.3 0.3 0.3 0.3 30.3 60.3 60.3 60.4 60.3 60.3 60.6
  60.4 60.4 60.3 60.2 60.4 60.3 60.3 60.4 60.4 60.3 60.3 30.5 0.3 0.2
  0.4 0.3 0.3 0.4 0.3 0.5 0.3 0.3 0.4
]]
local function write(name, turn)
  local file, sample = assert(io.open(name, "w")), 0
  file:write "time [s]; load [kN]; angle [deg]\n"
  for load in loads:gmatch "%S+" do
    if sample >= 71 and sample <= 89 then
      load = ("%.1f"):format(load * third / 60)
    end
    file:write(("%d; %s; %d\n"):format(5 * sample, load,
      sample < turn and 0 or 90))
    sample = sample + 1
  end
  file:close()
end
write("press.csv", turned_at)
write("lying.csv", math.huge) -- as if nobody had turned it

-- 2. What the press did. A load on the whole disc of 25 mm becomes the
-- mean pressure that our tile feels.
local function read(name)
  return lab.protocol.read(name,
    { area="490.87 mm^2", turn_step="90 deg" })
end
local p = read "press.csv"
print(p)
p:chart("press.svg", { title="What the press did (synthetic)" })

-- 3. The same done to two rough faces; and to their twins, without the
-- turn.
local function face(seed)
  return lab.surface.self_affine{ cells=128, size="500 um", hurst=0.8,
    ra="3 um", roll_off="250 um", short_wave="16 um", seed=seed,
    material=lab.material "Al-2011" }
end
local function bench()
  return lab.contact{ lower=face(1), upper=face(2), boundary="periodic",
    effects={ elasticity="half_space", plasticity={}, creep={} } }
end
local book, shares = lab.notebook "presses", {}
local function follow(protocol, way, contact)
  local press, first_volume = 0, nil
  shares[way] = {}
  for event, st in protocol:on(contact) do
    if st then
      press = press + 1
      first_volume = first_volume or st.plastic_volume
      local share = st.plastic_volume / first_volume
      book:write{ way=way, press=press, ["pressure [Pa]"]=st.pressure,
        ["volume [m^3]"]=st.plastic_volume, share=share,
        ["Ra [m]"]=contact:lower():roughness().Ra }
      print(("  %d  %-26s takes %6.0f um^3, %4.2f of the first"):format(
        press, event.text, st.plastic_volume / um ^ 3, share))
      shares[way][press] = share
    end
  end
end
print "\nas recorded:"
local worn = bench()
follow(p, "as recorded", worn)
print "without the turn:"
local lying = read "lying.csv"
follow(lying, "without the turn", bench())
book:chart{ x="press", y="share", one_line_per="way", file="volume.svg",
  y_label="volume taken / by the first",
  title="Which press did the damage" }

-- 4. What was done, as a log of events, is the same protocol again.
worn:log "done.csv"
local same = lab.notebook "same"
same:write{ same=lab.protocol.read "done.csv" == p and 1 or 0 }

-- 5. What must hold, and why.
same:expect("same", { at_least=1,
  label="the log of the run reads back as the record" })
book:expect("share", { where={ way="as recorded", press=2 },
  at_least=0.3, label="more load takes more" })
-- What is new for a press: how the faces lie, a load one per cent above
-- all since they lie so, or nothing? `moved`: one came after the turn.
local news, reason, moved = lab.notebook "news", {}, false
local reasons = { load="it is more load than before",
  place="the faces lie elsewhere",
  nothing="no more load than before, and the faces lie as they lay" }
local ways = { ["as recorded"]=p, ["without the turn"]=lying }
for way, protocol in lab.sorted(ways) do
  local press, highest, turned = 0, 0, false
  for _, event in ipairs(protocol:events()) do
    if event.kind == "rotate" then turned, highest = true, 0 end
    if event.kind == "press" then
      local more = event.pressure > 1.01 * highest
      local new = turned and "place" or more and "load" or "nothing"
      press, turned = press + 1, false
      highest = math.max(highest, event.pressure)
      news:write{ way=way, press=press, new=new,
        share=shares[way][press] }
      moved = moved or new == "place"
      if way == "as recorded" then reason[press] = reasons[new] end
    end
  end
end
news:expect("share", { where={ new="load" }, at_least=0.02,
  label="whatever is more than before takes something" })
news:expect("share", { where={ new="nothing" }, at_most=1e-3,
  label="no more load, lying as before, takes nothing" })
if moved then
  news:expect("share", { where={ way="as recorded", new="place" },
    at_least=0.3, label="after a turn the same load takes again" })
end
if moved and turned_at > 90 then
  book:expect("share", { where={ way="without the turn", press=4 },
    at_least=0.3, should_fail=true,
    label="without the turn it does too" })
end
local of_third = shares["as recorded"][3] or 0
local of_fourth = shares["as recorded"][4] or 0
local none = "no such press"
print()
prose([[
The third press takes %.2g of the first (%s), the fourth %.2g (%s).]],
  of_third, reason[3] or none, of_fourth, reason[4] or none)
guess{ said=my_guess, found=of_third, of="the third press" }
prose([[
Why: faces that were pressed together fit each other up to the highest
load since they lie so, and under it nothing is left to squash. A load
that is neither higher nor elsewhere finds ground that fits already. A
turn lays strangers on each other, which give way again as new faces do.
Damage is not in the load alone, it is in the history.

The 0.3 kN that the logger shows at rest is its zero: it was found in
the rests and taken off. Noise, zero and thresholds are all printed
above: what a program assumed should be readable.]])

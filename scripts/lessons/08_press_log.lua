-- Replay a press log
-- Question: A logger beside a press wrote down load and angle for eleven minutes. Which press did the damage?
-- Predict: It pressed with 60, 100 and 60 kN; then the upper disc was turned, and pressed with 60 kN again. Put the
--   four presses in order of the volume they take. How much does the third take?
-- Minutes: 20
--
-- What a real press did is a column of numbers: noisy, with a zero that is not zero, a sample every five seconds.
-- Asperity finds the events in it (rise, hold, release, turn), says how sure it can be, and does the same to a pair of
-- rough faces. So an experiment can be followed that somebody else did, and repeated with one thing changed.
--
-- Ground that has yielded remembers how high the pressure was, and how the other face lay. What is not higher, or
-- not elsewhere, finds it fitting already.
--
-- The record is **synthetic**: written for this lesson, no press was there. *Then try:* make the third hold 110 kN by
-- changing its numbers. Or turn after the second press: replace 98 by 66.

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local um = lab.units.um
local my_guess = nil -- volume of the third press over that of the first

-- 1. What the logger wrote: load in kN every 5 s. The disc was turned by 90 degrees at sample 98.
local turned_at, loads = 98, [[
  0.3 0.3 0.3 0.3 0.4 0.3 0.4 0.2 0.3 0.2 0.2 30.3 60.3 60.3 60.3 60.5
  60.4 60.2 60.3 60.3 60.3 60.4 60.3 60.1 60.3 60.3 60.2 60.2 60.2 30.3 0.3 0.3
  0.4 0.2 0.2 0.3 0.4 0.2 0.4 0.2 0.2 50.3 100.2 100.3 100.3 100.4 100.3 100.3
  100.4 100.3 100.3 100.4 100.2 100.3 100.4 100.3 100.3 100.3 100.3 50.3 0.2 0.4 0.3 0.4
  0.3 0.3 0.4 0.3 0.3 0.2 0.3 30.4 60.3 60.4 60.4 60.3 60.5 60.2 60.3 60.1
  60.4 60.3 60.4 60.3 60.1 60.4 60.2 60.2 60.3 30.4 0.3 0.3 0.1 0.4 0.3 0.3
  0.3 0.3 0.3 0.2 0.3 0.3 0.4 0.3 0.3 0.3 0.3 30.3 60.3 60.3 60.4 60.3
  60.3 60.6 60.4 60.4 60.3 60.2 60.4 60.3 60.3 60.4 60.4 60.3 60.3 30.5 0.3 0.2
  0.4 0.3 0.3 0.4 0.3 0.5 0.3 0.3 0.4
]]
local function write(name, turn)
  local file, sample = assert(io.open(name, "w")), 0
  file:write "time [s]; load [kN]; angle [deg]\n"
  for load in loads:gmatch "%S+" do
    file:write(("%d; %s; %d\n"):format(5 * sample, load, sample < turn and 0 or 90))
    sample = sample + 1
  end
  file:close()
end
write("press.csv", turned_at)
write("lying.csv", math.huge) -- as if nobody had turned it

-- 2. What the press did. A load on the whole disc of 25 mm becomes the mean pressure that our tile feels.
local function read(name) return lab.protocol.read(name, { area="490.87 mm^2", turn_step="90 deg" }) end
local p = read "press.csv"
print(p)
p:chart("press.svg", { title="What the press did (synthetic)" })

-- 3. The same done to two rough faces; and to their twins, without the turn.
local function face(seed)
  return lab.surface.self_affine{ cells=128, size="500 um", hurst=0.8, ra="3 um", roll_off="250 um",
                                  short_wave="16 um", seed=seed, material=lab.material "Al-2011" }
end
local function bench()
  return lab.contact{ lower=face(1), upper=face(2), boundary="periodic",
                      effects={ elasticity="half_space", plasticity={}, creep={} } }
end
local book, first, third, fourth = lab.notebook "presses", nil, nil, nil
local function follow(protocol, way, contact)
  local press, first_volume = 0, nil
  for event, st in protocol:on(contact) do
    if st then
      press = press + 1
      first_volume = first_volume or st.plastic_volume
      local share = st.plastic_volume / first_volume
      book:write{ way=way, press=press, ["pressure [Pa]"]=st.pressure, ["volume [m^3]"]=st.plastic_volume,
                  share=share, ["Ra [m]"]=contact:lower():roughness().Ra }
      print(("  %d  %-26s takes %6.0f um^3, %4.2f of the first"):format(press, event.text,
        st.plastic_volume / um ^ 3, share))
      if way == "as recorded" then first, third, fourth = first or share, press == 3 and share or third, share end
    end
  end
end
print "\nas recorded:"
local worn = bench()
follow(p, "as recorded", worn)
print "without the turn:"
follow(read "lying.csv", "without the turn", bench())
book:chart{ x="press", y="share", one_line_per="way", file="volume.svg", y_label="volume taken / by the first",
            title="Which press did the damage" }

-- 4. What was done, as a log of events, is the same protocol again.
worn:log "done.csv"
local same = lab.notebook "same"
same:write{ same=lab.protocol.read "done.csv" == p and 1 or 0 }

-- 5. What must hold, and why.
same:expect("same", { at_least=1, label="the log of the run reads back as the record" })
book:expect("share", { where={ way="as recorded", press=2 }, at_least=0.3, label="more load takes more" })
book:expect("share", { where={ way="as recorded", press=3 }, at_most=1e-3,
                       label="less load, lying as before, takes nothing" })
book:expect("share", { where={ way="as recorded", press=4 }, at_least=0.3,
                       label="after a turn the same load takes again" })
book:expect("share", { where={ way="without the turn", press=4 }, at_least=0.3, should_fail=true,
                       label="without the turn it does too" })
print(([[

You said %s for the third press; it takes %.2g of the first, the fourth %.2f.
Why: after 100 kN the two faces fit each other up to 100 kN, so 60 kN find nothing to squash. A turn lays strangers on
each other: 60 kN then take about as much as on new faces. Damage is not in the load alone, it is in the history.
The 0.3 kN that the logger shows at rest is its zero: it was found in the rests and taken off. Noise, zero and
thresholds are all printed above: what a program assumed should be readable.]]):format(my_guess or "nothing", third,
  fourth))

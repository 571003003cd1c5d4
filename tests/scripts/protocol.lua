-- SPDX-License-Identifier: GPL-3.0-or-later
-- A protocol repeats the calls of its events on any contact, any number of times, and stops with its loop.
--! output: all as by hand
--! file: journal.jsonl: "function":"contact:press"
--! file: journal.jsonl: "inputs":{"pressure":"152780000","dwell":"\"600 s\""}
--! file: journal.jsonl: "function":"protocol:on"
--! file: log.csv: time [s], place, rotation [deg], pressure [MPa], dwell [min]
--! file: manifest.json: recorded.txt
local lab = require "asperity"
local S, steel = lab.surface, lab.material "steel"
local rough = S.weierstrass_mandelbrot{ cells=48, D=2.5, seed=1, phases="golden", material=steel }
local counter = S.weierstrass_mandelbrot{ cells=48, D=2.3, seed=2, material=steel }
local function contact(boundary)
  return lab.contact{ lower=rough, upper=counter, boundary=boundary, effects={ elasticity="box" } }
end
local cell = rough.size[1] / 48

local p = lab.protocol{
  { press={ pressure="152.78 MPa", dwell="10 min" } }, { release=true }, { place={ seed=1 } },
  { press={ load="20 N" } }, { rotate="90 deg" }, { press={ approach="1 um" } },
  { shift={ x=cell } }, { press={ flatten=0.1 } }, { press={ indentation=0.05 } },
}
assert(#p == 9 and p.count == 9 and p.presses == 5)

-- By hand.
local c = contact "periodic"
local expected = { c:press{ pressure="152.78 MPa", dwell="10 min" }.digest }
c:release() c:place{ seed=1 }
expected[4] = c:press{ load="20 N" }.digest
c:rotate "90 deg"
expected[6] = c:press{ approach="1 um" }.digest
c:shift{ x=cell }
expected[8], expected[9] = c:press{ flatten=0.1 }.digest, c:press{ indentation=0.05 }.digest

-- By protocol, on two contacts by turns, then once more on one.
local function go_through(protocol, on)
  local count = 0
  for event, st in protocol:on(on) do
    count = count + 1
    assert(event.index == count and event.total == #protocol)
    assert((event.kind == "press") == (st ~= nil))
    assert((st and st.digest) == expected[count], event.text)
  end
  assert(count == #protocol)
end
local one, two = contact "periodic", contact "periodic"
local next_one, next_two = p:on(one), p:on(two)
for k = 1, #p do
  local a, st_a = next_one()
  local b, st_b = next_two()
  assert(a.index == k and b.index == k and (st_a and st_a.digest) == expected[k] and st_a == st_b)
end
assert(next_one() == nil)
go_through(p, contact "periodic")

-- Events know their own parameters and no others.
local events = p:events()
assert(#events == 9 and events[1].pressure == 152.78e6 and events[1].dwell == 600 and events[1].load == nil)
assert(events[1].text == "press 152.78 MPa for 10 min" and events[1].time == nil)
assert(lab.protocol{ { press={ pressure="1 MPa", dwell="100 h" } } }:events()[1].text == "press 1 MPa for 100 h")
assert(events[3].seed == 1 and math.type(events[3].seed) == "integer" and events[3].pressure == nil)
assert(events[4].load == 20 and events[4].dwell == nil and events[6].approach == 1e-6)
assert(events[5].angle == math.pi / 2 and events[7].x == cell and events[7].y == 0)
assert(events[8].flatten == 0.1 and events[9].indentation == 0.05)
assert(tostring(events[2]) == "protocol event\n  index  2\n  total  9\n  kind   release\n  text   release")
assert(tostring(p):find("protocol of 9 events\n  1  press 152.78 MPa for 10 min\n  2  release\n", 1, true))

-- A loop broken off has done no more than it has shown.
local broken = contact "periodic"
for event in p:on(broken) do if event.kind == "press" then break end end
assert(tostring(broken):find "under load")
local untouched = contact "periodic"
local never = p:on(untouched)
assert(not tostring(untouched):find "under load")

-- An impossible event is refused before the first event is done.
local failing = lab.protocol{ { press={ pressure="10 MPa" } }, { rotate="45 deg" }, { release=true } }
local f, seen = contact "periodic", 0
local ok, message = pcall(function() for _ in failing:on(f) do seen = seen + 1 end end)
assert(not ok and seen == 0 and not tostring(f):find "under load")
assert(message:find("event 2 of 3: rotate 45 deg: a turn by 45 deg does not fit", 1, true), message)
assert(f:press{ pressure="10 MPa" }.digest == contact "periodic":press{ pressure="10 MPa" }.digest)

-- Put together, and compared.
local turn = lab.protocol{ { release=true }, { rotate="90 deg" } }
local q = lab.protocol{ { press={ pressure=1e6 } } }:plus(turn):repeated{ repeats=3 }
assert(#q == 9 and q == q:repeated{ repeats=1 } and q ~= p and q.digest ~= p.digest)
local angle = 0
for event in q:on(contact "periodic") do angle = angle + (event.angle or 0) end
assert(math.abs(angle - 1.5 * math.pi) < 1e-15)

-- Written and read again; and a log as a person keeps it.
local recorded = assert(io.open("recorded.txt", "w"))
recorded:write("\xEF\xBB\xBFTime [s];Pressure [MPa];Turn [deg];Dwell [min];Place;Operator\r\n",
               "0;152,78;0;10;;Li\r\n", "900;152,78;90;10;3;\r\n", "1800;0;0;0;;\r\n")
recorded:close()
local log = lab.protocol.read "recorded.txt"
assert(log == lab.protocol.read(log:write "log.csv"))
assert(#log == 6 and log:events()[3].seed == 3 and log:events()[5].time == 900)
local by_table = contact "periodic"
local first = by_table:press{ pressure="152.78 MPa" }.digest
by_table:place{ seed=3 }
by_table:rotate "90 deg"
local second = by_table:press{ pressure="152.78 MPa" }.digest
local found = {}
for event, st in log:on(contact "periodic") do if st then found[#found + 1] = st.digest end end
assert(#found == 2 and found[1] == first and found[2] == second)

-- Values shared by the cases of an ensemble.
local rows = lab.ensemble{ over={ seed={ 1, 2 } }, run=function(case)
  local last
  local mine = lab.contact{ lower=rough, upper=counter, boundary="periodic", effects={ elasticity="box" } }
  for _, st in p:on(mine) do last = st or last end
  return { digest=last.digest }
end }
assert(#rows == 2 and rows[1].digest == expected[9] and rows[2].digest == expected[9])
print "all as by hand"

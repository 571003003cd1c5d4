-- SPDX-License-Identifier: GPL-3.0-or-later
-- Protocols that make no sense: every problem of a list is named by its event, every one of a log by its line.
--! output: all refused
local lab = require "asperity"
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
local P = lab.protocol
refused(function() P{} end, "a protocol has no events")
refused(function() P(3) end, "lab.protocol takes a list of events, and was given the number 3")
refused(function() P() end, "was given nothing")
refused(function() P({ { release=true } }, 2) end, "lab.protocol takes one argument")
refused(function() P{ press={ pressure=1 } } end, "`press` is outside the braces of an event; write { press=... }")
refused(function() P{ times=3, { release=true } } end, "unknown key `times`; a protocol is a list of events")
refused(function() P{ [1]={ release=true }, [3]={ release=true } } end, "the list has an entry at the number 3")
refused(function() P{ { pres={ pressure=1 } } } end, "event 1: unknown event `pres` (did you mean `press`?); the events are press, release, place, rotate and shift")
refused(function() P{ { press={ presure=1 } } } end, "event 1: press: ", "unknown key `presure` (did you mean `pressure`?)")
refused(function() P{ { pressure="1 MPa" } } end, "event 1: `pressure` belongs inside: { press={ pressure=... } }")
refused(function() P{ { press={ pressure=1 }, dwell=3 } } end, "`dwell` belongs inside: { press={ dwell=... } }")
refused(function() P{ { place={ seed=1 }, dwell=3 } } end, "unknown event `dwell`")
refused(function() P{ { press={ pressure=1 }, release=true } } end, "event 1: it holds press and release; give each braces of its own")
refused(function() P{ {} } end, "event 1: it is empty")
refused(function() P{ "release" } end, 'event 1: it is the string "release"; give a table such as { release=true }')
refused(function() P{ { "release" } } end, "event 1: it holds a value without a key")
refused(function() P{ { release=false } } end, "`release` is false; write { release=true }")
refused(function() P{ { rotate="1 m" } } end, "`rotate`: ", "a length where an angle is wanted")
refused(function() P{ { rotate={ angle=1 } } } end, "`rotate` is a table; give an angle")
refused(function() P{ { rotate=math.huge } } end, "`rotate` is inf")
refused(function() P{ { place=1 } } end, "`place` is the number 1; give a table of named keys, as c:place takes")
refused(function() P{ { press={ pressure=1, load=2 } } } end, "2 are given")
refused(function() P{ { release=true }, { press={ pressure=math.huge, dwell="1 m" } }, 3, { shift={ z=1 } } } end, "3 problems",
  "\n  event 2: press: 2 problems\n    `pressure` is inf Pa", "\n  event 3: it is the number 3", "\n  event 4: shift: unknown key `z`")

local p = P{ { release=true } }
refused(function() p:on(3) end, "`contact` is the number 3; give a contact")
refused(function() p:on() end, "`contact` is nothing")
refused(function() p:repeated{ repeats=0 } end, "`repeats` is 0; give a whole number at least 1")
refused(function() p:repeated{ repeats=1e12 } end, "give a whole number from 1 to 10000000")
refused(function() return p.lenght end, "a protocol has no field `lenght`")
refused(function() p.count = 3 end, "a protocol cannot be changed")
refused(function() return p:events()[1].pressur end, "has no field `pressur` (did you mean `pressure`?)")
refused(function() P{ { shift={ x=1 } } }:write "log.csv" end, "a press log cannot hold event 1, shift by 1 m along x")
refused(function() P.reed "x.csv" end, "lab.protocol has no field `reed` (did you mean `read`?)")
refused(function() P.read "nothing.csv" end, "there is no file")
local c = lab.contact{ lower=lab.surface.sine{ cells=8, size=1, amplitude=1e-3, material=lab.material "steel" }, upper=lab.rigid, effects={ elasticity="box" } }
local next_event, ended = p:on(c), p:on(c)
assert(ended().kind == "release")
assert(ended() == nil)
refused(function() ended() end, "the iterator is finished")
refused(function() p.on(c, p) end, "was called on a contact, not on a protocol")
c:close()
refused(function() p:on(c) end, "`contact` was closed")
refused(function() next_event() end, "the contact of the protocol was closed inside its loop")
print "all refused"

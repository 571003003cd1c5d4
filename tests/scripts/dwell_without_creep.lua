-- SPDX-License-Identifier: GPL-3.0-or-later
-- A dwell without creep gives one warning per contact, and changes nothing.
--! error: warning: `dwell` does nothing without creep
--! file: journal.jsonl: "event":"warning"
local lab = require "asperity"
local s = lab.surface.sine{ cells=16, size="1 mm", amplitude="1 um", material=lab.material "steel" }
local function bench() return lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } } end
local c = bench()
local st = c:press{ pressure="1 MPa", dwell="10 min" }
assert(st.digest == bench():press{ pressure="1 MPa" }.digest)
assert(c:press{ pressure="1 MPa", dwell="1 h" }.digest == st.digest)

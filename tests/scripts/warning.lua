-- SPDX-License-Identifier: GPL-3.0-or-later
-- A warning is shown once, and kept in the journal.
--! error: warning: `probe_pressure` is for half-space contacts
--! file: journal.jsonl: "event":"warning"
local lab = require "asperity"
local s = lab.surface.sine{ cells=16, size=1, amplitude=0.01, material=lab.material "steel" }
local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
local law = lab.friction{ tau0="500 MPa", alpha=0.2 }
lab.tilt_stage{ contact=c, friction=law, mass="4 g", probe_pressure={ "1 MPa", "3 MPa" } }

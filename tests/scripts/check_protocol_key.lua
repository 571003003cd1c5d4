-- SPDX-License-Identifier: GPL-3.0-or-later
-- Mistakes in a list of events are found though one of its numbers is not known yet.
--! command: check
--! exit: 1
--! error: check_protocol_key.lua:9: lab.protocol: event 2: press: unknown key `presure` (did you mean `pressure`?)
local lab = require "asperity"
local s = lab.surface.sine{ cells=4096, size=1, amplitude="1 um", material=lab.material "steel" }
local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
lab.protocol{ { press={ pressure=s:roughness().Rq } }, { press={ presure=1 } } }

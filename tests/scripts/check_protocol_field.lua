-- SPDX-License-Identifier: GPL-3.0-or-later
-- A misspelt field of the state that the loop over a protocol gives.
--! command: check
--! exit: 1
--! error: a state has no field `aera` (did you mean `area`?)
local lab = require "asperity"
local s = lab.surface.sine{ cells=4096, size=1, amplitude="1 um", material=lab.material "steel" }
local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
for event, st in lab.protocol{ { press={ pressure=1 } } }:on(c) do print(st.aera) end

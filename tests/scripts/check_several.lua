-- SPDX-License-Identifier: GPL-3.0-or-later
-- Placeholders among the values hide no other problem of a table, of a list of events or of the states in its loop.
--! command: check
--! exit: 1
--! error: 2 problems
--! error: `D` is 4; give a number from 2 to 3
--! error: unknown key `sed` (did you mean `seed`?)
--! error: check_several.lua:15: lab.protocol: event 2: press: unknown key `presure` (did you mean `pressure`?)
--! error: a state has no field `aera` (did you mean `area`?)
local lab = require "asperity"
local s = lab.surface.sine{ cells=4096, size=1, amplitude="1 um", material=lab.material "steel" }
local Ra = s:roughness().Ra
lab.surface.weierstrass_mandelbrot{ cells={ 64, 64 }, D=4, G=Ra, sed=1 }
local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
lab.protocol{ { press={ pressure=Ra } }, { press={ presure=1 } } }
for event, st in lab.protocol{ { press={ pressure=1 } } }:on(c) do print(st.aera) end

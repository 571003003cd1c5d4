-- SPDX-License-Identifier: GPL-3.0-or-later
--! command: check
--! exit: 1
--! error: check_misspelt_field.lua:8: a state has no field `aera_fraction` (did you mean `area_fraction`?)
local lab = require "asperity"
local s = lab.surface.weierstrass_mandelbrot{ cells=4096, D=2.5, material=lab.material "steel" }
local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
for st in c:sweep{ pressure={ "1 MPa", "2 MPa" } } do print(st.aera_fraction) end

-- SPDX-License-Identifier: GPL-3.0-or-later
--! command: check
--! exit: 1
--! error: check_misspelt_key.lua:8: contact:press: unknown key `presure` (did you mean `pressure`?)
local lab = require "asperity"
local s = lab.surface.weierstrass_mandelbrot{ cells=4096, D=2.5, material=lab.material "steel" }
local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
c:press{ presure="1 MPa" }

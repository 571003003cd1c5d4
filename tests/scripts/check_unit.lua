-- SPDX-License-Identifier: GPL-3.0-or-later
--! command: check
--! exit: 1
--! error: check_unit.lua:6: surface:scaled: `rms`: "1 MPa": a pressure where a length is wanted
local lab = require "asperity"
lab.surface.weierstrass_mandelbrot{ cells=4096, D=2.5 }:scaled{ rms="1 MPa" }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Placeholders among the values hide none of the other problems of a table.
--! command: check
--! exit: 1
--! error: 2 problems
--! error: `D` is 4; give a number from 2 to 3
--! error: unknown key `sed` (did you mean `seed`?)
local lab = require "asperity"
local Ra = lab.surface.sine{ cells=4096, size=1, amplitude="1 um" }:roughness().Ra
lab.surface.weierstrass_mandelbrot{ cells={ 64, 64 }, D=4, G=Ra, sed=1 }

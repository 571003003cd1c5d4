-- SPDX-License-Identifier: GPL-3.0-or-later
-- A script whose path depends on a result is checked as far as it can be followed.
--! command: check
--! output: no problem found; checked to line 8: the script's path depends on a result
local lab = require "asperity"
local s = lab.surface.weierstrass_mandelbrot{ cells=4096, D=2.5 }
local Ra = s:roughness().Ra
if Ra > 1e-6 then lab.nonsense() end

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local face = lab.surface.self_affine{ cells=128, size="50 um", hurst=0.8, rms_slope=0.4, short_wave="1.5 um",
                                      long_wave="25 um", seed=1, material=lab.material "Al-2011" }
local stylus = lab.stylus{ tip="5 um" }
local seen = stylus:dilated(face)
local a, b = face:roughness(), seen:roughness()
lab.say("Ra %.1f [nm] -> %.1f [nm]: %.1f [%]", a.Ra, b.Ra, b.Ra / a.Ra - 1)
lab.say("rms slope %.3f -> %.3f: %.1f [%]", a.rms_slope, b.rms_slope, b.rms_slope / a.rms_slope - 1)

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local face = lab.surface.self_affine{ cells=64, size="100 um", hurst=0.8, rms_slope=0.1, short_wave="8 um",
                                      long_wave="50 um", seed=1, material=lab.material "Al-2011" }
local c = lab.contact{ lower=face, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" },
                       accuracy={ error=0.03, at_most={ time="60 s" } } }
local st = c:press{ pressure="100 MPa" }
lab.say("area %.2f [%], corrected %.2f [%]", st.area_fraction, st.corrected_area_fraction)
print("chosen", st.chosen)
print("error", st.error)
print("cost", st.cost)

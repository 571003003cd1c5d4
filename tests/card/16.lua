-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local al = lab.material "Al-2011"
local face = lab.surface.self_affine{ cells=128, size="100 um", hurst=0.8, rms_slope=0.1, short_wave="4 um",
                                      long_wave="50 um", seed=1, material=al }
local c = lab.contact{ lower=face, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
local st = c:press{ pressure="50 MPa" }
lab.say("peak pressure %.2f [GPa], hardness %.2f [GPa]", st.peak_pressure, al.hardness)
print(st.peak_pressure > al.hardness and "yes: the tops carry more than the hardness" or "no")

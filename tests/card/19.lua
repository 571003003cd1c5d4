-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local face = lab.surface.self_affine{ cells=128, size="100 um", hurst=0.8, rms_slope=0.1, short_wave="4 um",
                                      long_wave="50 um", seed=1, material=lab.material "Al-2011" }
local c = lab.contact{ lower=face, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
print(c:explain{ pressure="100 MPa" })

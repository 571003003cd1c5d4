-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local al = lab.material "Al-2011"
local function face(seed)
  return lab.surface.self_affine{ cells=64, size="100 um", hurst=0.8, rms_slope=0.1, short_wave="8 um",
                                  long_wave="50 um", seed=seed, material=al }
end
local c = lab.contact{ lower=face(1), upper=face(2), boundary="free", effects={ elasticity="half_space" } }
c:rotate "45 deg"
local st = c:press{ pressure="20 MPa" }
lab.say("turned by 45 deg: %.1f [%] of the faces overlap", st.overlap_fraction)

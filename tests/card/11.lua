-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local al = lab.material "Al-2011"
local t = lab.ensemble{
  over={ slope={ 0.05, 0.1, 0.2 }, seed={ 1, 2, 3, 4 } },
  run=function(case)
    local face = lab.surface.self_affine{ cells=64, size="100 um", hurst=0.8, rms_slope=case.slope, short_wave="8 um",
                                          long_wave="50 um", seed=case.seed, material=al }
    local c = lab.contact{ lower=face, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
    return { share=c:press{ pressure="50 MPa" }.area_fraction }
  end }
local m = t:mean("share", { by="slope" })
print(m)
m:expect("mean", { decreasing_in="slope" })
m:expect("mean", { increasing_in="slope", should_fail=true })

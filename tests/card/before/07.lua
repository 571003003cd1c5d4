-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local al = lab.material "Al-2011"
local budget = lab.budget{
  ask=function(x)
    local face = lab.surface.self_affine{ cells=x.cells, size="100 um", hurst=0.8, rms_slope=x.slope, short_wave="8 um",
                                          long_wave="50 um", seed=x.seed, material=al }
    local c = lab.contact{ lower=face, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" },
                           accuracy={ tolerance=x.tolerance } }
    return c:press{ pressure="100 MPa" }.area_fraction
  end,
  cells={ 64, 128 }, tolerance={ 1e-4, 1e-6 }, replicate={ seed={ 1, 2, 3, 4, 5 } },
  inputs={ slope={ value=0.1, u="10 %" } } }
print(budget)
print(("area fraction %.2f %% (%.2f %% to %.2f %%)"):format(100 * budget.value, 100 * budget.low, 100 * budget.high))

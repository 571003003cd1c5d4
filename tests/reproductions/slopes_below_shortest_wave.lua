-- SPDX-License-Identifier: GPL-3.0-or-later
-- A face is smooth below its shortest wave, where local slopes change from step to step. The structure function and box
-- counting report this, as the spectrum does, or give an error that covers the true value; the reason names usable steps.
local lab = require "asperity"
for _, short in ipairs{ "3.2 um", "6.4 um", "12.8 um", "25.6 um" } do
  local s = lab.surface.self_affine{ cells=512, size="512 um", hurst=0.7, ra="1 um", short_wave=short, seed=5 }
  for _, method in ipairs{ "structure", "madogram", "box" } do
    local d = s:fractal_dimension{ method=method, along="both" }
    assert(not d.resolved or math.abs(d.D - 1.3) <= 3 * d.error, method .. " on waves from " .. short)
  end
end
local s = lab.surface.self_affine{ cells=512, size="512 um", hurst=0.7, ra="1 um", short_wave="6.4 um", seed=5 }
local d = s:fractal_dimension{ method="structure", steps={ 1, 2, 4, 8, 16, 32 } }
assert(not d.resolved and d.reason:find("`steps={4, 8, 16, 32}`", 1, true), d.reason)
local believed = s:fractal_dimension{ method="structure", steps={ 4, 8, 16, 32 } }
assert(believed.resolved and math.abs(believed.D - 1.3) <= believed.error, believed.D)

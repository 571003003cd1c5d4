-- SPDX-License-Identifier: GPL-3.0-or-later
-- B4 (a): below the shortest wave a face is smooth, and its local slopes run from step to step. Wanted: structure function
-- and box counting say `resolved=false` there, as the spectrum does, or an error that covers the truth. The work on
-- parameters and files owns it.
local lab = require "asperity"
for _, short in ipairs{ "6.4 um", "12.8 um", "25.6 um" } do
  local s = lab.surface.self_affine{ cells=512, size="512 um", hurst=0.7, ra="1 um", short_wave=short, seed=5 }
  for _, method in ipairs{ "structure", "box" } do
    local d = s:fractal_dimension{ method=method, along="both" }
    local right = not d.resolved or math.abs(d.D - 1.3) <= 3 * d.error
    print((right and "holds: " or "does not hold: ") .. method .. " on waves from " .. short, d.D, d.error)
  end
end

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
for _, cells in ipairs{ 128, 64 } do
  local face = lab.surface.self_affine{ cells=cells, size="100 um", hurst=0.8, rms_slope=0.1, short_wave="4 um",
                                        long_wave="50 um", seed=1, material=lab.material "Al-2011" }
  if face.aliased_share then
    lab.say("%d cells: %.3f [%] of the variance is in waves that the grid does not carry", cells, face.aliased_share)
  else
    lab.say("%d cells: unknown", cells)
  end
end
local wm = lab.surface.weierstrass_mandelbrot{ cells=64, D=2.3, seed=1 }
print("Weierstrass-Mandelbrot, 64 cells", wm.aliased_share)

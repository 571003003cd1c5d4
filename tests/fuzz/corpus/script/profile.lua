local lab = require "asperity"
local s = lab.surface.self_affine{ cells=16, size=1e-3, hurst=0.5, rms_height=1e-6, seed=2 }
local p = s:profile{ row=3 }
print(p:roughness(), s:roughness().Ra, s:fractal_dimension{ method="psd" }.reason, s:spectrum())
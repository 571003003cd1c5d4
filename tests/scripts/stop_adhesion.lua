-- SPDX-License-Identifier: GPL-3.0-or-later
-- Ctrl-C while bodies that attract each other are drawn apart.
--! stop at: ready
--! exit: 130
--! error: interrupted
--! not output: finished
--! file: manifest.json: "status": "interrupted"
local lab = require "asperity"
io.stdout:setvbuf "no"
local s = lab.surface.self_affine{ cells=1024, size=1, hurst=0.8, rms_slope=0.3, short_wave=1/64,
  material=lab.material{ young=1, poisson=0 } }
local c = lab.contact{ lower=s, upper=lab.rigid, boundary="free", accuracy={ tolerance=1e-8 },
  effects={ elasticity="half_space", adhesion={ work=1e-4, range=1e-3 } } }
print "ready"
for _ in c:sweep{ approach={ 0.02, 0.01, 0 } } do end
print "finished"

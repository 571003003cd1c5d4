-- SPDX-License-Identifier: GPL-3.0-or-later
-- The clock is looked at within one contact of an attraction, not only between them.
--! flags: --limit-time 200ms
--! exit: 1
--! error: the time limit
--! not output: finished
--! file: manifest.json: "status": "failed"
local lab = require "asperity"
local s = lab.surface.self_affine{ cells=512, size=1, hurst=0.8, rms_slope=0.3, short_wave=1/64,
  material=lab.material{ young=1, poisson=0 } }
local c = lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", accuracy={ tolerance=1e-8 },
  effects={ elasticity="half_space", adhesion={ work=1e-4, range=1e-3 } } }
c:press{ pressure=0.02 }
print "finished"

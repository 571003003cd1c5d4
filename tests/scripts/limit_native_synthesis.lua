-- SPDX-License-Identifier: GPL-3.0-or-later
-- Work inside the engine looks at the clock too.
--! flags: --limit-time 500ms
--! exit: 1
--! error: the time limit
--! not output: finished
--! file: manifest.json: "status": "failed"
local lab = require "asperity"
lab.surface.weierstrass_mandelbrot{ cells=2048, D=2.5, gamma=1.1, M=40, n_max=4096 }
print "finished"

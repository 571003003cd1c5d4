-- SPDX-License-Identifier: GPL-3.0-or-later
-- Ctrl-C inside the engine's own work.
--! stop at: ready
--! exit: 130
--! error: interrupted
--! not output: finished
--! file: manifest.json: "status": "interrupted"
--! file: rows.csv: 1
local lab = require "asperity"
lab.notebook "rows":write{ a=1 }
io.stdout:setvbuf "no"
print "ready"
lab.surface.weierstrass_mandelbrot{ cells=8192, D=2.5, gamma=1.1, M=40, n_max=4096 }
print "finished"

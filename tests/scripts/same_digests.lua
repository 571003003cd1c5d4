-- SPDX-License-Identifier: GPL-3.0-or-later
-- The same numbers to the last bit for any number of threads, and on a second run.
--! flags: --threads 1
--! again: --threads 2
--! again: --threads 2
--! output: math.random
local lab = require "asperity"
local S = lab.surface
local al, quartz = lab.material "Al-2011", lab.material "quartz"
local function show(name, digest) print(string.format("%-24s %s", name, digest)) end

local rough = S.weierstrass_mandelbrot{ cells=150, D=2.5, seed=7, material=al }
local counter = S.weierstrass_mandelbrot{ cells=150, D=2.3, seed=8, material=quartz }
show("weierstrass_mandelbrot", rough.digest)
show("golden", S.weierstrass_mandelbrot{ cells={ 131, 96 }, D=2.7, phases="golden" }.digest)
show("resolved", S.weierstrass_mandelbrot{ cells=257, D=2.2, band="resolved" }.digest)
show("self_affine", S.self_affine{ cells=256, size="1 mm", hurst=0.8, rms_height="1 um", short_wave="16 um" }.digest)
show("self_affine, odd", S.self_affine{ cells={ 101, 97 }, size="1 mm", hurst=0.6, rms_slope=0.1, short_wave="25 um" }.digest)
show("grain", S.grain_profile{ radius="1 mm", D=1.3, points=500 }.digest)
show("scaled", rough:scaled{ rms="1 um" }.digest)
show("rotated", rough:rotated "30 deg".digest)
show("resampled", rough:resampled{ cells=211 }.digest)
show("filtered", rough:filtered{ long_wave=rough.size[1] / 5 }.digest)
show("levelled", rough:levelled{ degree=2 }.digest)
local r = rough:roughness()
show("roughness", string.format("%.17g %.17g %.17g", r.Ra, r.kurtosis, r.rms_slope))
show("spectrum", string.format("%.17g", rough:spectrum().rms_slope))
for _, method in ipairs{ "length", "psd", "structure", "box", "madogram" } do
  show("D by " .. method, string.format("%.17g", rough:fractal_dimension{ method=method }.D))
end

local c = lab.contact{ lower=rough, upper=counter, effects={ elasticity="box" } }
for st in c:sweep{ flatten={ 0.01, 0.1, 0.3, 0.05 } } do
  show("flattened " .. st.nodes_in_contact, st.digest)
  show("stiffness, energy", string.format("%.17g %.17g", st.stiffness, st.energy))
end
c:place{ seed=3 }
local st = c:press{ pressure="100 MPa" }
show("placed", st.digest)
show("field", string.format("%.17g", st:field "gap".mean))
local law = lab.friction{ tau0="500 MPa", alpha=0.2 }
show("mu", string.format("%.17g", law:on(st).mu))
local t = lab.tilt_stage{ contact=c, friction=law, mass="4.3 g", scatter=0.02 }:raise{ repeats=3, seed=5 }
show("angle", string.format("%.17g %.17g", t.angle, t.spread))
show("math.random", math.random(1 << 60))

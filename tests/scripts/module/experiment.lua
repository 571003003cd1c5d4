-- SPDX-License-Identifier: GPL-3.0-or-later
-- An experiment from surface to slip angle in a plain interpreter. Files go to the working directory.
local lab = require "asperity"
local al = lab.material "Al-2011"
local rough = lab.surface.weierstrass_mandelbrot{ cells=64, D=2.5, seed=3, material=al }
assert(rough == lab.surface.weierstrass_mandelbrot{ cells=64, D=2.5, seed=3 })
assert(rough:roughness().Ra > 0 and tostring(rough):find "^surface 64 x 64")
local c <close> = lab.contact{ lower=rough, upper=lab.rigid, effects={ elasticity="box" } }
local last = -1
for st in c:sweep{ flatten={ 0.1, 0.2, 0.4 } } do
  assert(st.area > last and st.converged)
  last = st.area
end
local st = c:press{ flatten=0.2 }
local law = lab.friction{ tau0="500 MPa", alpha=0.2 }
assert(law:on(st).mu > 0)
local t = lab.tilt_stage{ contact=c, friction=law, mass="4.3 g" }:raise{ repeats=2 }
assert(t.angle > 0 and #t.trials == 2)

local path = rough:write "rough.npy"
assert(lab.surface.read("rough.npy", { size=rough.size, unit="m" }) == rough, path)
assert(lab.surface.read(rough:write "rough.x3p"):height(3, 4) == rough:height(3, 4))
assert(io.open "rough.npy")

local book = lab.notebook "rows"
for k = 1, 3 do book:write{ k=k, mu=1 / k } end
assert(book:expect("mu", { decreasing_in="k" }))
assert(#book:rows() == 3)
assert(io.open "rows.csv", "rows.csv is in the working directory")
for name, value in lab.sorted(lab.units) do assert(type(name) == "string" and value > 0) end
assert(os.execute and io.popen and package.loadlib and debug.sethook, "nothing of the host's Lua is taken away")
assert(not getmetatable(_G), "nor are its globals made strict")
assert(select("#", ...) == 2)
kept_until_exit = { rough, c, st, law, book, c:sweep{ pressure={ 1, 2 } } }

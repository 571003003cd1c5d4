-- SPDX-License-Identifier: GPL-3.0-or-later
-- One of each kind of result, with its digest: what processors.sh compares between processors, and builds.
local lab = require "asperity"
local S = lab.surface
local al, quartz = lab.material "Al-2011", lab.material "quartz"
local soft = lab.material{ young="1 GPa", poisson=0.3, hardness="50 MPa" }
local function show(name, ...)
  local line = {}
  for _, value in ipairs{ ... } do
    line[#line + 1] = type(value) == "number" and string.format("%.17g", value) or tostring(value)
  end
  print(string.format("%-28s %s", name, table.concat(line, " ")))
end
local function numbers(name, found, ...)
  local line = {}
  for _, field in ipairs{ ... } do line[#line + 1] = found[field] end
  show(name, table.unpack(line))
end

-- Surfaces
local rough = S.weierstrass_mandelbrot{ cells=150, D=2.5, seed=7, material=al }
local counter = S.weierstrass_mandelbrot{ cells=150, D=2.3, seed=8, material=quartz }
local ground = S.self_affine{ cells=64, size="1 mm", hurst=0.8, ra="1 um", short_wave="50 um", seed=1, material=soft }
local odd = S.self_affine{ cells={ 101, 97 }, size="1 mm", hurst=0.6, rms_slope=0.1, short_wave="25 um", material=soft }
-- Sides that g++ 12 compiled to other products in a build for processors with fused operations.
local primes = {}
for _, cells in ipairs{ { 47, 71 }, { 79, 109 }, { 127, 163 } } do
  primes[#primes + 1] = S.self_affine{ cells=cells, size="1 mm", hurst=0.6, rms_slope=0.1, short_wave="60 um", material=soft }
end
local thirteens = S.self_affine{ cells={ 52, 44 }, size="1 mm", hurst=0.6, rms_slope=0.1, short_wave="60 um", material=soft }
local dome = S.sphere{ cells=63, size="1 mm", radius="2 mm", material=soft }
local wave = S.sine{ cells=60, size="1 mm", amplitude="1 um", wavelength="0.25 mm", directions=2, material=soft }
local beads = S.bead_blasted{ cells=128, size="0.6 mm", ra="3 um", seed=3, material=soft }
show("weierstrass_mandelbrot", rough.digest)
show("golden", S.weierstrass_mandelbrot{ cells={ 131, 96 }, D=2.7, phases="golden" }.digest)
show("narrow", S.weierstrass_mandelbrot{ cells={ 3, 41 }, D=2.7 }.digest)
show("self_affine", ground.digest)
show("self_affine, primes", odd.digest)
for _, tile in ipairs(primes) do show(("self_affine, %d x %d"):format(table.unpack(tile.cells)), tile.digest) end
show("sphere", dome.digest)
show("sine", wave.digest)
show("bead_blasted", beads.digest)
local grain = S.grain_profile{ radius="1 mm", D=1.3, points=500 }
show("grain_profile", grain.digest)
show("scaled", rough:scaled{ rms="1 um" }.digest)
show("rotated", rough:rotated "30 deg".digest)
show("shifted", ground:shifted{ x="10.3 um", y="7.7 um" }.digest)
show("resampled", rough:resampled{ cells=211 }.digest)
show("filtered", rough:filtered{ long_wave=rough.size[1] / 5 }.digest)
show("filtered, periodic", ground:filtered{ short_wave="60 um" }.digest)
show("levelled", rough:levelled{ degree=2 }.digest)

-- Metrology
numbers("roughness", rough:roughness(), "Ra", "Rq", "skewness", "kurtosis", "rms_slope")
numbers("spectrum", odd:spectrum(), "rms_slope", "rms_height")
local traces = lab.stylus{ tip="2 um", spacing="1 um", length="0.4 mm" }:scan(ground, { count=2, seed=2 })
show("stylus", traces[1].digest, traces[2].digest)
show("filtered profile", traces[1]:filtered{ long_wave="0.1 mm" }.digest)
for _, method in ipairs{ "length", "psd", "structure", "box", "madogram" } do
  show("D by " .. method, rough:fractal_dimension{ method=method }.D)
end

-- Contacts
local half = lab.contact{ lower=ground, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
local st = half:press{ pressure="2 MPa" }
show("half-space, periodic", st.digest)
numbers("its numbers", st, "area_fraction", "stiffness", "energy", "mean_gap")
show("half-space, primes", lab.contact{ lower=odd, upper=lab.rigid, boundary="periodic",
  effects={ elasticity="half_space" } }:press{ pressure="2 MPa" }.digest)
show("half-space, 52 x 44", lab.contact{ lower=thirteens, upper=lab.rigid, boundary="periodic",
  effects={ elasticity="half_space" } }:press{ pressure="2 MPa" }.digest)
show("half-space, 79 x 109", lab.contact{ lower=primes[2], upper=lab.rigid, boundary="periodic",
  accuracy={ precision="single", tolerance=1e-5 }, effects={ elasticity="half_space" } }:press{ pressure="2 MPa" }.digest)
show("half-space, free", lab.contact{ lower=dome, upper=lab.rigid, boundary="free",
  effects={ elasticity="half_space" } }:press{ load="1 N" }.digest)
show("half-space, capped", lab.contact{ lower=ground, upper=lab.rigid, boundary="periodic",
  effects={ elasticity="half_space", plasticity={} } }:press{ pressure="5 MPa" }.digest)
local unit = lab.material{ name="unit", young="1 Pa", poisson=0 }
local ball = S.sphere{ cells=32, size=1, radius=1, shape="paraboloid", material=unit }
show("adhesion", lab.contact{ lower=ball, upper=lab.rigid, boundary="free", accuracy={ tolerance=1e-4 },
  effects={ elasticity="half_space", adhesion={ work=0.01, range=0.05 } } }:press{ load=-0.03 }.digest)
local c = lab.contact{ lower=rough, upper=counter, effects={ elasticity="box" } }
for state in c:sweep{ flatten={ 0.01, 0.1, 0.05 } } do
  show("box", state.digest)
  numbers("its numbers", state, "stiffness", "energy")
end
c:place{ seed=3 }
local placed = c:press{ pressure="100 MPa" }
show("placed", placed.digest)

-- Friction
local law = lab.friction{ tau0="500 MPa", alpha=0.2 }
show("mu", law:on(placed).mu)
local tilt = lab.tilt_stage{ contact=c, friction=law, mass="4.3 g", scatter=0.02 }:raise{ repeats=3, seed=5 }
numbers("tilt", tilt, "angle", "spread")

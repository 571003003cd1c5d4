-- SPDX-License-Identifier: GPL-3.0-or-later
-- A weight that presses harder than the probes is solved itself: mu of the stage is the law at this weight, and a thousand
-- tonnes do not slip as a milligram does.
local lab = require "asperity"
local a = require "asperity.arguments"({ cells=64 }, ...)
local s = lab.surface.self_affine{ cells=a.cells, size="1 mm", hurst=0.8, ra="3 um", roll_off="250 um", short_wave="32 um",
  seed=1, material=lab.material "Al-2011" }
local k = lab.contact{ lower=s, upper=lab.material "quartz", boundary="periodic", effects={ elasticity="half_space" } }
local law = lab.friction{ tau0="500 MPa", alpha=.2 }
local angle = {}
for _, m in ipairs{ "1 mg", "4.3 g", "1 kg", "1000000 kg" } do
  angle[m] = lab.tilt_stage{ contact=k, friction=law, mass=m }:raise{ repeats=1 }.angle
  print(m, angle[m] / lab.units.deg)
end
assert(math.abs(angle["1 mg"] - angle["4.3 g"]) < 1e-9)
assert(angle["1000000 kg"] < 0.95 * angle["1 mg"])
local pressed = k:press{ load=1e6 * 9.80665 * math.cos(angle["1000000 kg"]) }
assert(math.abs(math.tan(angle["1000000 kg"]) - law:on(pressed).mu) < 0.02 * law:on(pressed).mu, law:on(pressed).mu)

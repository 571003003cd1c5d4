-- SPDX-License-Identifier: GPL-3.0-or-later
-- The seed of a random surface scatters approach, area and stiffness by 10 to 24 %, the cells by 1 %, the solver by a few
-- millionths. A printed state names the source of its ±, and estimates the error of the cells on request. A notebook gives
-- means with the standard uncertainty; a tilt names the source of its spread.
local lab = require "asperity"
local s = lab.surface.self_affine{ cells=128, size="1 mm", hurst=0.8, ra="1 um", roll_off="250 um", short_wave="16 um", seed=1,
  material=lab.material "Al-2011" }
local function contact(accuracy)
  return lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" }, accuracy=accuracy }
end
local c = contact()
local text = tostring(c:press{ pressure="10 MPa" })
assert(text:find("± is the solver's alone: cells, seed and inputs are not in it", 1, true), text)
text = tostring(contact{ estimate=true }:press{ pressure="10 MPa" })
assert(text:find("± is the solver's alone, ", 1, true) and text:find("seed and inputs are in neither", 1, true), text)
local book = lab.notebook "seeds"
for seed, mu in ipairs{ 0.3, 0.4, 0.5 } do book:write{ seed=seed, mu=mu, kind="same" } end
text = tostring(book:mean "mu")
assert(text:find("0.4 0.1 0.057735", 1, true) and text:find("low to high is their 95 % interval", 1, true), text)
local tilt = lab.tilt_stage{ contact=c, friction=lab.friction{ tau0="500 MPa", alpha=0.2 }, mass="4.3 g" }:raise{ repeats=2 }
assert(tilt.note:find("not other seeds or specimens", 1, true), tilt.note)

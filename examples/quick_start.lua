-- SPDX-License-Identifier: GPL-3.0-or-later
-- How does the grip of a rough aluminium plate on quartz change with the load?
--
--   asperity run examples/quick_start.lua
--
-- Real contact grows a little slower than the load, so adhesion counts for less: mu falls.
local lab = require "asperity"

local plate = lab.surface.self_affine{ cells=256, size="1 mm", hurst=0.8, ra="3 um", roll_off="250 um",
                                       short_wave="16 um", material=lab.material "Al-2011" }
local bench = lab.contact{ lower=plate, upper=lab.material "quartz", effects={ elasticity="box" } }
local law, book = lab.friction{ tau0="500 MPa", alpha=0.2 }, lab.notebook "grip"
for st in bench:sweep{ pressure={ "20 MPa", "50 MPa", "100 MPa", "150 MPa", "200 MPa" } } do
  local mu = law:on(st).mu
  print(("%3.0f MPa: %.1f %% in contact, mu = %.3f"):format(st.pressure / 1e6, 100 * st.area_fraction, mu))
  book:write{ ["pressure [Pa]"]=st.pressure, mu=mu }
end
book:expect("mu", { decreasing_in="pressure" })
book:chart{ x="pressure", y="mu" }
plate:picture("plate.png", { view="relief" })

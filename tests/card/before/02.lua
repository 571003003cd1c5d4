-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local um = lab.units.um
local al = lab.material "Al-2011"
local function disc(seed)
  return lab.surface.bead_blasted{ cells=128, size="1 mm", ra="3 um", seed=seed, material=al }
end
local pair = lab.contact{ lower=disc(1), upper=disc(2), boundary="periodic",
                          effects={ elasticity="half_space", plasticity={} } }
local book = lab.notebook("eight_presses", { columns={ "press", "Ra", "area_fraction" } })
print "press   Ra (um)   area (%)"
for n = 1, 8 do
  local st = pair:press{ pressure="150 MPa" }
  local share = st.area_fraction
  pair:release()
  local Ra = pair:lower():roughness().Ra
  book:write{ press=n, ["Ra [um]"]=Ra / um, ["area_fraction [%]"]=100 * share }
  print(("%5d   %7.4f   %8.3f"):format(n, Ra / um, 100 * share))
  pair:rotate "90 deg"
end
book:chart{ x="press", y="Ra", title="Ra of the lower disc, 150 MPa", x_label="press", file="ra.svg" }

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local law = lab.friction{ tau0="50 MPa", alpha=0.15 }
local function slips_at(row)
  local disc = lab.surface.bead_blasted{ cells=64, size="0.5 mm", ra=row.Ra, seed=1, material=lab.material "Al-2011" }
  local c = lab.contact{ lower=disc, upper=lab.rigid, boundary="periodic",
                         effects={ elasticity="half_space", plasticity={} } }
  return lab.tilt_stage{ contact=c, friction=law, mass="0.1 kg", specimen_area="100 mm^2" }:raise{}.angle
end
local both = lab.table.read "angles.csv":with{ ["computed [rad]"]=slips_at }
print(both)
local fit = both:fit{ x="Ra", y="angle", model="linear" }
print(fit)
both:chart{ x="Ra", y={ "angle", "computed" }, fit=fit, file="angles.svg" }

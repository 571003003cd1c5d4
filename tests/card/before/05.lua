-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local um, deg = lab.units.um, lab.units.deg
local al = lab.material "Al-2011"
local law = lab.friction{ tau0="50 MPa", alpha=0.15 }
local t = lab.table.read "angles.csv"
local function computed(Ra)
  local disc = lab.surface.bead_blasted{ cells=64, size="0.5 mm", ra=Ra, seed=1, material=al }
  local c = lab.contact{ lower=disc, upper=lab.rigid, boundary="periodic",
                         effects={ elasticity="half_space", plasticity={} } }
  local stage = lab.tilt_stage{ contact=c, friction=law, mass="0.1 kg", specimen_area="100 mm^2" }
  return stage:raise{}.angle
end
local book = lab.notebook "angles"
print "Ra (um)   measured (deg)   computed (deg)"
for _, row in ipairs(t:rows()) do
  local angle = computed(row.Ra)
  print(("%7.2f   %14.2f   %14.2f"):format(row.Ra / um, row.angle / deg, angle / deg))
  book:write{ ["Ra [um]"]=row.Ra / um, ["angle [deg]"]=row.angle / deg, from="measured" }
  book:write{ ["Ra [um]"]=row.Ra / um, ["angle [deg]"]=angle / deg, from="computed" }
end
local fit = book:where{ from="measured" }:fit{ x="Ra", y="angle", model="linear" }
print(fit)
local a, b = fit.parameters.intercept, fit.parameters.slope
print(("measured: intercept %.2f deg, slope %.3f deg/um (%.3f to %.3f)"):format(a.value, b.value, b.low, b.high))
book:chart{ x="Ra", y="angle", one_line_per="from", fit=fit, file="angles.svg" }

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
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
local both = t:with{ ["computed [deg]"]=function(row) return math.deg(computed(row.Ra)) end }
print(both)
local fit = both:fit{ x="Ra", y="angle", model="linear" }
print(fit)
local a, b = fit.parameters.intercept, fit.parameters.slope
lab.say("measured: intercept %.2f [deg], slope %.3f deg/um (%.3f to %.3f)", a.value,
        math.deg(b.value) * 1e-6, math.deg(b.low) * 1e-6, math.deg(b.high) * 1e-6)
local rows = {}
for _, row in ipairs(both) do
  rows[#rows + 1] = { ["Ra [um]"]=row.Ra * 1e6, ["angle [deg]"]=math.deg(row.angle), from="measured" }
  rows[#rows + 1] = { ["Ra [um]"]=row.Ra * 1e6, ["angle [deg]"]=math.deg(row.computed), from="computed" }
end
lab.table.from(rows):chart{ x="Ra", y="angle", one_line_per="from", fit=fit, file="angles.svg" }

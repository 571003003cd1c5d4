-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local um, MPa = lab.units.um, lab.units.MPa
local face = lab.surface.self_affine{ cells=128, size="100 um", hurst=0.8, rms_slope=0.1, short_wave="4 um",
                                      long_wave="50 um", seed=1, material=lab.material "Al-2011" }
local c = lab.contact{ lower=face, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
local book = lab.notebook("sweep", { columns={ "pressure", "load", "area", "area_fraction" } })
print "pressure (MPa)   load (N)   area (um^2)   area (%)"
for st in c:sweep{ pressure={ "10 MPa", "20 MPa", "40 MPa", "80 MPa", "160 MPa", "320 MPa" } } do
  book:write{ ["pressure [MPa]"]=st.pressure / MPa, ["load [N]"]=st.load, ["area [um^2]"]=st.area / um ^ 2,
              ["area_fraction [%]"]=100 * st.area_fraction }
  print(("%14.0f   %8.4f   %11.2f   %8.3f"):format(st.pressure / MPa, st.load, st.area / um ^ 2, 100 * st.area_fraction))
end
local fit = book:fit{ x="load", y="area", model="power" }
local b = fit.parameters.b
print(("exponent %.3f (%.3f to %.3f)"):format(b.value, b.low, b.high))
book:chart{ x="load", y="area", log_x=true, log_y=true, fit=fit, title="real contact area against load", file="area.svg" }

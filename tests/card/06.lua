-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local face = lab.surface.self_affine{ cells=128, size="100 um", hurst=0.8, rms_slope=0.1, short_wave="4 um",
                                      long_wave="50 um", seed=1, material=lab.material "Al-2011" }
local c = lab.contact{ lower=face, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
local t = c:sweep{ pressure={ "10 MPa", "20 MPa", "40 MPa", "80 MPa", "160 MPa", "320 MPa" } }
           :table{ "pressure [MPa]", "load [N]", "area [um^2]", "area_fraction [%]" }
print(t)
local fit = t:fit{ x="load", y="area", model="power" }
local b = fit.parameters.b
lab.say("exponent %.3f (%.3f to %.3f)", b.value, b.low, b.high)
t:chart{ x="load", y="area", log_x=true, log_y=true, fit=fit, title="real contact area against load", file="area.svg" }

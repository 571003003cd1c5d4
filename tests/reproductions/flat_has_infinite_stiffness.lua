-- SPDX-License-Identifier: GPL-3.0-or-later
-- A flat under load has no approach: its secant and tangent stiffness are infinite.
local lab = require "asperity"
local flat = lab.surface.flat{ cells=16, size="1 mm", material=lab.material "Al-2011" }
local c = lab.contact{ lower=flat, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
local st = c:press{ pressure="40 MPa" }
assert(st.secant_stiffness == math.huge, st.secant_stiffness)
assert(st.stiffness == math.huge, st.stiffness)

-- SPDX-License-Identifier: GPL-3.0-or-later
-- The script twin of press.cpp: the same press, with the same digest.
--   asperity run examples/library/press.lua
local lab = require "asperity"
local steel = lab.material "steel"
local face = lab.surface.self_affine{ cells=256, size="1 mm", hurst=0.8, rms_slope=0.1, short_wave="32 um", material=steel }
local pair = lab.contact{ lower=face, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
local st = pair:press{ pressure=1e-3 * steel.young }
lab.say("%.2f [%] of the tile touches", st.area_fraction)
print(st.digest)

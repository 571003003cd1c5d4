-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local load = lab.knob{ name="load", from="10 N", to="200 N", value="100 N" }
local disc = lab.surface.bead_blasted{ cells=128, size="1 mm", ra="3 um", seed=1, material=lab.material "Al-2011" }
local pair = lab.contact{ lower=disc, upper=lab.material "quartz", boundary="periodic",
                          effects={ elasticity="half_space", plasticity={} } }
local st = pair:press{ load=load }
print(("load %.1f N, contact %.2f %%"):format(st.load, 100 * st.area_fraction))
st:field("contact"):picture("contact.png", { title="contact" })

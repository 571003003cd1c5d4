-- SPDX-License-Identifier: GPL-3.0-or-later
-- Placeholders deep inside an options table.
--! command: check
--! output: no problem found
local lab = require "asperity"
local s = lab.surface.sine{ cells=4096, size=1, amplitude="1 um", material=lab.material "steel" }
local r = s:roughness()
local c = lab.contact{ lower=s, upper=s, effects={ elasticity={ model="box", stiffness=r.Ra } }, accuracy={ tolerance=r.Rq } }
local st = c:press{ approach=r.Ra * 2 }
lab.surface.from_table{ size={ r.Ra, st.area }, heights={ { 1, r.Ra }, { st.area, 2 } } }
local book = lab.notebook "b"
book:write{ a=r.Ra, b=st.area }
book:expect("a", { where={ a={ r.Ra, 2 } }, near=r.Ra, within=st.area })

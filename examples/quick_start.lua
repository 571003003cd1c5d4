-- SPDX-License-Identifier: GPL-3.0-or-later
-- How do eight presses change the roughness of two blasted discs?
--
--   asperity run examples/quick_start.lua
--
-- Each press flattens the summits that touch. The disc is turned between presses, so that other
-- summits touch next time. Ra falls from 2.88 to 2.33 um.
local lab = require "asperity"
local function disc(seed)
  return lab.surface.bead_blasted{ cells=256, size="1 mm", ra="3 um", seed=seed, material=lab.material "Al-2011" }
end
local pair = lab.contact{ lower=disc(1), upper=disc(2), boundary="periodic",
                          effects={ elasticity="half_space", plasticity={} } }
local book = lab.notebook "events"
for N = 1, 8 do
  pair:place{ seed=N }                -- lift the upper disc, turn it, put it down again
  pair:press{ pressure="150 MPa" }
  pair:release()
  book:write{ N=N, ["Ra [m]"]=pair:lower():roughness().Ra }
end
book:chart{ x="N", y="Ra" }
pair:lower():picture("worn.png", { view="relief" })

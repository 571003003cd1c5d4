-- SPDX-License-Identifier: GPL-3.0-or-later
-- Two blasted discs are pressed together again and again. How do they wear, and how do they grip?
--
--   asperity run examples/quick_start.lua
--
-- Each event flattens what touches; put down afresh, other ground touches. The faces lose height, and on
-- flat quartz they grip more.
local lab = require "asperity"

local aluminium, quartz = lab.material "Al-2011", lab.material "quartz"
local function disc(seed)
  return lab.surface.bead_blasted{ cells=256, size="1 mm", ra="3 um", seed=seed, material=aluminium }
end
local pair = lab.contact{ lower=disc(1), upper=disc(2), boundary="periodic",
                          effects={ elasticity="half_space", plasticity={}, creep={} } }
local law, book = lab.friction{ tau0="500 MPa", alpha=0.2 }, lab.notebook "events"
for N = 1, 8 do
  pair:place{ seed=N }
  local st = pair:press{ pressure="152.78 MPa", dwell="10 min" }
  pair:release()
  local worn = pair:lower()
  local on_quartz = lab.contact{ lower=worn, upper=quartz, boundary="periodic", effects={ elasticity="half_space" } }
  local tilt = lab.tilt_stage{ contact=on_quartz, friction=law, mass="4.3 g" }:raise{ repeats=1 }
  print(("event %d: %.1f %% yielded, Ra %.2f um, slips at %.0f deg"):format(N, 100 * st.plastic_fraction,
    worn:roughness().Ra / lab.units.um, tilt.angle / lab.units.deg))
  book:write{ N=N, ["Ra [m]"]=worn:roughness().Ra, mu=tilt.mu }
end
book:expect("Ra", { decreasing_in="N" })
book:chart{ x="N", y="Ra" }
pair:lower():picture("worn.png", { view="relief" })

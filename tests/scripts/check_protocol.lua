-- SPDX-License-Identifier: GPL-3.0-or-later
-- A dry run goes once through the loop over a protocol, whether or not its numbers are known.
--! command: check
--! output: check_protocol.lua: no problem found
--! not output: checked to line
local lab = require "asperity"
local s = lab.surface.weierstrass_mandelbrot{ cells=8192, D=2.5, n_max=4000, material=lab.material "steel" }
local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
local known = lab.protocol{ { press={ pressure="1 MPa" } }, { release=true } }
local asked = lab.protocol{ { press={ pressure=c:press{ load=1 }.pressure } }, { rotate=s:roughness().Rq } }
local turns = 0
for _, p in ipairs{ known, asked, lab.protocol.read "measured.csv", known:plus(asked):repeated{ repeats=3 } } do
  for event, st in p:on(c) do
    turns = turns + 1
    local text = event.text .. event.index .. "/" .. event.total .. st.area .. event.pressure / 1e6
    st:field "pressure":picture(event.index .. ".png")
  end
  local total = #p + p.count
  p:write "log.csv"
end
assert(turns == 4)

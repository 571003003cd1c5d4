-- SPDX-License-Identifier: GPL-3.0-or-later
-- A protocol of over a second says where it is and how long all of it will take, other work of the loop included.
--! error: protocol, event 
--! error:  of 4: press 
--! error:  %, about 
--! error:  s left
--! not error: event 1
--! output: done
local lab = require "asperity"
local s = lab.surface.sine{ cells=8, size=1, amplitude="1 mm", material=lab.material "steel" }
local c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }
local p = lab.protocol{ { press={ pressure="1 MPa" } }, { press={ pressure="2 MPa" } }, { press={ pressure="3 MPa" } }, { release=true } }
for event in p:on(c) do
  local begun = os.clock()
  while event.index < 3 and os.clock() - begun < 0.9 do end
end
print "done"

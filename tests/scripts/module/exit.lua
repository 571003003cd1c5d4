-- SPDX-License-Identifier: GPL-3.0-or-later
-- The host may close its state with everything still alive, and from the middle of a loop.
local lab = require "asperity"
local s = lab.surface.sine{ cells=32, size=1, amplitude=0.1, material=lab.material "steel" }
everything = setmetatable({ s, s:roughness(), s:profiles(), lab.notebook "open" }, { __gc=function() return s:height(0, 0) end })
lab.notebook "open":write{ a=1 }
for st in lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } }:sweep{ flatten={ 0.1, 0.2 } } do
  os.exit(st.nodes_in_contact > 0 and 0 or 1, true)
end

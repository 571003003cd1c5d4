-- SPDX-License-Identifier: GPL-3.0-or-later
-- Surfaces and states as HDF5 files with XDMF; errors name the fault of a file or call.
local lab = require "asperity"
local s = lab.surface.self_affine{ cells={24, 20}, size={"24 um", "30 um"}, hurst=0.8, rms_height="0.3 um",
                                   short_wave="4 um", seed=3 }
s:write "s.h5"
local again = lab.surface.read "s.h5"
assert(again == s and again.digest == s.digest)
assert(again.size[1] == s.size[1] and again.size[2] == s.size[2])

assert(lab.surface.read(s:write "s.gwy") == s)

local steel = lab.material{ young="210 GPa", poisson=0.3, hardness="20 GPa" }
local c = lab.contact{ lower=s:with{ material=steel }, upper=lab.rigid, boundary="periodic",
                       effects={ elasticity="half_space", plasticity={} } }
local st = c:press{ pressure="50 MPa" }
st:write "state.h5"
st:write("few.h5", { fields={ "pressure", "gap" } })
local gap = lab.surface.read("state.h5", { channel="gap" })
for j = 0, 19 do
  for i = 0, 23 do assert(gap:height(i, j) == st:field "gap":value(i, j)) end
end
assert(lab.surface.read("few.h5", { channel="gap" }) == gap)

local function says(wanted, f, ...)
  local ok, problem = pcall(f, ...)
  assert(not ok and tostring(problem):find(wanted, 1, true), tostring(problem))
end
says("and none is called `height`", lab.surface.read, "state.h5")
says("holds no map `plastic`", lab.surface.read, "few.h5", { channel="plastic" })
says("`pressure` in Pa, which is a pressure", lab.surface.read, "state.h5", { channel="pressure" })
says("use .h5", st.write, st, "state.csv")
says("did you mean `pressure`?", st.write, st, "state.h5", { fields={ "presure" } })
says("give a list of names", st.write, st, "state.h5", { fields="pressure" })
says("which holds one map", lab.surface.read, s:write "s.npy", { channel="gap", size="1 mm", unit="m" })

-- A file holds no field without its effect.
local elastic = lab.contact{ lower=s:with{ material=steel }, upper=lab.rigid, boundary="periodic",
                             effects={ elasticity="half_space" } }
elastic:press{ pressure="50 MPa" }:write "elastic.h5"
says("holds no map `plastic`", lab.surface.read, "elastic.h5", { channel="plastic" })

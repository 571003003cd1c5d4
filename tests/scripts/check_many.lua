-- SPDX-License-Identifier: GPL-3.0-or-later
-- All mistakes of a file at once, each at its line. Mistakes caught by pcall are notes, and the check continues.
--! command: check
--! exit: 1
--! error: check_many.lua:20: lab.surface has no field `self_afine` (did you mean `self_affine`?)
--! error: check_many.lua:21: lab.surface has no field `sin` (did you mean `sine`?)
--! error: check_many.lua:22: lab.surface.sine: 2 problems
--! error: unknown key `amplitud` (did you mean `amplitude`?)
--! error: check_many.lua:23: lab.surface.sine: `amplitude`: "1 MPa": a pressure where a length is wanted
--! error: check_many.lua:25: contact:press: unknown key `presure` (did you mean `pressure`?)
--! error: check_many.lua:26: a state has no field `aera` (did you mean `area`?)
--! error: check_many.lua:28: lab.material: `young`: "70 um": a length where a pressure is wanted
--! error: check_many.lua:31: a surface has no field `roughnes` (did you mean `roughness`?)
--! error: check_many.lua:33: the global `bok` was never set (did you mean `book`?)
--! error: check_many.lua:35: a surface cannot be changed (field `name`)
--! error: check_many.lua: checked to line 36: the script's path depends on a result
--! not error: traceback
--! not error: line 37
local lab = require "asperity"
local a = lab.surface.self_afine{ cells=64, size="1 mm" }
local b = lab.surface.sin{ cells=64 }
local c = lab.surface.sine{ cells=64, size="1 mm", amplitud="1 um" }
for k = 1, 3 do local d = lab.surface.sine{ cells=64, size="1 mm", amplitude="1 MPa" } end
local e = lab.contact{ lower=a, upper=b, boundary="periodic", effects={ elasticity="half_space" } }
local st = e:press{ presure="1 MPa" }
print(st.aera)
local ok, message = pcall(function()
  local m = lab.material{ young="70 um" }
  return lab.surface.flat{ cells=4, size=1, material=m }
end)
local ok, message = pcall(function() return c:roughnes() end)
book = lab.notebook "n"
bok:write{ a=1 }
local flat = lab.surface.flat{ cells=4, size=1 }
flat.name = "mine"
if st.area > 1 then
  lab.surface.sin{}
end

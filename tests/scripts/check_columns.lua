-- SPDX-License-Identifier: GPL-3.0-or-later
-- Missing columns are mistakes if the script spells every column name; otherwise they are not.
--! command: check
--! exit: 1
--! error: check_columns.lua:22: notebook:expect: no row of the notebook has a column `mew` (did you mean `mu`?)
--! error: check_columns.lua:23: notebook:chart: no row of the notebook has a column `z`
--! error: check_columns.lua:24: notebook:chart: no row of the notebook has a column `q`
--! error: check_columns.lua:25: notebook:mean: no row of the notebook has a column `w`
--! error: check_columns.lua:26: notebook:fit: no row of the notebook has a column `Rb`
--! not error: check_columns.lua:27
--! not error: check_columns.lua:3
--! not error: check_columns.lua:4
local lab = require "asperity"
local s = lab.surface.sine{ cells=64, size=1, amplitude="1 um" }
local b = lab.notebook "b"
b:expect("anything", { near=1 })  -- a dry run ignores columns before the first row
for event = 1, 3 do
  local r = s:roughness()
  b:write{ event=event, mu=r.Ra, ["Ra [um]"]=r.Ra }
  if event == 2 then b:write{ event=event, late=1 } end
end
b:expect("mew", { near=1, within=1 })
b:chart{ x="event", y="z" }
b:chart{ x="event", y={ "mu", "q" } }
b:mean "w"
b:fit{ x="event", y="Rb", model="linear" }
b:expect("Ra [um]", { near=1, within=1 }) b:expect("late", { near=1, within=1 }) b:mean("mu", { by="event" })
b:chart{ x="event", y={ "mu", "Ra" } }
-- Computed names, and rows from a table.
local c = lab.notebook "c"
for k, z in ipairs(s:heights()) do c:write{ ["p" .. k]=1 } end
c:expect("p2", { near=1, within=1 })
local d = lab.notebook "d"
local rows = lab.ensemble{ over={ seed={ 1, 2 } }, run=function(case) return { Ra=s:roughness().Ra } end }
for _, row in ipairs(rows) do d:write(row) end
d:mean "Ra" d:mean "seed"
local e = lab.notebook "e"
e:write(s:roughness().Ra)
e:mean "Ra"
local f = lab.notebook "f"
for name, value in pairs{ one=s:roughness().Ra } do f:write{ [name]=value, [name .. " more"]=1 } end
f:mean "two"

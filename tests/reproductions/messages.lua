-- SPDX-License-Identifier: GPL-3.0-or-later
-- Mistakes with a poor answer or none, each with the text required now.
--! error: little more than the mean
--! error: carry no wave so short
--! error: placing a flat upper body changes nothing
--! error: turning a flat upper body changes nothing
local lab = require "asperity"
local al = lab.material "Al-2011"
local s = lab.surface.sine{ cells=32, size="1 mm", amplitude="1 um", material=al }
local function contact(lower)
  return lab.contact{ lower=lower or s, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
end
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
refused(function() os.execute "ls" end, "os.execute")
refused(function() io.lines "nosuch" end, "nosuch")
refused(function() dofile "nosuch.lua" end, "nosuch.lua")
refused(function() contact():sweep{ pressure={} } end, "an empty list")
refused(function()
  local c = contact()
  for _ in c:sweep{ pressure={ 1e5, 2e5 } } do c:close() end
end, "of the sweep was closed inside its loop")
local closed = contact()
closed:close()
closed:close()
refused(function() lab.stylus{ speed="1 mm/s" } end, "`rate`")
local filtered = s:profile{ row=0 }:filtered{ long_wave="10 mm" }
local short = s:filtered{ short_wave="1 nm" }
contact():place{ seed=2 }
contact():rotate "90 deg"
for _, st in ipairs{ contact(s:scaled{ amplitude="10 mm" }):press{ pressure="1 kPa" }, contact():press{ pressure="500 GPa" } } do
  assert(tostring(st):find("warning", 1, true), tostring(st))
end
assert(lab.surface.sine{ cells="64", size="1 mm", amplitude="1 um" }.cells[1] == 64)
refused(function() for _ in pairs(s) do end end, "a surface is no table")
refused(function() return "1 um" + 1 end, "where a quantity is a plain SI number")
refused(function() lab.material{ hardness="100 HBW" } end, "HBW")
local book = lab.notebook "grits"
book:write{ grit="P80", Ra=1 }
book:write{ grit="P120", Ra=2 }
book:chart{ x="grit", y="Ra" }
refused(function() book:chart{ x="Ra", y="grit" } end, "holds names")

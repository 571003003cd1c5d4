-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local scan = lab.surface.read "scan.csv"
local flat = scan:levelled{ degree=1 }
for _, c in ipairs{ { "as read", scan }, { "levelled", flat } } do
  local s = c[2]
  lab.say(c[1] .. ": Ra %.3f [um]", s:roughness().Ra)
  local d = s:fractal_dimension{ method="structure", along="x" }
  if d.resolved then
    lab.say("   D %.3f, error %.3f", d.D, d.error)
  else
    print("   D is not resolved: ", d.reason)
  end
  print(d)
end

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local um = lab.units.um
local scan = lab.surface.read "scan.csv"
local flat = scan:levelled{ degree=1 }
for _, c in ipairs{ { "as read", scan }, { "levelled", flat } } do
  local s = c[2]
  print(("%s: Ra %.3f um"):format(c[1], s:roughness().Ra / um))
  local d = s:fractal_dimension{ method="structure", along="x" }
  if d.resolved then
    print(("   D %.3f, error %.3f"):format(d.D, d.error))
  else
    print("   D is not resolved: ", d.reason)
  end
  print(d)
end

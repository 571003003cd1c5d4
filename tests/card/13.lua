-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local face = lab.surface.read("scan.csv"):levelled{ degree=1 }
local p = face:profile{ row=64 }
local d = p:fractal_dimension{ method="structure" }
if d.resolved then
  lab.say("D %.3f, error %.3f: resolved", d.D, d.error)
else
  print("D is not resolved: " .. tostring(d.reason))
end

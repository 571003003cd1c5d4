-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local um = lab.units.um
local al = lab.material "Al-2011"
local function disc(seed)
  return lab.surface.bead_blasted{ cells=128, size="1 mm", ra="3 um", seed=seed, material=al }
end
local pair = lab.contact{ lower=disc(1), upper=disc(2), boundary="periodic",
                          effects={ elasticity="half_space", plasticity={} } }
local log = lab.protocol.read "press_log.csv"
local stylus = lab.stylus{ tip="2 um", spacing="1 um", length="0.8 mm" }
local press = 0
print "event   press   traced Ra (um)   Ra (um)"
local number = 0
for event, st in log:on(pair) do
  number = number + 1
  if st then press = press + 1 end
  local lower = pair:lower()
  local sum, traces = 0, stylus:scan(lower, { count=4, seed=1 })
  for _, trace in ipairs(traces) do sum = sum + trace:roughness().Ra end
  print(("%5d   %5s   %14.5f   %7.5f"):format(number, st and press or "", sum / #traces / um, lower:roughness().Ra / um))
end

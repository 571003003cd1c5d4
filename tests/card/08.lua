-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local al = lab.material "Al-2011"
local function disc(seed)
  return lab.surface.bead_blasted{ cells=128, size="1 mm", ra="3 um", seed=seed, material=al }
end
local pair = lab.contact{ lower=disc(1), upper=disc(2), boundary="periodic",
                          effects={ elasticity="half_space", plasticity={} } }
local log = lab.protocol.read "press_log.csv"
local t = log:apply(pair, { columns={ "event", "press", "trace.Ra [um]", "lower.Ra [um]" },
                            trace={ stylus=lab.stylus{ tip="2 um", spacing="1 um", length="0.8 mm" }, count=4, seed=1 } })
print(t)

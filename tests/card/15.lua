-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local face = lab.surface.self_affine{ cells=128, size="100 um", hurst=0.8, rms_slope=0.1, short_wave="4 um",
                                      long_wave="50 um", seed=1, material=lab.material "Al-2011" }
local book = lab.notebook("models", { columns={ "model", "area_fraction" }, units={ area_fraction="%" } })
local got = {}
for _, model in ipairs{ "half_space", "box" } do
  local c = lab.contact{ lower=face, upper=lab.material "quartz", boundary="periodic", effects={ elasticity=model } }
  got[model] = c:press{ pressure="50 MPa" }.area_fraction
  book:write{ model=model, area_fraction=got[model] }
end
print(book)
lab.say("half-space %.2f [%], boxes %.2f [%], ratio %.2f", got.half_space, got.box, got.box / got.half_space)

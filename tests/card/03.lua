-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local al = lab.material "Al-2011"
local law = lab.friction{ tau0="50 MPa", alpha=0.15 }
local t = lab.ensemble{
  over={ ["Ra [um]"]={ 1, 2, 4 }, seed={ 1, 2, 3, 4, 5, 6, 7, 8 } },
  run=function(case)
    local disc = lab.surface.bead_blasted{ cells=64, size="0.5 mm", ra=case.Ra, seed=case.seed, material=al }
    local c = lab.contact{ lower=disc, upper=lab.rigid, boundary="periodic",
                           effects={ elasticity="half_space", plasticity={} } }
    local st = c:press{ pressure="20 MPa" }
    return { mu=law:on(st).mu }
  end }
local m = t:mean("mu", { by="Ra" })
print(m)
m:chart{ x="Ra", y="mean", interval={ "low", "high" }, y_label="mu", title="Al on rigid quartz", file="mu.svg" }

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local al = lab.material "Al-2011"
local law = lab.friction{ tau0="50 MPa", alpha=0.15 }
local t = lab.ensemble{
  over={ factor={ 1, 2 }, ["Ra [um]"]={ 1, 2, 4 }, seed={ 1, 2, 3, 4, 5, 6, 7, 8 } },
  run=function(case)
    local disc = lab.surface.bead_blasted{ cells=64, size="0.5 mm", ra=case.Ra, seed=case.seed, material=al }
    local c = lab.contact{ lower=disc, upper=lab.rigid, boundary="periodic",
                           effects={ elasticity="half_space", plasticity={ hardness=case.factor * al.hardness } } }
    local st = c:press{ pressure="20 MPa" }
    return { mu=law:on(st).mu }
  end }
for _, f in ipairs{ 1, 2 } do
  lab.say("hardness %.2f [GPa]", f * al.hardness)
  print(t:where{ factor=f }:mean("mu", { by="Ra" }))
end
t:chart{ x="Ra", y="mu", one_line_per="factor", title="mu for hardness x 1 and x 2", file="mu_hardness.svg" }

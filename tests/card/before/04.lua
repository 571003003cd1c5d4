-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local um, GPa = lab.units.um, lab.units.GPa
local al = lab.material "Al-2011"
local law = lab.friction{ tau0="50 MPa", alpha=0.15 }
local t = lab.ensemble{
  over={ factor={ 1, 2 }, Ra={ 1e-6, 2e-6, 4e-6 }, seed={ 1, 2, 3, 4, 5, 6, 7, 8 } },
  run=function(case)
    local disc = lab.surface.bead_blasted{ cells=64, size="0.5 mm", ra=case.Ra, seed=case.seed, material=al }
    local c = lab.contact{ lower=disc, upper=lab.rigid, boundary="periodic",
                           effects={ elasticity="half_space", plasticity={ hardness=case.factor * al.hardness } } }
    local st = c:press{ pressure="20 MPa" }
    return { mu=law:on(st).mu }
  end }
local book = lab.notebook "friction"
for _, row in ipairs(t) do
  book:write{ factor=row.factor, ["Ra [um]"]=row.Ra / um, seed=row.seed, mu=row.mu }
end
for _, f in ipairs{ 1, 2 } do
  print(("hardness %.2f GPa"):format(f * al.hardness / GPa))
  print "Ra (um)   mu        low       high"
  for _, row in ipairs(book:where{ factor=f }:mean("mu", { by="Ra" }):rows()) do
    print(("%7.1f   %.5f   %.5f   %.5f"):format(row.Ra, row.mean, row.low, row.high))
  end
end
book:chart{ x="Ra", y="mu", one_line_per="factor", title="mu for hardness x 1 and x 2", file="mu_hardness.svg" }

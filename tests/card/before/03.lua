-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local um = lab.units.um
local al = lab.material "Al-2011"
local law = lab.friction{ tau0="50 MPa", alpha=0.15 }
local t = lab.ensemble{
  over={ Ra={ 1e-6, 2e-6, 4e-6 }, seed={ 1, 2, 3, 4, 5, 6, 7, 8 } },
  run=function(case)
    local disc = lab.surface.bead_blasted{ cells=64, size="0.5 mm", ra=case.Ra, seed=case.seed, material=al }
    local c = lab.contact{ lower=disc, upper=lab.rigid, boundary="periodic",
                           effects={ elasticity="half_space", plasticity={} } }
    local st = c:press{ pressure="20 MPa" }
    return { mu=law:on(st).mu }
  end }
local book = lab.notebook "friction"
for _, row in ipairs(t) do book:write{ ["Ra [um]"]=row.Ra / um, seed=row.seed, mu=row.mu } end
local m = book:mean("mu", { by="Ra" })
print "Ra (um)   mu        low       high"
for _, row in ipairs(m:rows()) do print(("%7.1f   %.5f   %.5f   %.5f"):format(row.Ra, row.mean, row.low, row.high)) end
m:chart{ x="Ra", y="mean", interval={ "low", "high" }, y_label="mu", title="Al on rigid quartz", file="mu.svg" }

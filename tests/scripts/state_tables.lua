-- SPDX-License-Identifier: GPL-3.0-or-later
-- Tables of sweeps, protocols and ensembles hold the numbers of the loops that they replace.
--! output: as it should be
local lab = require "asperity"
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
local disc = lab.surface.bead_blasted{ cells=64, size="1 mm", ra="3 um", seed=1, fine=false, material=lab.material "Al-2011" }
local function pair()
  return lab.contact{ lower=disc, upper=lab.material "quartz", boundary="periodic",
    effects={ elasticity="half_space", plasticity={} } }
end
local loads = { "10 MPa", "40 MPa" }
local rows = pair():sweep{ pressure=loads }:table{ "pressure [MPa]", "area_fraction [%]", "press" }
local k = 0
for st in pair():sweep{ pressure=loads } do
  k = k + 1
  assert(rows[k].pressure == st.pressure and rows[k].area_fraction == st.area_fraction and rows[k].press == k)
end
assert(#rows == 2 and rows.units.pressure == "MPa" and rows:max "pressure" == 40e6)
refused(function() pair():sweep{ pressure=loads }:table{ "presure" } end, "has no field `presure`", "did you mean `pressure`?")

refused(function() pair():sweep{ pressure=loads }:table{ "pressure [um]" } end,
  "column `pressure` is a pressure, and `um` is a unit of a length; write `pressure [Pa]`")
refused(function() rows:show{ "area_fraction [um]" } end, "plain number", "write `area_fraction [%]`")
refused(function() rows:chart{ x="pressure", y="area_fraction [um]" } end, "write `area_fraction [%]`")

-- Events, bodies and traces.
local stylus = lab.stylus{ tip="2 um", spacing="5 um", length="0.5 mm" }
local protocol = lab.protocol{ { press={ pressure="100 MPa" } }, { release=true } }:repeated{ repeats=2 }
local done = protocol:apply(pair(), { trace={ stylus=stylus, count=3, seed=2 },
  columns={ "event", "kind", "press", "plastic_fraction", "lower.Ra [um]", "trace.Rq" } })
local c, n = pair(), 0
for event, st in protocol:on(c) do
  n = n + 1
  local sum, row = 0, done[n]
  for _, trace in ipairs(stylus:scan(c:lower(), { count=3, seed=2 })) do sum = sum + trace:roughness().Rq end
  assert(row.event == n and row.kind == event.kind and row.plastic_fraction == (st and st.plastic_fraction))
  assert(row["lower.Ra"] == c:lower():roughness().Ra and math.abs(row["trace.Rq"] / (sum / 3) - 1) < 1e-12)
end
assert(n == 4 and done[3].press == 2 and done[2].press == nil)
-- The traces cross waves of 2 um from peak to valley.
local waves = lab.surface.from_function{ cells=512, size="1 mm", material=lab.material "Al-2011",
  height=function(x) return 1e-6 * math.sin(2 * math.pi * x / 62.5e-6) end }
local fine = lab.stylus{ tip="0.5 um", spacing="0.5 um", length="0.8 mm" }
local traced = lab.protocol{ { release=true } }:apply(
  lab.contact{ lower=waves, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } },
  { columns={ "trace.Rz", "trace.Ra" }, trace={ stylus=fine, seed=1, section="0.25 mm" } })
assert(math.abs(traced[1]["trace.Rz"] / 2e-6 - 1) < 0.03 and math.abs(traced[1]["trace.Ra"] * math.pi / 2e-6 - 1) < 0.03)
refused(function() protocol:apply(pair(), { columns={ "trace.Ra" }, trace={ stylus=stylus, section=0 } }) end, "`trace.section`")
local state = pair():press{ pressure="10 MPa" }
refused(function() state:field() end, "give pressure, gap, contact, displacement or plastic")
refused(function() return pair().area_fraction end, "a state, from contact:press, has it")
refused(function() protocol:apply(pair(), { columns={ "lover.Ra" } }) end, "did you mean `lower`?")
refused(function() protocol:apply(pair(), { columns={ "trace.Ra" } }) end, "needs a stylus")
refused(function() protocol:apply(pair(), { columns={ "pressure [um]", "lower.Ra [MPa]", "press [um]" } }) end,
  "write `pressure [Pa]`", "write `lower.Ra [m]`", "write `press` or `press [%]`")
local friction = lab.friction{ tau0="500 MPa", alpha=0.2 }
local tilt = lab.tilt_stage{ mass="50 g", specimen_area="1 cm^2", friction=friction, contact=pair() }:raise()
refused(function() tilt.trials:show{ "held [um]" } end, "write `held [rad]`")
refused(function() tilt.probes:show{ "mu [um]" } end, "write `mu` or `mu [%]`")
assert(#tilt.probes:column "area_per_load [1/MPa]" > 0)

-- Rows of an ensemble keep values that no cell holds.
local runs = lab.ensemble{ over={ D={ 2.2, 2.5 }, load={ "10 MPa" } },
  run=function(case) return { mu=case.D, s=lab.surface.flat{ cells=4, size=1 } } end }
assert(runs:mean("mu", { by="D" })[2].mean == 2.5 and runs:sum "load" == 2e7 and runs[1].s.cells[1] == 4)
assert(#runs:where{ ["load [MPa]"]=10 } == 2 and runs:sorted{ by="mu", descending=true }[1].D == 2.5)
for _, keys in ipairs{ { over={ k={ 1, 2 } } }, { over={ ["p [um]"]={ 1 } } }, { cases={ { ["p [MPa]"]=1 }, { ["p [um]"]=2 } } } } do
  keys.run = function(case) return { [case.k == 1 and "p [um]" or "p [MPa]"]=1 } end
  refused(function() lab.ensemble(keys) end, "lab.ensemble: column `p` is a", "write `p [")
end
local seen = 0
for name, value in pairs(disc:areal_parameters()) do seen = seen + (name == "Sa" and value or 0) end
assert(seen == disc:areal_parameters().Sa)
print "as it should be"

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Ground that hardens softly on long cells, under a load of which a few nodes yield: no descent balances the load; it is
-- found by the approach that brings it. Heights in 2^-15 m.
--! output: ok
local lab = require "asperity"
local steps = {
  { 2, 2, -1, -2, 1, 2 },
  { 2, 0, 1, 0, 2, 0 },
  { 1, 1, 1, 1, 2, 1 },
  { 3, 0, 3, 2, 2, 1 },
  { 1, 3, 2, -2, 1, 1 },
  { 0, 1, 3, 1, 0, 1 },
  { 2, 0, 0, 1, 1, 1 },
  { 3, 2, 2, 0, 0, 1 },
  { 0, 1, 0, 1, 0, 0 },
  { 0, 1, 2, 0, 1, 0 },
  { 0, 1, 2, 1, 0, 0 },
  { 0, 0, -1, 1, 0, 1 },
  { 1, 2, 1, 1, 0, 0 },
  { 4, 1, 2, 1, 1, 1 },
  { 1, 0, 0, 0, 2, 2 },
}
for _, row in ipairs(steps) do
  for i, n in ipairs(row) do row[i] = n * 2 ^ -15 end
end
local ground = lab.surface.from_table{ size={ 6, 0.6654804227396847 }, heights=steps,
  material=lab.material{ young=1, poisson=0, hardness=0.00016442859803615336 } }
local function bench()
  return lab.contact{ lower=ground, upper=lab.rigid, boundary="periodic",
    effects={ elasticity="half_space", plasticity={ hardening=0.0013217926025390625, hardness=0.0001220703125 } },
    accuracy={ tolerance=1e-6 } }
end
local st = bench():press{ pressure=2.5779008865356445e-06 }
assert(st.converged and st.solver:find(", for the load", 1, true), st.solver)
local again = bench():press{ approach=st.approach }
assert(math.abs(again.pressure / st.pressure - 1) < 1e-4, again.pressure)
print "ok"

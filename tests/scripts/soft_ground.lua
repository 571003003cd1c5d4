-- SPDX-License-Identifier: GPL-3.0-or-later
-- Soft hardening under a load at which a few nodes yield: solved on square cells, refused by name on long ones. Heights
-- in 2^-15 m.
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
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").anywhere
local function press(length, by)
  local ground = lab.surface.from_table{ size={ 6, length }, heights=steps,
    material=lab.material{ young=1, poisson=0, hardness=0.00016442859803615336 } }
  return lab.contact{ lower=ground, upper=lab.rigid, boundary="periodic",
    effects={ elasticity="half_space", plasticity={ hardening=0.0013217926025390625, hardness=0.0001220703125 } },
    accuracy={ tolerance=1e-6 } }:press(by)
end
local load = 2.5779008865356445e-06
refused(function() press(0.6654804227396847, { pressure=load }) end,
  "`hardening` on cells 22.5 times longer than wide did not converge in 400 transforms", "nearer to square")
local st = press(15, { pressure=load })
assert(st.converged and st.cost.transforms < 400, st.cost.transforms)
local again = press(15, { approach=st.approach })
assert(math.abs(again.pressure / st.pressure - 1) < 1e-4, again.pressure)
print "ok"

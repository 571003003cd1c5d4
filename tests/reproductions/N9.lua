-- SPDX-License-Identifier: GPL-3.0-or-later
-- N9: what `explain` says of memory is not exceeded, and not twice too much, a mebibyte apart.
local lab = require "asperity"
local m = lab.material{ young=1e11, poisson=0 }
local function compare(cells, boundary, single)
  local e = lab.contact{
    lower=lab.surface.self_affine{ cells=cells, size=1e-3, hurst=.8, rms_slope=.1, short_wave=1e-3 / 8, material=m },
    upper=lab.rigid, boundary=boundary, effects={ elasticity="half_space" }, accuracy={ precision=single and "single" or nil } }
  local said, taken = e:explain().bytes, e:press{ pressure=2e8 }.cost.bytes
  print(cells, boundary, said, taken)
  assert(taken <= said, taken .. " bytes taken of " .. said)
  assert(said <= 2 * taken + 2 ^ 20, said .. " bytes said for " .. taken)
end
for _, boundary in ipairs{ "periodic", "free" } do
  for _, cells in ipairs{ 24, 64, 97, 256 } do compare(cells, boundary) end
end

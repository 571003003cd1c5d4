-- SPDX-License-Identifier: GPL-3.0-or-later
-- A requested accuracy of 1 % holds for a ball whose contact is a few cells wide; the error on 64 cells was 1.5 %. The
-- estimate counts the edges of the contact, and grids have to agree. The true value comes from 2048 cells.
local lab = require "asperity"
local ball = lab.surface.sphere{ cells=1024, size=1e-3, radius=0.03, material=lab.material{ young=1e11, poisson=0 } }
local truth = 0.13591
for _, error in ipairs{ 0.1, 0.03, 0.01, 0.003 } do
  local c = lab.contact{ lower=ball, upper=lab.rigid, boundary="free", effects={ elasticity="half_space" },
    accuracy={ error=error } }
  local st = c:press{ pressure=4e7 }
  local off = math.abs(st.corrected_area_fraction / truth - 1)
  assert(off <= error, ("%g was asked for and %g came of %d cells"):format(error, off, st.chosen.cells[1]))
end

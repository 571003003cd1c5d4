-- SPDX-License-Identifier: GPL-3.0-or-later
-- One rough tile on a flat, four ways of giving way: how much of it really touches?
--
--   asperity run examples/how_bodies_give_way.lua
--   asperity run examples/how_bodies_give_way.lua -- cells=512
--
-- Rigid bodies that only yield bear on load/hardness of the tile, whatever its heights are: the bearing curve.
-- Boxes, each a spring of its own, yield where they are pressed far; an elastic half-space feels every load
-- everywhere and touches in proportion to the load and to one over its slope; with a hardness its steepest
-- tops yield. No experiment is claimed: the four differ by what they leave out.
-- Found: as soon as bodies may yield, the area is load/hardness within 4 to 40 %, the closer the heavier the load,
-- whether they are rigid, boxes or half-spaces; without a hardness the half-space touches a fifth to two fifths less.
-- What really touches is decided by whether bodies yield, hardly by how they spring.

local lab = require "asperity"
local arguments = require "asperity.arguments"
local options = arguments({ cells = 256, seed = 1 }, ...)

local metal = lab.material "Al-2011"
local rough = lab.surface.self_affine{ cells = options.cells, size = "500 um", hurst = 0.8, rms_slope = 0.05,
  short_wave = "16 um", seed = options.seed, material = metal }
local ways = {
  { name = "rigid, yielding", effects = { elasticity = "rigid", plasticity = {} } },
  { name = "boxes, yielding", effects = { elasticity = "box", plasticity = {} } },
  { name = "half-space, elastic", effects = { elasticity = "half_space" } },
  { name = "half-space, yielding", effects = { elasticity = "half_space", plasticity = {} } },
}

local book = lab.notebook "areas"
print "pressure/hardness   area     over load/hardness   approach, um   yielded"
for _, way in ipairs(ways) do
  print(way.name)
  for _, share in ipairs{ 0.003, 0.01, 0.03, 0.1, 0.3 } do
    local c <close> = lab.contact{ lower = rough, upper = lab.rigid, boundary = "periodic", effects = way.effects }
    local st = c:press{ pressure = share * metal.hardness }
    book:write{ way = way.name, ["pressure/hardness"] = share, area = st.area_fraction,
      ["approach [um]"] = st.approach * 1e6, yielded = way.effects.plasticity and st.plastic_fraction or 0,
      ["area of rigid"] = st.area_fraction / share }
    print(("%-17g   %.4f   %-18.3f   %-12.3f   %s"):format(share, st.area_fraction, st.area_fraction / share,
      st.approach * 1e6, way.effects.plasticity and ("%.4f"):format(st.plastic_fraction) or "-"))
  end
end
book:chart{ x = "pressure/hardness", y = "area", one_line_per = "way", log_x = true, log_y = true,
  file = "areas.svg" }

-- The bearing model is exact to the node that is only partly loaded.
book:expect("area of rigid", { where = { way = "rigid, yielding" }, at_least = 1,
  at_most = 1 + 1 / (0.003 * options.cells ^ 2) })
-- A cap can only add ground to what an elastic half-space touches, and no way bears on less than load/hardness.
book:expect("area of rigid", { where = { way = "half-space, yielding" }, at_least = 1 })
book:expect("area of rigid", { where = { way = "boxes, yielding" }, at_least = 1 })

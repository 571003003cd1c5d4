-- SPDX-License-Identifier: GPL-3.0-or-later
-- One rough tile on a flat, four ways of giving way: how much of it really touches?
--
--   asperity run examples/how_bodies_give_way.lua
--
-- If bodies yield, the area is load/hardness within 4 to 40 %, closer at heavier loads, for rigid
-- bodies, boxes and half-spaces. Without a hardness, the area of the half-space is a fifth to two
-- fifths smaller. So yield decides the area, and the elastic model hardly matters.

local lab = require "asperity"
local options = require "asperity.arguments"({ cells = 256, seed = 1 }, ...)

-- The models are compared with each other, not with an experiment. Rigid bodies follow the bearing
-- curve. Boxes are independent springs. An elastic half-space couples all nodes; its area is
-- proportional to the load over the slope.
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
for _, way in ipairs(ways) do
  for _, share in ipairs{ 0.003, 0.01, 0.03, 0.1, 0.3 } do
    local st = lab.contact{ lower = rough, upper = lab.rigid, boundary = "periodic",
      effects = way.effects }:press{ pressure = share * metal.hardness }
    book:write{ way = way.name, ["pressure/hardness"] = share, area = st.area_fraction,
      ["area of rigid"] = st.area_fraction / share, approach = st.approach,
      yielded = way.effects.plasticity and st.plastic_fraction or 0 }
  end
end
book:show{ "way", "pressure/hardness", "area", "area of rigid", "approach [um]", "yielded", digits = 4 }
book:chart{ x = "pressure/hardness", y = "area", one_line_per = "way", log_x = true, log_y = true,
  file = "areas.svg" }

-- The bearing model is exact up to one partly loaded node.
book:expect("area of rigid", { where = { way = "rigid, yielding" }, at_least = 1,
  at_most = 1 + 1 / (0.003 * options.cells ^ 2) })
-- A cap only adds area to an elastic half-space. With a cap the area is at least load/hardness.
book:expect("area of rigid", { where = { way = "half-space, yielding" }, at_least = 1 })
book:expect("area of rigid", { where = { way = "boxes, yielding" }, at_least = 1 })

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Turned bodies on a free boundary touch only where they face each other, and this overlap carries the load.
local lab = require "asperity"
local al = lab.material "Al-2011"
local function bar() return lab.surface.sphere{ cells={ 32, 128 }, size={ "1 mm", "4 mm" }, radius="10 m", material=al } end
local k = lab.contact{ lower=bar(), upper=bar(), boundary="free", effects={ elasticity="half_space" } }
k:rotate "90 deg"
local crossed = k:press{ pressure="10 MPa" }
assert(crossed.area <= 1e-6 * (1 + 1e-9), crossed.area / 1e-6 .. " mm2 touch; the bars cross on 1 mm2")
assert(math.abs(crossed.overlap_fraction - 0.25) < 1e-12, crossed.overlap_fraction)

local function dome() return lab.surface.sphere{ cells=128, size="1 mm", radius="5 m", material=al } end
local c = lab.contact{ lower=dome(), upper=dome(), boundary="free", effects={ elasticity="half_space" } }
c:rotate "45 deg"
for _, p in ipairs{ 5e6, 2e7, 8e7 } do
  local st = c:press{ pressure=p }
  assert(math.abs(st.overlap_fraction - 0.828) < 0.01, st.overlap_fraction)
  assert(st.area_fraction <= st.overlap_fraction, st.area_fraction .. " touch of " .. st.overlap_fraction)
  -- Load over the tile, carried by the overlap alone; no gap below missing nodes.
  local carried, off = 0, 0
  local pressure, gap = st:field("pressure"):values(), st:field("gap"):values()
  for j, row in ipairs(pressure) do
    for i, value in ipairs(row) do
      local missing = gap[j][i] ~= gap[j][i]
      assert(not missing or value == 0, "a load where no upper body is")
      carried, off = carried + value, off + (missing and 1 or 0)
    end
  end
  assert(math.abs(carried / 128 ^ 2 - p) < 1e-5 * p, carried / 128 ^ 2)
  assert(math.abs(1 - off / 128 ^ 2 - st.overlap_fraction) < 1e-12)
end

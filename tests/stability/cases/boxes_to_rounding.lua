-- SPDX-License-Identifier: GPL-3.0-or-later
-- Boxes: every node is a spring. The closed form must be right to rounding for every load, for ties and for
-- long sums.
--
-- In the sorted heights the solution is piecewise: d = (pN + Σ (h1 - hi))/n for the n highest. The references
-- are an independent bisection on d and two closed forms: a paraboloid, F = πkRδ² and A = 2πRδ, and heights
-- of {0, 1, 3, 6}/6.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 16, title = "Boxes to rounding", edge = "loads from 1e-12 to 1e12 of the stiffness times the"
    .. " height; all heights equal but one; ties of thousands; a paraboloid from one node to all",
  elsewhere = "The plane is found by iteration, and its tolerance shows. Sums of a million small depths lose"
    .. " digits. At a tie of many heights the count jumps, and the load jumps too.",
  here = "The heights are sorted once, and every load has a closed form without iteration. The result is"
    .. " right to rounding, with or without ties.",
}
local function contact(heights, k)
  return lab.contact{ lower = lab.surface.from_table{ size = 1, heights = heights,
    material = lab.material{ young = 1, poisson = 0 } }, upper = lab.rigid,
    effects = { elasticity = { model = "box", stiffness = k } } }
end
-- Bisection for the depth d below the highest node: the mean of max(0, d - drop) is p/k.
local function bisect(drops, mean)
  local low, high = 0, mean * #drops + drops[#drops]
  for _ = 1, 2000 do
    local d = low + (high - low) / 2
    if d == low or d == high then break end
    local sum, rest = 0, 0 -- compensated summation
    for _, drop in ipairs(drops) do
      if drop >= d then break end
      local x = d - drop
      local t = sum + x
      rest = rest + (math.abs(sum) >= x and (sum - t) + x or (x - t) + sum)
      sum = t
    end
    if (sum + rest) / #drops < mean then low = d else high = d end
  end
  return high
end
local fields = {
  { "rough", function(i, j) return math.sin(1.3 * i + 0.7 * j) + 0.4 * math.sin(5.1 * i - 2.2 * j) end },
  { "in steps of a tenth", function(i, j) return math.floor(10 * math.sin(1.3 * i + 0.7 * j)) / 10 end },
  { "one peak on a plain", function(i, j) return i == 5 and j == 7 and 1 or 0 end },
  { "one pit in a plain", function(i, j) return i == 5 and j == 7 and -1 or 0 end },
  { "over 15 decades", function(i, j) return -10.0 ^ (-15 * ((i * 37 + j * 11) % 64) / 64) end },
}
local book, n = lab.notebook "fields", 48
for _, field in ipairs(fields) do
  local rows, drops, highest = {}, {}, -math.huge
  for j = 1, n do
    rows[j] = {}
    for i = 1, n do
      rows[j][i] = field[2](i, j)
      highest = math.max(highest, rows[j][i])
    end
  end
  for j = 1, n do for i = 1, n do drops[#drops + 1] = highest - rows[j][i] end end
  table.sort(drops)
  local c, worst, residual, areas, tried = contact(rows, 1), 0, 0, 0, 0
  for decade = -12, 12, 1 do
    local p = 10.0 ^ decade * 0.37
    local st, wanted, count = c:press{ pressure = p }, bisect(drops, p), 0
    for _, drop in ipairs(drops) do if drop < wanted then count = count + 1 end end
    worst, residual, tried = math.max(worst, math.abs(st.approach / wanted - 1)),
      math.max(residual, st.residual), tried + 1
    areas = areas + (math.abs(count - st.nodes_in_contact) > 0 and 1 or 0)
  end
  book:write{ field = field[1], loads = tried, worst = worst, areas = areas, certificate = residual }
end
case:evidence(book, "Pressures from 4e-13 to 4e11 of stiffness times height on 48 x 48 nodes, against"
  .. " bisection.", { { "field", "%s" }, { "loads", "%d" },
  { "worst", "%.0e", "worst error of the approach" }, { "areas", "%d", "counts that differ" },
  { "certificate", "%.0e" } })
case:expect(book, "worst", { at_most = 2e-15 }) -- measured 2e-16
case:expect(book, "areas", { at_most = 0 })

local four = contact({ { 0, 1 / 6 }, { 0.5, 1 } }, 1)
local steps = lab.notebook "four"
for p, d in lab.sorted{ [0.05] = 0.2, [0.125] = 0.5, [0.2] = 0.65 } do
  local st = four:press{ pressure = p }
  steps:write{ p = p, d = st.approach, error = math.abs(st.approach - d), nodes = st.nodes_in_contact }
end
case:evidence(steps, "Heights 0, 1, 3, 6 sixths: the plane meets the second node at p = 0.125.",
  { { "p", "%g" }, { "d", "%.15g" }, { "error", "%.0e" },
  { "nodes", "%d" } })
case:expect(steps, "error", { at_most = 0 })

local round = lab.notebook "paraboloid"
local surface = lab.surface.sphere{ cells = 1001, size = 0.5, radius = 1, shape = "paraboloid",
  material = lab.material{ young = 1, poisson = 0 } }
local c = lab.contact{ lower = surface, upper = lab.rigid, boundary = "free",
  effects = { elasticity = { model = "box", stiffness = 1 } } }
for _, F in ipairs{ 1e-15, 1e-12, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 2e-3 } do
  local st, delta = c:press{ load = F }, math.sqrt(F / math.pi)
  local one = F < 1e-13 -- one node: d = F / (k cell)
  round:write{ F = F, nodes = st.nodes_in_contact, approach = math.abs(st.approach / (one and F / (0.5 / 1001) ^ 2
    or delta) - 1),
    area = one and 0 or math.abs(st.area / (2 * math.pi * delta) - 1),
    resolved = st.nodes_in_contact > 10000 and "yes" or "no" }
end
case:evidence(round, "A paraboloid, k = R = 1, 1001 x 1001 nodes, against F = πkRδ² and A = 2πRδ."
  .. " The first row is compared with a single box.", { { "F", "%.0e" },
  { "nodes", "%d" }, { "approach", "%.0e", "approach error" }, { "area", "%.0e", "area error" } })
case:expect(round, "approach", { where = { resolved = "yes" }, at_most = 3e-5 }) -- measured 3e-6
case:expect(round, "area", { where = { resolved = "yes" }, at_most = 1e-2 }) -- measured 1e-3
case:finish{ worst = "2e-16 of the approach", verdict = "right answer" }

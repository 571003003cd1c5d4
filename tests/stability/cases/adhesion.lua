-- SPDX-License-Identifier: GPL-3.0-or-later
-- Adhesion: the points of jump-in and pull-off, and the warning of a grid too coarse for them.
--
-- Jump-in happens at a smaller separation than pull-off. A solver that accepts any solution changes branch
-- with its starting point, and the grid pins a cohesive zone narrower than a few cells. References: Johnson,
-- Kendall & Roberts (1971) and Derjaguin, Muller & Toporov (1975), R = E* = 1, w = 0.01.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 14, title = "Adhesion", edge = "Tabor number from 0.05 to 5; approach through jump-in and"
    .. " pull-off; pull from 0 to past the pull-off; cohesive zone from 15 cells to half a cell",
  elsewhere = "The branch depends on the starting point. A pull past the pull-off ends in a wrong contact or"
    .. " never ends. With a cohesive zone of less than a cell, the grid sets the pull-off.",
  here = "Approaching and separating bodies follow their own branches. A pull past the pull-off is refused,"
    .. " and a cohesive zone below four cells gives a warning.",
}
local unit = lab.material{ name = "unit", young = "1 Pa", poisson = 0 }
local function contact(cells, size, range, model, work)
  local body = lab.surface.from_function{ cells = cells, size = size, material = unit, height = function(x, y)
    local middle = size / 2 * (1 - 1 / cells)
    return -((x - middle) ^ 2 + (y - middle) ^ 2) / 2
  end }
  return lab.contact{ lower = body, upper = lab.rigid, boundary = "free", accuracy = { tolerance = 1e-3 },
    effects = { elasticity = "half_space", adhesion = { work = work or 0.01, range = range, model = model } } }
end
local book = lab.notebook "adhesion"

-- Short range: the largest pull over prescribed approaches.
for _, model in ipairs{ "exponential", "dugdale" } do
  local c, least = contact(144, 0.9, 0.009, model), 0
  for _, approach in ipairs{ -0.03, -0.0358988, -0.042 } do
    least = math.min(least, c:press{ approach = approach, preload = 0.02 }.load)
  end
  book:write{ law = model, limit = "JKR", tabor = (0.01 ^ 2 / 0.009 ^ 3) ^ (1 / 3), pull = least,
    exact = -0.0471238898, error = math.abs(least / -0.0471238898 - 1) }
end

-- Long range: the largest pull carried, by bisection.
for _, model in ipairs{ "exponential", "dugdale" } do
  local c, held, lost = contact(96, 8, 0.95, model), -0.05, -0.07
  assert(not pcall(c.press, c, { load = lost }), "a pull past the pull-off was carried")
  while held - lost > 2e-4 do
    local middle = (held + lost) / 2
    if pcall(c.press, c, { load = middle }) then held = middle else lost = middle end
  end
  book:write{ law = model, limit = "DMT", tabor = (0.01 ^ 2 / 0.95 ^ 3) ^ (1 / 3), pull = held,
    exact = -0.0628318531, error = math.abs(held / -0.0628318531 - 1) }
end
case:evidence(book, "Pull-off of a paraboloid.", { { "law", "%s" }, { "limit", "%s" }, { "tabor", "%.3f" },
  { "pull", "%.5f", "pull-off (N)" }, { "exact", "%.5f", "theory (N)" }, { "error", "%.1e" } })
case:expect(book, "error", { at_most = 0.03 })

-- Two branches at one approach.
local c = contact(96, 0.9, 0.02, "exponential")
local branches = lab.notebook "branches"
for _, approach in ipairs{ 0.02, -0.065, -0.3 } do
  local together, apart = c:press{ approach = approach }, c:press{ approach = approach, preload = 0.05 }
  branches:write{ approach = approach, together = together.nodes_in_contact, apart = apart.nodes_in_contact,
    two = together.nodes_in_contact == apart.nodes_in_contact and 0 or 1 }
end
case:evidence(branches, "Nodes in contact of approaching bodies (together) and separating bodies (apart).",
  { { "approach", "%.3f" },
  { "together", "%d" }, { "apart", "%d" } })
local rows = branches:rows()
assert(rows[2].together == 0 and rows[2].apart > 0, "at -0.065 there are two branches")
assert(rows[3].together == 0 and rows[3].apart == 0, "at -0.3 nothing touches")

case:refused("a pull past the pull-off", function() contact(64, 8, 0.95, "dugdale"):press{ load = -0.07 } end,
  "the bodies separate")
case:refused("a range of 0", function() contact(16, 1, 0, "dugdale") end, "range")
case:refused("a negative work", function() contact(16, 1, 1, "dugdale", -1) end, "work")
case:refused("a press by `flatten`", function() contact(16, 1, 1, "dugdale"):press{ flatten = 0.5 } end,
  "`flatten`")
case:refused("a preload without attraction", function()
  contact(16, 1, 1, "dugdale", 0):press{ approach = 0, preload = 1 }
end, "nothing attracts")
assert(tostring(contact(144, 0.9, 0.009, "dugdale"):explain()):find("below four", 1, true),
  "no warning of a coarse grid")
case:finish{ worst = "3 % from theory", verdict = "right answer, then a clear error" }

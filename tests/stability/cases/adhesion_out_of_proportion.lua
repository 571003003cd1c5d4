-- SPDX-License-Identifier: GPL-3.0-or-later
-- Attraction far too strong, too short or too weak: every press must end.
--
-- The solver alternates between the attraction and its gap, and a snap is a step of any size. If the traction
-- exceeds the modulus, or the range is far below the cells or far above the tile, the steps may shrink
-- without end or cycle. Each press here is of a sphere on a coarse grid. The script checks every answer
-- against its own sums; a refusal must name the reason.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 23, title = "Attraction out of proportion",
  edge = "work from 1e-30 to 1e30 J/m^2, range from 1e-30 to 1e30 m,"
    .. " traction at touch up to 100 times the modulus, pull and load from 1e-30 to 1e30 N,"
    .. " approach from -1e30 to 1e30 m, humidity from 1e-300 to 1 - 2^-53, 1 to 31 cells a side",
  elsewhere = "The solver shrinks its steps without end or alternates between two contacts, and the run never"
    .. " returns. Or the last iterate is returned as an answer.",
  here = "Every press ends in a contact with balanced forces, or in an error with the reason. Reasons are"
    .. " an attraction over a hundred times the modulus, separating bodies, overflow, or a remaining"
    .. " difference between attraction and gap, with the number of tangents.",
}
local tolerance = 1e-4
local unit = lab.material{ name = "unit", young = "1 Pa", poisson = 0 }
local reasons = { "over a hundred times", "the bodies separate", "overflow", "the attraction and the gap agree",
  "is in full contact at", "too little for a finite height", "outside the range of numbers" }

local function body(cells)
  return lab.surface.sphere{ cells = cells, size = { 1, 1 }, radius = 1, shape = "paraboloid", material = unit }
end
local function contact(effects, boundary, cells)
  effects.elasticity = "half_space"
  return lab.contact{ lower = body(cells or 15), upper = lab.rigid, boundary = boundary, effects = effects,
    accuracy = { tolerance = tolerance } }
end

-- Counts the outcome of a press. An answer is compared with its own forces and with the attraction at its
-- gaps.
local function judged(row, make, press, traction)
  row.asked = row.asked + 1
  local ok, st = pcall(function() return make():press(press) end)
  if not ok then
    for _, reason in ipairs(reasons) do
      if tostring(st):find(reason, 1, true) then
        row.refused = row.refused + 1
        return
      end
    end
    print("unexpected: " .. tostring(st))
    row.unexplained = row.unexplained + 1
    return
  end
  row.answered = row.answered + 1
  row.transforms = math.max(row.transforms, st.cost.transforms)
  local carried, pulled, cells = 0, 0, 0
  local gap = st:field "gap":values()
  for j, line in ipairs(st:field "pressure":values()) do
    for i, p in ipairs(line) do
      assert(p >= 0 and gap[j][i] >= 0)
      carried, pulled, cells = carried + p, pulled + traction(gap[j][i]), cells + 1
    end
  end
  local scale = math.max(carried / cells, pulled / cells, math.abs(st.load))
  if scale > 0 then
    row.balance = math.max(row.balance, math.abs(carried / cells - st.load - st.attraction) / scale)
    row.law = math.max(row.law, math.abs(pulled / cells - st.attraction) / math.max(scale, traction(0)))
  end
end
local book = lab.notebook "out of proportion"
local function sweep(name, each)
  local row = { sweep = name, asked = 0, answered = 0, refused = 0, unexplained = 0, transforms = 0, balance = 0,
    law = 0 }
  for _, boundary in ipairs{ "free", "periodic" } do each(row, boundary) end
  book:write(row)
end
local function law_of(work, range, model)
  if model == "dugdale" then -- falls linearly from 0.5 to 1.5 times the range
    return function(g) return work / range * math.min(1, math.max(0, 1.5 - g / range)) end
  end
  return function(g) return work / range * math.exp(-g / range) end
end
local function adhering(row, boundary, work, range, press, cells)
  for _, model in ipairs{ "exponential", "dugdale" } do
    judged(row, function()
      return contact({ adhesion = { work = work, range = range, model = model } }, boundary, cells)
    end, press, law_of(work, range, model))
  end
end

sweep("work", function(row, boundary)
  for decade = -30, 30, 4 do
    adhering(row, boundary, 10.0 ^ decade, 0.1, { load = 0.01 })
    adhering(row, boundary, 10.0 ^ decade, 0.1, { approach = -0.05, preload = 0.02 })
  end
end)
sweep("range", function(row, boundary)
  for decade = -30, 30, 4 do
    adhering(row, boundary, 0.01, 10.0 ^ decade, { load = 0.01 })
    adhering(row, boundary, 10.0 ^ (decade - 1), 10.0 ^ decade, { approach = -0.01, preload = 0.02 })
  end
end)
sweep("traction", function(row, boundary)
  for _, traction in ipairs{ 1, 10, 100 } do
    for _, range in ipairs{ 1, 0.1, 0.01, 1e-3, 1e-5 } do
      adhering(row, boundary, traction * range, range, { load = 0.01 })
      adhering(row, boundary, traction * range, range, { approach = -0.01, preload = 0.01 })
    end
  end
end)
sweep("load", function(row, boundary)
  for decade = -30, 30, 6 do
    adhering(row, boundary, 0.01, 0.1, { load = 10.0 ^ decade })
    adhering(row, boundary, 0.01, 0.1, { load = -10.0 ^ decade })
  end
end)
sweep("approach", function(row, boundary)
  for decade = -30, 30, 6 do
    adhering(row, boundary, 0.01, 0.1, { approach = 10.0 ^ decade })
    adhering(row, boundary, 0.01, 0.1, { approach = -10.0 ^ decade })
  end
end)
sweep("cells", function(row, boundary)
  for _, cells in ipairs{ 1, 2, 3, { 1, 8 }, { 7, 2 }, 31 } do
    adhering(row, boundary, 0.01, 0.1, { load = 0.01 }, cells)
    adhering(row, boundary, 0.01, 1e-3, { load = 0 }, cells)
  end
end)
sweep("humidity", function(row, boundary)
  for _, humidity in ipairs{ 1e-300, 1e-3, 0.5, 0.999, 1 - 2.0 ^ -30, 1 - 2.0 ^ -53 } do
    for _, young in ipairs{ 1, 1e6, 1e12 } do
      local pressure = 8.31446261815324 * 293.15 * -math.log(humidity) / 1.8e-5
      judged(row, function()
        local stiff = lab.material{ name = "stiff", young = young, poisson = 0 }
        return lab.contact{ lower = body(15):with{ material = stiff }, upper = lab.rigid, boundary = boundary,
          accuracy = { tolerance = tolerance },
          effects = { elasticity = "half_space", capillarity = { humidity = humidity } } }
      end, { pressure = 0.01 * young }, law_of(2 * 0.0728, 2 * 0.0728 / pressure, "dugdale"))
    end
  end
end)
case:evidence(book, "Presses of a paraboloid of radius 1 on a tile of 1 x 1, E* = 1. The last columns"
    .. " are maxima over the answers: transforms, and the relative errors of sums over an answer against its"
    .. " forces and its law.",
  { { "sweep", "%s" }, { "asked", "%d", "presses" }, { "answered", "%d" }, { "refused", "%d" },
    { "unexplained", "%d" },
    { "transforms", "%.0f" }, { "balance", "%.0e" }, { "law", "%.0e" } })
case:expect(book, "unexplained", { near = 0, within = 0 })
case:expect(book, "balance", { at_most = 1e-6 })
case:expect(book, "law", { at_most = 10 * tolerance })
case:refused("1e30 J/m^2 within 1 nm", function()
  contact({ adhesion = { work = 1e30, range = 1e-9 } }, "periodic"):sweep{ approach = { -1e-6, 0, 1e-6 } }
end, "over a hundred times the contact modulus")

-- A sweep follows its branch: pull-off comes later than jump-in, and separated bodies stay separate.
local loop = lab.notebook "loop"
local there = { -0.3, -0.08, -0.065, 0.02, -0.065, -0.08, -0.3, -0.08, -0.065 }
local c = lab.contact{ lower = lab.surface.from_function{ cells = 48, size = 0.9, material = unit,
  height = function(x, y) return -((x - 0.44) ^ 2 + (y - 0.44) ^ 2) / 2 end }, upper = lab.rigid,
  boundary = "free", accuracy = { tolerance = 1e-4 },
  effects = { elasticity = "half_space", adhesion = { work = 0.01, range = 0.02 } } }
for st in c:sweep{ approach = there } do
  loop:write{ approach = st.approach, turns = #st.preload, contacts = st.nodes_in_contact, load = st.load }
end
case:evidence(loop, "A sweep of an adhering paraboloid: together, apart and together again.",
  { { "approach", "%.3f" }, { "turns", "%d", "turning points of the preload" }, { "contacts", "%d" },
    { "load", "%.4f" } })
local rows = loop:rows()
case:holds("on approach, nothing touches at -0.065", rows[3].contacts == 0)
case:holds("on separation, the bodies touch at -0.065", rows[5].contacts > 0)
case:holds("after pull-off nothing touches, and the load at -0.065 is the load of the first approach",
  rows[8].contacts == 0 and rows[9].contacts == 0
  and math.abs(rows[9].load / rows[3].load - 1) < 1e-3)
case:finish{ worst = "1e-4 of the law", verdict = "right answer, then a clear error" }

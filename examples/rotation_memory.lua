-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does a pressed surface remember? Why turning the specimens counts, and the stress hardly does.
--
--   asperity run examples/rotation_memory.lua
--
-- In pairs 1 to 4 of both kinds, a second event yields 0.69 to 0.96 of the first after a turn, and
-- less than 1e-6 without a turn. Yielded ground keeps 0.72 to 0.84 of the slope at any stress,
-- and less after each further turn. Real area per load is proportional to 1/slope, so friction on a
-- flat depends little on stress and rises with the turns (paper/fig7_tilt.lua).

local lab = require "asperity"
local laboratory = require "asperity.laboratory"

local options = require "asperity.arguments"({ kind = "self-affine", pair = 1, cells = 256, events = 8 }, ...)
local lower, upper = laboratory.specimens(options)
local virgin = lower:heights()

-- Among the nodes whose value in `map` is chosen: the remaining share of the virgin slope between
-- neighbours, and the share of these nodes in all nodes.
local function left(surface, map, chosen)
  local heights, count, now, before = surface:heights(), 0, 0, 0
  for j, row in ipairs(map) do
    for i, value in ipairs(row) do
      if chosen(value) then
        count = count + 1
        for _, at in ipairs{ { j, i + 1 }, { j + 1, i } } do
          local k, l = at[1], at[2]
          if map[k] and map[k][l] and chosen(map[k][l]) then
            now = now + (heights[k][l] - heights[j][i]) ^ 2
            before = before + (virgin[k][l] - virgin[j][i]) ^ 2
          end
        end
      end
    end
  end
  return math.sqrt(now / before), count / options.cells ^ 2
end
local function yielded(depth) return depth > 0 end

-- 1. One event at each stress: the slope left on yielded ground. Yielded material disappears; no
--    pile-up is modelled. Each yielded face becomes half of the difference, (z1 - z2)/2. If the
--    slopes cross at random, the slope falls to 1/sqrt(2) at any stress. Touching summits lean
--    against each other, so a little more is left.
local stresses = lab.notebook("stress", { units = { stress = "MPa" } })
lab.say("What a %s surface remembers: pair %d, %d x %d cells", options.kind, options.pair, options.cells,
  options.cells)
for _, stress in ipairs(laboratory.stresses) do
  local bench = laboratory.bench(lower, upper)
  local st = bench:press{ pressure = stress }
  bench:release()
  local slope, area = left(bench:lower(), st:field "plastic":values(), yielded)
  stresses:write{ stress = stress, area = area, ["slope left"] = slope, ["at random"] = 0.5 ^ 0.5 }
end
print "\nOne event at each stress: the area that yielded, and the slope left there"
stresses:show{ "stress [MPa]", "area", "slope left", digits = 5 }

-- 2. Events at 152.78 MPa, without a turn or with a new placement before each event but the first.
--    After several turns the two faces are correlated, and the slope falls more slowly. `times` is
--    the number of yields of each node.
local lying, turned = laboratory.bench(lower, upper), laboratory.bench(lower, upper)
local events, times, first = lab.notebook "events", (lower - lower):heights(), nil
for N = 1, options.events do
  if N > 1 then turned:place{ seed = 100 * options.pair + N } end
  local lain, st = lying:press(laboratory.event), turned:press(laboratory.event)
  lying:release()
  turned:release()
  first = first or { lain = lain.plastic_volume, turned = st.plastic_volume }
  local depth = st:field "plastic":values()
  for j, row in ipairs(times) do
    for i, n in ipairs(row) do row[i] = n + (yielded(depth[j][i]) and 1 or 0) end
  end
  events:write{ N = N, ["slope left"] = left(turned:lower(), depth, yielded),
    ["left lying"] = lain.plastic_volume / first.lain, turned = st.plastic_volume / first.turned }
end
print "\nEvents at 152.78 MPa: volume taken over the first, and slope left where it yielded now, turned"
events:show{ "N", "left lying", "turned", "slope left", digits = 3 }

-- 3. Nodes sorted by their number of yields: each contact leaves about 1/sqrt(2) = 0.71 of the
--    slope. Over pairs 1 to 4 of both kinds, ground that yielded once has 0.68 to 0.75 left, and
--    ground that yielded twice 0.52 to 0.57.
local contacts = lab.notebook "contacts"
for k = 1, options.events do
  local slope, area = left(turned:lower(), times, function(n) return n == k end)
  if area > 0.01 then
    contacts:write{ times = k, area = area, ["slope left"] = slope, ["at random"] = 0.5 ^ (k / 2) }
  end
end
print "\nNodes that yielded so many times, and 0.71 to that power"
contacts:show{ "times", "area", "slope left", "at random", digits = 3 }

-- 4. Eight turns without load change nothing.
local bench = laboratory.bench(lower, upper)
for seed = 1, 8 do
  bench:place{ seed = seed }
  bench:press{ pressure = 0 }
  bench:release()
end
local same = bench:lower().digest == lower.digest and bench:upper().digest == upper.digest
local unloaded = lab.notebook "unloaded"
unloaded:write{ same = same and 1 or 0 }
print("\nEight turns without load leave both surfaces " .. (same and "as they were." or "CHANGED."))

-- 5. Expectations.
unloaded:expect("same", { at_least = 1, label = "eight turns without load leave both surfaces bit for bit" })
stresses:expect("slope left", { at_least = 0.65, at_most = 0.85,
  label = "one contact leaves about 1/sqrt(2) of the slope, whatever the stress" })
events:expect("slope left", { decreasing_in = "N" })
contacts:expect("slope left", { where = { times = { 1, 2, 3 } }, decreasing_in = "times" })
if options.events >= 8 then
  contacts:expect("slope left", { where = { times = 2 }, near = 0.5, within = 0.1 })
end
for N = 2, options.events do
  local where = { N = N }
  events:expect("left lying", { where = where, at_most = 1e-4, label = "a repeated event takes nothing" })
  events:expect("turned", { where = where, at_least = 0.1, label = "after a turn it takes more" })
end
events:expect("left lying", { where = { N = 2 }, at_least = 0.1, should_fail = true,
  label = "control: without a turn the second event takes more" })

-- 6. The charts.
stresses:chart{ x = "stress", y = { "slope left", "at random" }, file = "slope_by_stress.svg",
  title = "Slope left where one event yielded" }
contacts:chart{ x = "times", y = { "slope left", "at random" }, file = "slope_by_contacts.svg",
  title = "Slope left where a node yielded so many times" }
events:chart{ x = "N", y = { "turned", "left lying" }, file = "volume_by_events.svg",
  title = "Volume taken by events at 152.78 MPa", y_label = "volume taken / by the first" }

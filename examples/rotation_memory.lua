-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does a pressed surface remember? Why turning the specimens counts, and the stress hardly does.
--
--   asperity run examples/rotation_memory.lua
--   asperity run examples/rotation_memory.lua -- pair=2 kind=bead-blasted
--   asperity run examples/rotation_memory.lua -- cells=512 events=12
--
-- A pressed specimen remembers where the other lay: the same event again finds both faces fitting, and
-- takes nothing (less than 1e-6 of the first). Lift, turn and put down, and ground meets that does not fit:
-- the second event takes 0.69 to 0.96 of the first (8 specimens: pairs 1 to 4 of both kinds). The memory is
-- in the slopes. Where two faces yield, each becomes half their difference, (z1 - z2)/2, so that its slope
-- falls to 1/sqrt(2) if the slopes cross at random, whatever the stress: 0.72 to 0.84 is found, from 20 to
-- 204 MPa, since summits that meet lean against each other a little. With every turn the same happens
-- again: after eight events, nodes that yielded once keep 0.68 to 0.75 of their slope, twice 0.52 to 0.57;
-- then the two faces are no longer strangers, and the fall slows down. Real area per load goes with one
-- over slope: so friction on a flat depends little on stress and rises with the number of turns
-- (paper/fig7_tilt.lua). Turning alone changes nothing: after eight turns without load both surfaces are
-- what they were, bit for bit.
-- Not predicted: what is carried off or piled up. What yields is taken away.

local lab = require "asperity"
local arguments = require "asperity.arguments"
local laboratory = require "asperity.laboratory"
local MPa = lab.units.MPa

local options = arguments({ kind = "self-affine", pair = 1, cells = 256, events = 8 }, ...)
local lower, upper = laboratory.specimens(options)
local virgin = lower:heights()

-- The nodes at which something holds of a field, with their share of all; and how much of the virgin slope
-- is left between neighbours among such nodes.
local function choose(field, holds)
  local nodes, count = {}, 0
  for j, row in ipairs(field) do
    nodes[j] = {}
    for i, value in ipairs(row) do
      nodes[j][i] = holds(value)
      if nodes[j][i] then count = count + 1 end
    end
  end
  return nodes, count / (#field * #field[1])
end
local function yielded(st)
  return choose(st:field "plastic":values(), function(depth) return depth > 0 end)
end
local function slope_left(heights, nodes)
  local now, before = 0, 0
  local function add(j, i, k, l)
    now = now + (heights[k][l] - heights[j][i]) ^ 2
    before = before + (virgin[k][l] - virgin[j][i]) ^ 2
  end
  for j, row in ipairs(nodes) do
    for i, chosen in ipairs(row) do
      if chosen and row[i + 1] then add(j, i, j, i + 1) end
      if chosen and nodes[j + 1] and nodes[j + 1][i] then add(j, i, j + 1, i) end
    end
  end
  return math.sqrt(now / before)
end

-- 1. One event at each stress: where it yielded, how much of the slope is left?
local stresses = lab.notebook "stress"
stresses:units{ stress = "Pa" }
print(("What a %s surface remembers: pair %d, %d x %d cells\n"):format(options.kind, options.pair,
  options.cells, options.cells))
print "One event at     area that yielded   slope left there"
for _, stress in ipairs(laboratory.stresses) do
  local bench = laboratory.bench(lower, upper)
  local st = bench:press{ pressure = stress }
  bench:release()
  local nodes, share = yielded(st)
  local left = slope_left(bench:lower():heights(), nodes)
  stresses:write{ stress = stress, area = share, ["slope left"] = left, ["at random"] = math.sqrt(0.5) }
  print(("  %6.2f MPa           %.3f               %.2f"):format(stress / MPa, share, left))
end

-- 2. Events at 152.78 MPa, the upper specimen left lying or put down afresh before each but the first.
local function go_through(turning)
  local steps = {}
  for N = 1, options.events do
    if N > 1 and turning then table.insert(steps, { place = { seed = 100 * options.pair + N } }) end
    table.insert(steps, { press = laboratory.event })
    table.insert(steps, { release = true })
  end
  local bench, found = laboratory.bench(lower, upper), {}
  for event, st in lab.protocol(steps):on(bench) do
    if event.kind == "press" then
      table.insert(found, { taken = st.plastic_volume, yielded = yielded(st) })
    elseif event.kind == "release" then
      found[#found].heights = bench:lower():heights()
    end
  end
  return found
end
local lying, turned = go_through(false), go_through(true)

local events = lab.notebook "events"
local times = choose(virgin, function() return 0 end) -- how often each node has yielded
print "\nEvents at        volume taken / by the first     slope left, turned,"
print "152.78 MPa       left lying       turned         where it yielded now"
for N, event in ipairs(turned) do
  for j, row in ipairs(event.yielded) do
    for i, now in ipairs(row) do times[j][i] = times[j][i] + (now and 1 or 0) end
  end
  local row = { N = N, ["left lying"] = lying[N].taken / lying[1].taken,
    turned = event.taken / turned[1].taken, ["slope left"] = slope_left(event.heights, event.yielded) }
  events:write(row)
  print(("  %2d              %-7.2g          %.3f                 %.2f"):format(N, row["left lying"],
    row.turned, row["slope left"]))
end

-- 3. The same nodes sorted by how often they have yielded: each contact leaves about 1/sqrt(2) = 0.71.
local contacts = lab.notebook "contacts"
print "\nNodes that yielded so many times    share of the area    slope left    0.71 to that power"
for count = 1, options.events do
  local nodes, share = choose(times, function(n) return n == count end)
  if share > 0.01 then
    local left, random = slope_left(turned[options.events].heights, nodes), 2 ^ (-count / 2)
    contacts:write{ times = count, area = share, ["slope left"] = left, ["at random"] = random }
    print(("  %d                                      %.3f              %.2f             %.2f"):format(count,
      share, left, random))
  end
end

-- 4. No load, no change: eight turns, pressed with nothing.
local bench = laboratory.bench(lower, upper)
for seed = 1, 8 do
  bench:place{ seed = seed }
  bench:press{ pressure = 0 }
  bench:release()
end
local same = bench:lower().digest == lower.digest and bench:upper().digest == upper.digest
local unloaded = lab.notebook "unloaded"
unloaded:write{ same = same and 1 or 0 }
print("\nEight turns without load leave both surfaces "
  .. (same and "as they were, bit for bit." or "CHANGED."))

-- 5. What must hold. The slope left is 1/sqrt(2) where two surfaces cross at random; it is more because
--    summits that meet lean against each other, and so it is looked for between 0.65 and 0.85.
unloaded:expect("same", { at_least = 1, label = "eight turns without load leave both surfaces bit for bit" })
stresses:expect("slope left", { at_least = 0.65, at_most = 0.85,
  label = "one contact leaves about 1/sqrt(2) of the slope, whatever the stress" })
events:expect("slope left", { decreasing_in = "N" })
contacts:expect("slope left", { where = { times = { 1, 2, 3 } }, decreasing_in = "times" })
if options.events >= 8 then
  contacts:expect("slope left", { where = { times = 2 }, near = 0.5, within = 0.1 })
end
for N = 2, options.events do
  events:expect("left lying", { where = { N = N }, at_most = 1e-4, label = "a repeated event takes nothing" })
  events:expect("turned", { where = { N = N }, at_least = 0.1, label = "after a turn it takes more" })
end
events:expect("left lying", { where = { N = 2 }, at_least = 0.1, should_fail = true,
  label = "control: without a turn the second event takes more" })

-- 6. The figures.
stresses:chart{
  x = "stress", y = { "slope left", "at random" }, file = "slope_by_stress.svg",
  title = "Slope left where one event yielded", x_label = "stress of the event", y_label = "slope left",
}
contacts:chart{
  x = "times", y = { "slope left", "at random" }, file = "slope_by_contacts.svg",
  title = "Slope left where a node yielded so many times", x_label = "times a node yielded",
  y_label = "slope left",
}
events:chart{
  x = "N", y = { "turned", "left lying" }, file = "volume_by_events.svg",
  title = "Volume taken by events at 152.78 MPa", x_label = "number of events N",
  y_label = "volume taken / by the first",
}
print "\nDrawn: slope_by_stress.svg, slope_by_contacts.svg, volume_by_events.svg."

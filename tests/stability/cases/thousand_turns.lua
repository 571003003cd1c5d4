-- SPDX-License-Identifier: GPL-3.0-or-later
-- A thousand events with turns between them: do the turns themselves change the surfaces?
--
-- A map turned by any angle but a quarter falls between nodes. A program that resamples the map at every turn
-- averages neighbours and flattens the surface without load. D and Ra then fall with the number of events,
-- which is the effect under study. Here surfaces stay in their own frame. Their relative position is an angle
-- and whole cells, and only the yielded shape is transferred.

local lab = require "asperity"
local laboratory = require "asperity.laboratory"
local case = require "asperity.hard_case"{
  number = 10, title = "A thousand turns", edge = "1 to 1000 turns without load; a full turn in 1 to"
    .. " 1000 steps; 1 to 1000 events",
  elsewhere = "Surfaces are resampled at every turn, and each resampling averages neighbours. A thousand"
    .. " turns without load remove all of D - 1, and the reported wear is caused by interpolation.",
  here = "Turns change no bit of a surface. A full turn in any number of steps is the identity. Over a"
    .. " thousand events, the height lost equals the plastic volume of the events.",
}

-- 1. Turns without load, compared with interpolation at every turn.
local rough = lab.surface.self_affine{ cells = 96, size = "100 um", hurst = 0.8, ra = "1 um",
  short_wave = "6.25 um", material = lab.material "Al-2011" }
local function excess(s)
  return s:fractal_dimension{ method = "length", along = "both", wrap = true, offsets = true, pooled = true,
    steps = { 1, 2, 4, 8, 16 } }.D - 1
end
local book = lab.notebook "turns"
local bench = lab.contact{ lower = rough, upper = rough, boundary = "periodic",
  effects = { elasticity = "half_space", plasticity = {} } }
local resampled, virgin, roughness = rough, excess(rough), rough:roughness().Rq
local marks = { [1] = true, [2] = true, [5] = true, [8] = true, [10] = true, [20] = true, [50] = true,
  [100] = true, [200] = true, [500] = true, [1000] = true }
local unchanged = true
for turn = 1, 1000 do
  bench:place{ seed = turn }
  resampled = laboratory.interpolated(resampled, 1):levelled{ degree = 0 }
  if marks[turn] then
    unchanged = unchanged and bench:upper().digest == rough.digest and bench:lower().digest == rough.digest
    book:write{ turns = turn, ["here"] = excess(bench:upper()) / virgin,
      ["resampled at every turn"] = excess(resampled) / virgin,
      ["Rq here"] = bench:upper():roughness().Rq / roughness,
      ["Rq resampled"] = resampled:roughness().Rq / roughness }
  end
end
case:evidence(book, "D - 1 and Rq after turns without load, over the virgin values, 96 x 96 nodes.",
  { { "turns", "%d" },
  { "here", "%.3f", "D - 1 here" }, { "resampled at every turn", "%.3f", "D - 1 resampled" },
  { "Rq here", "%.3f" }, { "Rq resampled", "%.3f" } })
case:expect(book, "here", { near = 1, within = 0 })
case:expect(book, "Rq here", { near = 1, within = 0 })
case:expect(book, "resampled at every turn", { where = { turns = 8 }, at_least = 0.9, should_fail = true,
  label = "interpolation keeps D - 1" })
case:chart(book, "D - 1 left against the number of turns without load",
  { x = "turns", y = { "here", "resampled at every turn" }, log_x = true,
  title = "D - 1 left after turns without load", y_label = "D - 1 over the virgin value",
  file = "kept.svg" })
case:holds("1000 turns without load leave both surfaces unchanged, bit for bit", unchanged)

-- 2. A full turn in several steps on a free boundary, then a press: the same as without turns.
local function free_bench()
  return lab.contact{ lower = rough:resampled{ cells = 24 }, upper = rough:mirrored():resampled{ cells = 24 },
    boundary = "free",
    effects = { elasticity = "half_space", plasticity = {} } }
end
local first = free_bench():press{ pressure = "40 MPa" }
local same = {}
for _, steps in ipairs{ 1, 2, 3, 4, 6, 7, 8, 11, 12, 36, 97, 100, 360, 997, 1000 } do
  local c = free_bench()
  for _ = 1, steps do c:rotate(2 * math.pi / steps) end
  local found = c:press{ pressure = "40 MPa" }
  if found.digest == first.digest then table.insert(same, tostring(steps)) else same.no = true end
end
case:holds("a full turn in " .. table.concat(same, ", ") .. " steps is the identity: the next press is"
  .. " the same, bit for bit", not same.no)
local back = free_bench()
for k = 1, 1000 do back:rotate(math.sin(k)) end
for k = 1000, 1, -1 do back:rotate(-math.sin(k)) end
case:holds("after 1000 turns by odd angles and the same turns back, the next press is the same, bit for bit",
  back:press{ pressure = "40 MPa" }.digest == first.digest)

-- 3. A thousand events: the height lost equals the plastic volume of the events.
local events = lab.notebook "events"
local function go(name, c, turn, last, pressure, stops)
  local lower, upper = c:lower(), c:upper()
  local tile, taken, negative, worst = lower.size[1] * lower.size[2], 0, 0, 0
  local function means(a, b) return a:roughness().mean + b:roughness().mean end
  local began, Ra, ra = means(lower, upper), lower:roughness().Ra, nil
  for N = 1, last do
    if N > 1 then turn(c, N) end
    local st = c:press{ pressure = pressure }
    if not (st.plastic_volume >= 0) then negative = negative + 1 end
    taken, worst = taken + st.plastic_volume, math.max(worst, st.residual)
    c:release()
    if stops[N] then
      local now = c:lower()
      ra = now:roughness().Ra
      events:write{ bench = name, N = N, Ra = ra / Ra, taken = taken / tile / Ra, certificate = worst,
        negative = negative,
        balance = math.abs((began - means(now, c:upper())) * tile / taken - 1) }
    end
  end
end
local function specimen(seed, cells)
  return lab.surface.self_affine{ cells = cells, size = "250 um", hurst = 0.8, ra = "3 um",
    short_wave = "40 um", seed = seed,
    material = lab.material "Al-2011" }
end
local function pair(cells, boundary)
  return lab.contact{ lower = specimen(1, cells), upper = specimen(2, cells), boundary = boundary,
    effects = { elasticity = "half_space", plasticity = {} }, accuracy = { tolerance = 1e-8 } }
end
go("placed afresh", pair(32, "periodic"), function(c, N) c:place{ seed = N } end, 1000, "152.78 MPa",
  { [1] = true, [2] = true, [4] = true, [8] = true, [30] = true, [100] = true, [300] = true, [1000] = true })
go("turned by 137.5 degrees", pair(24, "free"), function(c) c:rotate "137.5 deg" end, 300, "152.78 MPa",
  { [1] = true, [2] = true, [8] = true, [30] = true, [100] = true, [300] = true })
case:evidence(events, "Events at 152.78 MPa: Ra over the initial Ra, plastic volume per area over the initial Ra, and"
  .. " the relative difference between the height lost and the plastic volume.",
  { { "bench", "%s" }, { "N", "%d" }, { "Ra", "%.3f", "Ra left" }, { "taken", "%.3f", "taken over Ra" },
    { "balance", "%.0e", "volume error" },
    { "certificate", "%.0e", "worst certificate" } })
case:expect(events, "balance", { at_most = 2e-14 }) -- measured 2e-15
case:expect(events, "negative", { at_most = 0 })
case:expect(events, "certificate", { at_most = 1e-8 }) -- the requested tolerance
case:finish{ worst = "turns change no bit; 2e-15 of the volume over 1000 events", verdict = "right answer" }

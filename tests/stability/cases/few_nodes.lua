-- SPDX-License-Identifier: GPL-3.0-or-later
-- Small contacts: one to ten nodes in contact, equal peaks, flats, single nodes, no load.
--
-- On a free half-space the displacement of one cell under uniform pressure is Love's closed form (1929).
-- Spikes of one node each, far above all other nodes, need a system of as many equations as spikes. This
-- script solves the system by elimination, independently of the program.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 3, title = "One to ten nodes", edge = "one to ten spikes of equal and unequal height; two"
    .. " peaks from equal to one ulp apart; flats; grids of 1 x 1; no load",
  elsewhere = "Relative tolerances over all nodes hide errors in a few nodes. One of two equal peaks takes"
    .. " all the load. A flat is divided by its own roughness, zero. No load gives zero over zero.",
  here = "Pressures and approach of the spikes agree with elimination to rounding. Equal peaks share the load"
    .. " equally to the last digits. A flat carries its load uniformly.",
}

local n, cell, E = 32, 1, 1 -- the spikes are so high that no other node touches

-- Love: displacement at (x, y) by a cell of side 1 under unit pressure, E* = 1.
local function love(x, y)
  local function corner(a, b)
    local r = math.sqrt(a * a + b * b)
    local function part(u, v) return u == 0 and 0 or u * math.log(v + r) end
    return part(a, b) + part(b, a)
  end
  local a, b, c, d = x + 0.5, x - 0.5, y + 0.5, y - 0.5
  return (corner(a, c) - corner(a, d) - corner(b, c) + corner(b, d)) / math.pi
end

-- Pressures p and approach δ with Σ_k love(i, k) p_k = δ - (highest - h_i), Σ p = total.
local function eliminate(spikes, total)
  local N, rows, highest = #spikes, {}, 0
  for _, s in ipairs(spikes) do highest = math.max(highest, s[3]) end
  for i, s in ipairs(spikes) do
    rows[i] = {}
    for k, t in ipairs(spikes) do rows[i][k] = love(s[1] - t[1], s[2] - t[2]) end
    rows[i][N + 1], rows[i][N + 2] = -1, s[3] - highest
  end
  rows[N + 1] = {}
  for k = 1, N do rows[N + 1][k] = 1 end
  rows[N + 1][N + 1], rows[N + 1][N + 2] = 0, total
  N = N + 1
  for k = 1, N do
    local pivot = k
    for r = k + 1, N do if math.abs(rows[r][k]) > math.abs(rows[pivot][k]) then pivot = r end end
    rows[k], rows[pivot] = rows[pivot], rows[k]
    for r = 1, N do
      if r ~= k then
        local f = rows[r][k] / rows[k][k]
        for c = k, N + 1 do rows[r][c] = rows[r][c] - f * rows[k][c] end
      end
    end
  end
  local answer = {}
  for k = 1, N do answer[k] = rows[k][N + 1] / rows[k][k] end
  return answer, answer[N]
end

local unit = lab.material{ young = E, poisson = 0 }
local function bench(spikes, boundary, tolerance)
  local heights = {}
  for j = 1, n do heights[j] = {} for i = 1, n do heights[j][i] = 0 end end
  for _, s in ipairs(spikes) do heights[s[2] + 1][s[1] + 1] = 1 + s[3] end
  return lab.contact{ lower = lab.surface.from_table{ size = n, heights = heights, material = unit },
    upper = lab.rigid,
    boundary = boundary or "free", effects = { elasticity = "half_space" },
    accuracy = { tolerance = tolerance or 1e-14 } }
end

-- 1. Spikes at fixed places, first of equal height, then each a little lower than the previous one.
local places = { { 3, 5 }, { 27, 20 }, { 14, 9 }, { 15, 9 }, { 6, 28 }, { 22, 3 }, { 11, 17 }, { 11, 18 },
  { 12, 17 }, { 30, 30 } }
local book, total = lab.notebook "spikes", 0.1
for _, drop in ipairs{ 0, 1e-9, 1e-4 } do
  local spikes = {}
  for count, place in ipairs(places) do
    spikes[count] = { place[1], place[2], -(count - 1) * drop }
    local wanted, approach = eliminate(spikes, total)
    local st = bench(spikes):press{ load = total }
    local P, worst = st:field "pressure", 0
    for k, s in ipairs(spikes) do worst = math.max(worst, math.abs(P:value(s[1], s[2]) / wanted[k] - 1)) end
    book:write{ drop = drop, spikes = count, nodes = st.nodes_in_contact, ["pressure error"] = worst,
      ["approach error"] = math.abs(st.approach / approach - 1), iterations = st.iterations,
      certificate = st.residual,
      right = st.nodes_in_contact == count and 1 or 0 }
  end
end
for _, drop in ipairs{ 0, 1e-4 } do
  case:evidence(book, drop == 0 and "Spikes of equal height under a load of 0.1 E* cell²."
    or "Spikes, each 1e-4 cells lower than the previous one.", { { "spikes", "%d" }, { "nodes", "%d" },
    { "pressure error", "%.0e" }, { "approach error", "%.0e" }, { "iterations", "%d" },
    { "certificate", "%.0e" } },
    { drop = drop })
end
case:expect(book, "right", { at_least = 1 })
case:expect(book, "pressure error", { at_most = 7e-13 }) -- measured 7e-14
case:expect(book, "approach error", { at_most = 2e-13 }) -- measured 2e-14

-- 2. Two peaks, from equal heights until the higher carries all: the lower takes half, less, then nothing.
local pair = lab.notebook "pair"
local a0, a1 = love(0, 0), love(8, 3)
for _, apart in ipairs{ 0, 2 ^ -52, 1e-12, 1e-6, 1e-3, 0.1, 0.5, 1 } do
  local gone = total * (a0 - a1) -- the difference at which the lower peak leaves contact
  local d = apart <= 2 ^ -52 and apart or apart * gone
  local st = bench{ { 8, 8, 0 }, { 16, 11, -d } }:press{ load = total }
  local high, low = st:field "pressure":value(8, 8), st:field "pressure":value(16, 11)
  local wanted = math.max(0, (total - d / (a0 - a1)) / 2)
  pair:write{ apart = apart == 2 ^ -52 and "one ulp" or ("%g"):format(apart):gsub("e%-0", "e-"),
    low = low / total, high = high / total,
    error = math.abs(low - wanted) / total, nodes = st.nodes_in_contact, certificate = st.residual }
end
case:evidence(pair, "Load shares of two peaks, from equal heights until the higher carries all.",
  { { "apart", "%s" }, { "high", "%.12f", "the higher carries" }, { "low", "%.12f", "the lower carries" },
    { "error", "%.0e" }, { "nodes", "%d" }, { "certificate", "%.0e" } })
case:expect(pair, "error", { at_most = 2e-14 }) -- measured 2e-15

-- 3. Flats, single nodes, no load.
for _, boundary in ipairs{ "periodic", "free" } do
  local flat = lab.contact{ lower = lab.surface.flat{ cells = 7, size = 1, material = unit },
    upper = lab.rigid,
    boundary = boundary, effects = { elasticity = "half_space" } }
  local st = flat:press{ pressure = 0.5 }
  case:holds(("%s flat of 7 x 7 nodes: every node touches and the load is carried"):format(boundary),
    st.nodes_in_contact == 49 and math.abs(st.load / 0.5 - 1) < 1e-15 and st.converged)
  local node = lab.contact{ lower = lab.surface.flat{ cells = 1, size = 1, material = unit },
    upper = lab.rigid,
    boundary = boundary, effects = { elasticity = "half_space" } }
  st = node:press{ pressure = 1e-3 }
  local sunk = boundary == "periodic" and 0 or 1e-3 * love(0, 0)
  case:holds(("%s grid of one node: approach %s"):format(boundary,
    boundary == "periodic" and "0, because it has no waves"
    or "of Love's formula to 1e-15"), st.nodes_in_contact == 1 and math.abs(st.approach - sunk) <= 1e-15 * sunk)
  local idle = bench({ { 3, 5, 0 } }, boundary):press{ pressure = 0 }
  case:holds(("%s, no load: nothing touches, approach and energy are 0, converged"):format(boundary),
    idle.nodes_in_contact == 0 and idle.approach == 0 and idle.energy == 0 and idle.converged
      and idle.area_fraction == 0)
end
local flat = lab.surface.flat{ cells = 4, size = 1, material = unit }
case:refused("boxes on a flat, without a stiffness", function()
  lab.contact{ lower = flat, upper = lab.rigid, effects = { elasticity = "box" } }
end, "all combined heights are equal")
case:holds("boxes on a flat, with a stiffness, carry p/k at every node", (function()
  local st = lab.contact{ lower = flat, upper = lab.rigid, effects = { elasticity = { model = "box",
    stiffness = 8 } } }
    :press{ pressure = 2 }
  return st.nodes_in_contact == 16 and st.approach == 0.25 and st.energy == 0.25
end)())

case:finish{ worst = "7e-14 of a pressure", verdict = "right answer" }

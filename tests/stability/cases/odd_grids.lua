-- SPDX-License-Identifier: GPL-3.0-or-later
-- 1 to 1024 cells a side, primes, single rows, cells a thousand times longer than wide: does any grid behave
-- differently?
--
-- Three closed forms. A wave pressed past full contact carries p = p̄ + (E*|q|/2) z on any grid. A wave half
-- in contact touches over the share (2/π) asin √f (Westergaard). A single node on a free boundary sinks by
-- Love's formula for a rectangle a x b: (2/π)(p/E*)(a asinh(b/a) + b asinh(a/b)).

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 12, title = "Odd grids", edge = "1 to 1024 cells a side, including primes, n x 1 and 1 x n;"
    .. " cells up to 1000 times longer than wide",
  elsewhere = "The Nyquist wave of an even grid is treated as one of a pair. Odd grids are padded. Primes"
    .. " fall back to a slow or less exact transform. Single rows are untested.",
  here = "Pressures at full contact are right to rounding on every grid, in two iterations. Areas are"
    .. " right to one node a side.",
}

local h, unit = 0.01, lab.material{ young = 1, poisson = 0 }
local function bench(options, boundary, tolerance)
  options.material, options.amplitude = unit, h
  return lab.contact{ lower = lab.surface.sine(options), upper = lab.rigid, boundary = boundary or "periodic",
    effects = { elasticity = "half_space" }, accuracy = { tolerance = tolerance or 1e-12 } }
end

-- 1. Full contact: p - p̄ against the wave, at each node of one row and one column.
local full = lab.notebook "full"
local function flattened(cells)
  local nx, ny = cells[1], cells[2]
  local both = nx > 2 and ny > 2 -- a wave along y needs three rows
  local q = both and math.sqrt(2) or 1
  local peak = q * math.pi * h -- E*|q|/2 h
  local st = bench({ cells = cells, size = { 1, both and 1 or ny / nx }, directions = both and 2 or 1,
    wavelength = 1 }):press{ pressure = 2 }
  local P, worst = st:field "pressure", 0
  local function compare(i, j)
    local z = math.cos(2 * math.pi * i / nx) * (both and math.cos(2 * math.pi * j / ny) or 1)
    worst = math.max(worst, math.abs(P:value(i, j) - 2 - peak * z))
  end
  for i = 0, nx - 1 do compare(i, ny // 2) end
  for j = 0, ny - 1 do compare(nx // 3, j) end
  return { error = worst / peak, ["per node"] = worst / peak / nx, iterations = st.iterations,
    certificate = st.residual,
    open = nx * ny - st.nodes_in_contact }
end
for name, second in lab.sorted{ ["n x 1, n from 2 to 300"] = function() return 1 end,
  ["n x n, n from 2 to 96"] = function(n) return n end,
  ["n x (n + 1), n from 2 to 96"] = function(n) return n + 1 end } do
  local worst
  for n = 2, second(1) == 1 and second(2) == 1 and 300 or 96 do
    local row = flattened{ n, second(n) }
    worst = worst or row
    for key, value in pairs(row) do worst[key] = math.max(worst[key], value) end
  end
  worst.cells = name
  full:write(worst)
end
local sides = { { 2, 1 }, { 2, 2 }, { 3, 3 }, { 5, 4 }, { 13, 17 }, { 61, 1 }, { 64, 64 }, { 97, 101 },
  { 127, 128 }, { 251, 256 },
  { 509, 8 }, { 512, 512 }, { 997, 3 }, { 1009, 1 }, { 1021, 1021 }, { 1024, 1024 }, { 65521, 1 } }
for _, cells in ipairs(sides) do
  local row = flattened(cells)
  row.cells = ("%d x %d"):format(cells[1], cells[2])
  full:write(row)
end
case:evidence(full, "Full contact at 45 times the load of full contact: largest error of a pressure, relative to"
  .. " the largest pressure of the wave. The rounding errors of the heights are pressed flat too. Their"
  .. " pressures increase as cells become shorter.",
  { { "cells", "%s" }, { "error", "%.0e" }, { "open", "%d", "open nodes" }, { "iterations", "%d" },
    { "certificate", "%.0e" } })
case:expect(full, "per node", { at_most = 3e-14 }) -- measured 3e-15
case:expect(full, "iterations", { at_most = 2 })
case:expect(full, "open", { at_most = 0 })

-- 2. Half contact on lines along x and y and on sheets: the width by Westergaard, to a node a side.
local half = lab.notebook "half"
for _, nx in ipairs{ 5, 8, 17, 64, 97, 128, 251, 509, 1021, 1024 } do
  local row = { nx = nx, iterations = 0, certificate = 0 }
  local wanted = nx * 2 / math.pi * math.asin(math.sqrt(0.3))
  for name, cells in lab.sorted{ ["n x 1"] = { nx, 1 }, ["n x 7"] = { nx, 7 }, ["n x 12"] = { nx, 12 } } do
    local st = bench{ cells = cells, size = { 1, cells[2] / nx } }:press{ pressure = 0.3 * math.pi * h }
    row[name] = math.abs(st.nodes_in_contact / cells[2] - wanted)
    row.iterations, row.certificate = math.max(row.iterations, st.iterations),
      math.max(row.certificate, st.residual)
  end
  -- The same wave along y: a table turned by a quarter.
  local heights = {}
  for j = 1, nx do heights[j] = { h * math.cos(2 * math.pi * (j - 1) / nx) } end
  local st = lab.contact{ lower = lab.surface.from_table{ size = { 1 / nx, 1 }, heights = heights,
    material = unit }, upper = lab.rigid,
    boundary = "periodic", effects = { elasticity = "half_space" },
    accuracy = { tolerance = 1e-12 } }:press{ pressure = 0.3 * math.pi * h }
  row["1 x n"] = math.abs(st.nodes_in_contact - wanted)
  half:write(row)
end
case:evidence(half, "A wave at 0.3 of the load of full contact: error of the contact width, in nodes.",
  { { "nx", "%d", "n" }, { "n x 1", "%.1f" },
  { "1 x n", "%.1f" }, { "n x 7", "%.1f" }, { "n x 12", "%.1f" }, { "iterations", "%d" },
  { "certificate", "%.0e" } })
-- measured 1.4: a node a side
for _, column in ipairs{ "n x 1", "1 x n", "n x 7", "n x 12" } do case:expect(half, column,
  { at_most = 2 }) end

-- 3. Cells and tiles longer than wide: one node by Love's rectangle, and full contact.
local long = lab.notebook "aspect"
local function asinh(x) return math.log(x + math.sqrt(x * x + 1)) end
for _, aspect in ipairs{ 1, 1.5, 10, 100, 1000 } do
  local heights = {}
  for j = 1, 9 do heights[j] = {} for i = 1, 11 do heights[j][i] = 0 end end
  heights[4][7] = 1
  local a, b, p = aspect, 1, 1e-4
  local st = lab.contact{ lower = lab.surface.from_table{ size = { 11 * a, 9 * b }, heights = heights,
    material = unit }, upper = lab.rigid,
    boundary = "free", effects = { elasticity = "half_space" },
    accuracy = { tolerance = 1e-12 } }:press{ load = p * a * b }
  local sunk = 2 / math.pi * p * (a * asinh(b / a) + b * asinh(a / b))
  local n = 32
  local wave = bench{ cells = n, size = { 1, 1 / aspect }, wavelength = 1 }:press{ pressure = 1 }
  local across = lab.surface.from_function{ cells = n, size = { 1, 1 / aspect }, material = unit,
    height = function(_, y) return h * math.cos(2 * math.pi * y * aspect) end }
  local steep = lab.contact{ lower = across, upper = lab.rigid, boundary = "periodic",
    effects = { elasticity = "half_space" },
    accuracy = { tolerance = 1e-12 } }:press{ pressure = 100 * aspect }
  long:write{ aspect = aspect, love = math.abs(st.approach / sunk - 1),
    along = math.abs((wave.peak_pressure - 1) / (math.pi * h) - 1),
    across = math.abs((steep.peak_pressure - 100 * aspect) / (math.pi * h * aspect) - 1), nodes = st.nodes_in_contact,
    iterations = math.max(st.iterations, wave.iterations, steep.iterations),
    certificate = math.max(st.residual, wave.residual, steep.residual) }
end
case:evidence(long, "Cells longer than wide: the approach of one node on a free boundary against Love's rectangle, and"
  .. " the peaks of waves along and across the cells at full contact.", {
  { "aspect", "%g" }, { "love", "%.0e", "approach error, one node" },
  { "along", "%.0e", "peak error, along" }, { "across", "%.0e", "peak error, across" },
  { "iterations", "%d" }, { "certificate", "%.0e" } })
case:expect(long, "love", { at_most = 8e-13 }) -- measured 8e-14
-- measured 3e-13: rows are transformed in pairs, and the stiffness across rows amplifies the rounding
case:expect(long, "along", { at_most = 4e-12 })
case:expect(long, "across", { at_most = 4e-12 }) -- measured 4e-13
case:expect(long, "nodes", { near = 1, within = 0 })

-- 4. White noise on long cells: lines along the short side are nearly independent contacts.
local noise = lab.notebook "noise"
for _, boundary in ipairs{ "periodic", "free" } do
  for _, aspect in ipairs{ 1e-3, 0.01, 1 / 30, 1, 30, 100, 1000 } do
    local x = 1
    local s = lab.surface.from_function{ cells = 96, size = { 1e-3, 1e-3 * aspect },
      material = lab.material{ young = 1e11, poisson = 0 },
      height = function() x = x * 16807 % 2147483647 return 1e-7 * x / 2147483647 end }
    local ok, st = pcall(function()
      return lab.contact{ lower = s, upper = lab.rigid, boundary = boundary,
        effects = { elasticity = "half_space" }, accuracy = { tolerance = 1e-6 } }:press{ pressure = 1e8 }
    end)
    if not ok then print(st) end
    noise:write{ boundary = boundary, aspect = aspect, solved = ok and 1 or 0,
      transforms = ok and st.cost.transforms or 0, certificate = ok and st.residual or 1 }
  end
end
case:evidence(noise, "White noise on 96 x 96 cells, longer than wide or wider than long, tolerance 1e-6. If a contact"
  .. " on long cells does not converge, the error names the aspect of the cells.",
  { { "boundary", "%s" }, { "aspect", "%.3g" }, { "solved", "%d" }, { "transforms", "%.0f" },
    { "certificate", "%.0e" } })
case:expect(noise, "solved", { at_least = 1 })
case:expect(noise, "transforms", { at_most = 400 }) -- measured 263, at 1000:1 on a free boundary

-- 5. The same noise with hardening: solved within 400 transforms, or refused with the aspect of the cells.
local soft = lab.notebook "soft"
for _, hardening in ipairs{ 2e14, 2e15, 2e16 } do
  for _, aspect in ipairs{ 0.01, 0.1, 10, 30, 100, 300, 1000 } do
    local x = 5
    local s = lab.surface.from_function{ cells = 96, size = { 1e-3 * math.max(1, 1 / aspect), 1e-3 * math.max(1, aspect) },
      material = lab.material{ young = 1e11, poisson = 0 },
      height = function() x = x * 16807 % 2147483647 return 1e-7 * x / 2147483647 end }
    local ok, st = pcall(function()
      return lab.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
        effects = { elasticity = "half_space", plasticity = { hardness = 2e8, hardening = hardening } } }
        :press{ pressure = 1e8 }
    end)
    assert(ok or hardening < 1e15 and tostring(st):find("times longer than wide", 1, true), st)
    soft:write{ hardening = hardening, aspect = aspect, solved = ok and 1 or 0,
      transforms = ok and st.cost.transforms or 0, certificate = ok and st.residual or 1 }
  end
end
case:evidence(soft, "White noise on 96 x 96 long cells with hardening, in Pa/m. E*/cell is 1e16 Pa/m along the short side."
  .. " A press takes at most 400 transforms or is refused. Refusals occur at a fiftieth of E*/cell, on some of"
  .. " the long cells.",
  { { "hardening", "%.0e" }, { "aspect", "%.3g" }, { "solved", "%d" }, { "transforms", "%.0f" },
    { "certificate", "%.0e" } })
case:expect(soft, "transforms", { at_most = 400 })
for _, hardening in ipairs{ 2e15, 2e16 } do
  case:expect(soft, "solved", { where = { hardening = hardening }, at_least = 1 })
end

case:holds("a grid of one node carries the load without approach", (function()
  local st = lab.contact{ lower = lab.surface.flat{ cells = 1, size = 1, material = unit }, upper = lab.rigid,
    boundary = "periodic",
    effects = { elasticity = "half_space" } }:press{ pressure = 2 }
  return st.nodes_in_contact == 1 and st.peak_pressure == 2 and st.approach == 0
end)())
for _, cells in ipairs{ 0, -1, 1.5, 65537, 2.0 ^ 53 } do
  case:refused(("cells = %.17g"):format(cells), function() lab.surface.flat{ cells = cells, size = 1 } end,
    "`cells`")
end
case:refused("cells = {3}", function() lab.surface.flat{ cells = { 3 }, size = 1 } end, "`cells`")
case:finish{ worst = "3e-15 of the peak times the nodes a side", verdict = "right answer" }

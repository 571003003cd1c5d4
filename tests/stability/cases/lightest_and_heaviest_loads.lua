-- SPDX-License-Identifier: GPL-3.0-or-later
-- Loads from the smallest double to the largest: each is solved, or refused by name.
--
-- Under the lightest loads one node carries all. It sinks in proportion to the load over all decades of a
-- double: on a free half-space by Love's closed form, on boxes by load/(k cell). Below 1e-280 of the modulus
-- products underflow, and the load is refused. Under the heaviest loads every node touches. The pressures
-- then differ from the mean by the pressures that flatten the surface, which are negligible.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 5, title = "Lightest and heaviest loads", edge = "load from the smallest double, 5e-324 N,"
    .. " to the largest, 1.8e308 N",
  elsewhere = "A light load is below an absolute tolerance and touches nothing, or its approach is lost in"
    .. " the rounding of the heights. The lightest loads underflow to zero over zero.",
  here = "From 1e-280 of the modulus on, one node sinks in proportion to the load to the last digits. A"
    .. " smaller load is refused by name, and so is a load past the range of a double.",
}

local n, cell, modulus = 32, 1e-6, 100e9
local heights = {}
for j = 1, n do heights[j] = {} for i = 1,
  n do heights[j][i] = 1e-7 * math.sin(1.7 * i + 2.3 * j) * math.sin(0.9 * i - 0.4 * j) end end
heights[12][20] = 3e-7
local surface = lab.surface.from_table{ size = n * cell, heights = heights,
  material = lab.material{ young = modulus, poisson = 0, hardness = 2e9 } }
local function bench(effects)
  return lab.contact{ lower = surface, upper = lab.rigid, boundary = "free", effects = effects }
end
local k = 1e15 -- Pa/m
local scenes = {
  { name = "half-space", effects = { elasticity = "half_space" } },
  { name = "half-space with a cap", effects = { elasticity = "half_space", plasticity = {} } },
  { name = "half-space with hardening", effects = { elasticity = "half_space",
    plasticity = { hardening = 8e13 } } },
  { name = "boxes", effects = { elasticity = { model = "box", stiffness = k } } },
}
local love = 4 * math.log(1 + math.sqrt(2)) / math.pi / (modulus * cell) -- m/N on one cell
local tile = (n * cell) ^ 2
local book = lab.notebook "light"
for _, scene in ipairs(scenes) do
  local bench, per_newton = bench(scene.effects), scene.name == "boxes" and 1 / (k * cell * cell) or love
  local tried, solved, refused, silent, worst, energy, residual, least = 0, 0, 0, 0, 0, 0, 0, math.huge
  local load = 2.0 ^ -1074
  while load < 1e-6 do
    tried = tried + 1
    local ok, st = pcall(bench.press, bench, { load = load })
    if ok then
      solved, least = solved + 1, math.min(least, load)
      worst = math.max(worst, math.abs(st.approach / (load * per_newton) - 1))
      if load > 1e-140 then energy = math.max(energy,
        math.abs(st.energy / (0.5 * load * load * per_newton) - 1)) end
      residual = math.max(residual, st.residual)
      if st.nodes_in_contact ~= 1 or st.load == 0 then silent = silent + 1 end
    elseif st:find("1e-280 of", 1, true) then
      refused = refused + 1
    else
      silent = silent + 1
    end
    load = load * (load < 1e-280 and 1000 or load < 1e-270 and 2 or 1000)
  end
  book:write{ scene = scene.name, tried = tried, solved = solved, refused = refused, neither = silent,
    least = least / tile / modulus, worst = worst, energy = energy, certificate = residual }
end
case:evidence(book, "Loads from 5e-324 N to 1e-6 N on one node: approach and, above 1e-140 N,"
  .. " energy against the closed form.",
  { { "scene", "%s" }, { "tried", "%d", "loads" }, { "refused", "%d" }, { "solved", "%d" },
  { "neither", "%d" }, { "least", "%.0e", "least solved, p/E*" }, { "worst", "%.0e", "approach error" },
  { "energy", "%.0e", "energy error" }, { "certificate", "%.0e" } })
case:expect(book, "neither", { at_most = 0 })
case:expect(book, "worst", { at_most = 4e-15 }) -- measured 4e-16
case:expect(book, "energy", { at_most = 7e-15 }) -- measured 7e-16

-- The heaviest loads. At full contact p = p̄ + the pressures that flatten the surface, so approach and energy
-- are those of full contact.
local wave = lab.surface.sine{ cells = n, size = 1, amplitude = 0.01,
  material = lab.material{ young = 1, poisson = 0 } }
local line = lab.contact{ lower = wave, upper = lab.rigid, boundary = "periodic",
  effects = { elasticity = "half_space" } }
local heavy = lab.notebook "heavy"
local right = math.pi * 0.01 ^ 2 / 4 -- J, energy of the flattened wave: E* pi h^2 / 4 on a tile of 1 x 1
for _, load in ipairs{ 1, 1e3, 1e6, 1e9, 1e12, 1e15, 1e20, 1e100, 1e200 } do
  local st = line:press{ load = load }
  heavy:write{ load = load, nodes = st.nodes_in_contact, approach = math.abs(st.approach / 0.01 - 1),
    energy = math.abs(st.energy / right - 1),
    certificate = st.residual }
end
case:evidence(heavy, "A wave of height 0.01 on 32 x 32 nodes of E* = 1 in full contact: approach and"
  .. " energy do not depend on the load.",
  { { "load", "%.0e", "load (N)" }, { "nodes", "%d" }, { "approach", "%.0e", "approach error" },
    { "energy", "%.0e", "energy error" },
    { "certificate", "%.0e" } })
case:expect(heavy, "nodes", { at_least = n * n })
case:expect(heavy, "approach", { at_most = 1e-15 }) -- measured 0
case:expect(heavy, "energy", { at_most = 1e-14 }) -- measured 1e-15

local first = bench(scenes[1].effects)
local boxes = bench(scenes[4].effects)
case:refused("half-space, 5e-324 N", function() first:press{ load = 2.0 ^ -1074 } end,
  "1e-280 of the contact modulus")
case:refused("boxes, 5e-324 N", function() boxes:press{ load = 2.0 ^ -1074 } end, "1e-280 of the modulus")
case:refused("half-space, the largest double", function() first:press{ load = 0x1.fffffffffffffp1023 } end,
  "inf Pa")
case:refused("boxes, the largest double", function() boxes:press{ load = 0x1.fffffffffffffp1023 } end,
  "leave the range of a double")
case:refused("a negative load", function() first:press{ load = -2.0 ^ -1074 } end, "`load`")
case:refused("a load that is not a number", function() first:press{ load = 0 / 0 } end, "`load`")
case:holds("a load of 0 gives no contact and no error", first:press{ load = 0 }.nodes_in_contact == 0)
case:finish{ worst = "4e-16 of the approach; refused under 1e-280",
  verdict = "right answer, and a clear error at either end" }

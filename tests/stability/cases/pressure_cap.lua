-- SPDX-License-Identifier: GPL-3.0-or-later
-- The pressure cap from both sides: what happens as the mean pressure reaches the hardness and exceeds it?
--
-- No pressure exceeds the hardness H, so no heights can carry a mean pressure of H or more. Just below H, all
-- nodes but one are at the cap, and the last node alone determines the offset. On a soft body (H far below
-- the elastic pressures) the area is p̄/H. In between, waves z = h cos 2πx cos 2πy with h = 0.01 at a fifth
-- of the pressure of full contact have known areas and energies. With hardening K there is no cap: on a flat
-- the approach past yield is (p̄ - H)/K.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 2, title = "Pressure cap", edge = "mean pressure over hardness from 1e-9 to 1 - 2^-53, to 1,"
    .. " to 2; hardening from 1e-5 to 1e300 of the elastic stiffness",
  elsewhere = "A conjugate-gradient solver with a cap stalls with the right load, a plausible area and"
    .. " twice the plastic volume. At the cap the offset is undetermined. Past the cap the iteration runs to"
    .. " its limit.",
  here = "Every load below the hardness is solved, up to the last double below it. Mean pressures at and"
    .. " above the hardness are refused by name, and the contact stays unchanged.",
}

local h, full = 0.01, math.sqrt(2) * math.pi * 0.01
local function wave(cells, hardness)
  return lab.surface.sine{ cells = cells, size = 1, amplitude = h, directions = 2,
    material = lab.material{ young = 1, poisson = 0, hardness = hardness } }
end
local function bench(surface, plasticity, tolerance)
  return lab.contact{ lower = surface, upper = lab.rigid, boundary = "periodic",
    effects = { elasticity = "half_space", plasticity = plasticity or {} },
    accuracy = { tolerance = tolerance or 1e-9 } }
end

-- 1. Between the limits: areas and energies computed once by an independent method, 256 x 256 nodes.
local known = lab.notebook "known"
for ratio, wanted in lab.sorted{ [3] = { 0.41806, 0.26944, 0.0017541, 1.31773e-5 },
  [1.5] = { 0.67282, 0.65927, nil, 3.45966e-6 } } do
  local p = 0.2 * full
  local st = bench(wave(256, ratio * p)):press{ pressure = p }
  known:write{ ratio = 1 / ratio, area = st.area_fraction, capped = st.plastic_fraction,
    iterations = st.iterations,
    ["area error"] = math.abs(st.area_fraction / wanted[1] - 1),
    ["capped error"] = math.abs(st.plastic_fraction / wanted[2] - 1),
    ["gap error"] = wanted[3] and math.abs(st.mean_gap / wanted[3] - 1) or 0,
    ["energy error"] = math.abs(st.energy / wanted[4] - 1), certificate = st.residual }
end
case:evidence(known, "Waves at a fifth of the pressure of full contact, 256 x 256 nodes, against"
  .. " known values.",
  { { "ratio", "%.4f", "p/H" }, { "area", "%.5f" }, { "capped", "%.5f", "share at the cap" },
    { "area error", "%.0e" },
    { "capped error", "%.0e" }, { "gap error", "%.0e" }, { "energy error", "%.0e" }, { "iterations", "%d" },
    { "certificate", "%.0e" } })

-- 2. Loads up to the hardness. Capped and elastic nodes carry the load: p̄ = H (share at the cap) + the rest.
local edge, H = lab.notebook "edge", 0.02
local one = bench(wave(64, H))
local last, rising = 0, true
for _, ratio in ipairs{ 1e-9, 1e-6, 1e-3, 0.1, 0.5, 0.9, 0.99, 1 - 1e-3, 1 - 1e-4, 1 - 1e-6, 1 - 1e-9,
  1 - 1e-12, 1 - 2 ^ -53 } do
  local st = one:copy():press{ pressure = ratio * H }
  local carried, most = 0, 0
  for _, row in ipairs(st:field "pressure":values()) do
    for _, p in ipairs(row) do carried, most = carried + p / 64 ^ 2, math.max(most, p) end
  end
  rising, last = rising and st.approach > last, st.approach
  edge:write{ left = 1 - ratio, ratio = ratio, area = st.area_fraction, capped = st.plastic_fraction,
    approach = st.approach / h, ["load error"] = math.abs(carried / (ratio * H) - 1),
    over = math.max(0, most / H - 1),
    volume = st.plastic_volume, energy = st.energy, iterations = st.iterations, certificate = st.residual }
end
case:evidence(edge, "Loads up to the hardness, 64 x 64 nodes. The approach is in units of h. It cannot exceed"
  .. " 2 h: there the last hollow touches.",
  { { "ratio", "%.12g", "p/H" }, { "left", "%.2g", "1 - p/H" }, { "area", "%.4f" },
    { "capped", "%.4f", "share at the cap" },
    { "approach", "%.6f" }, { "load error", "%.0e" }, { "over", "%.0e", "above the cap" },
    { "iterations", "%d" },
    { "certificate", "%.0e" } })

-- 3. A soft body: the area is p̄/H within one node in a few hundred.
local soft = lab.notebook "soft"
for _, hardness in ipairs{ 1e-3, 1e-5, 1e-8, 1e-12, 1e-30 } do
  local st = bench(wave(128, hardness)):press{ pressure = 0.3 * hardness }
  soft:write{ hardness = hardness, area = st.area_fraction, error = math.abs(st.area_fraction / 0.3 - 1),
    iterations = st.iterations, certificate = st.residual }
end
case:evidence(soft, "A soft body at 0.3 of its hardness, 128 x 128 nodes: the area is 0.3.", {
  { "hardness", "%.0e", "hardness over E*" }, { "area", "%.5f" }, { "error", "%.0e" }, { "iterations", "%d" },
  { "certificate", "%.0e" } })

-- 4. Hardening. On a flat every node yields by (p̄ - H)/K.
local flat, hardening = lab.surface.flat{ cells = 8, size = 1,
  material = lab.material{ young = 1, poisson = 0, hardness = H } },
  lab.notebook "hardening"
for _, K in ipairs{ 1e-5, 1e-4, 1e-3, 1, 1e3, 1e6, 1e12, 1e100, 1e300 } do
  local plane = bench(flat, { hardening = K }):press{ pressure = 2 * H }
  local st = bench(wave(64, H), { hardening = K }):press{ pressure = 2 * H }
  hardening:write{ K = K, ["error on a flat"] = math.abs(plane.approach / (H / K) - 1),
    area = st.area_fraction,
    yielded = st.plastic_fraction, iterations = st.iterations, certificate = st.residual }
end
case:evidence(hardening, "Hardening K at twice the hardness: a flat, and waves on 64 x 64 nodes.",
  { { "K", "%.0e" },
  { "error on a flat", "%.0e" }, { "area", "%.4f" }, { "yielded", "%.4f" }, { "iterations", "%d" },
  { "certificate", "%.0e" } })

case:expect(known, "area error", { at_most = 2e-5 }) -- measured 2e-6
case:expect(known, "capped error", { at_most = 2e-5 }) -- measured 2e-6
case:expect(known, "gap error", { at_most = 2e-4 }) -- measured 2e-5
case:expect(known, "energy error", { at_most = 1e-5 }) -- measured 1e-6
case:expect(edge, "load error", { at_most = 3e-13 }) -- measured 3e-14
case:expect(edge, "over", { at_most = 0 })
case:expect(edge, "approach", { at_most = 2 })
case:expect(edge, "volume", { at_least = 0 })
case:expect(edge, "energy", { at_least = 0 })
case:holds("the approach rises with every load", rising)
case:expect(soft, "error", { at_most = 2e-3 }) -- measured 1.4e-3: seven nodes of 16384
case:expect(hardening, "error on a flat", { at_most = 5e-15 }) -- measured 6e-16

-- 5. At the hardness and above. With a hardening of 1e-12 of the elastic stiffness, the approach is 1e10
-- times the heights, and the gaps are lost in rounding.
local ok, message = pcall(function() bench(wave(64, H), { hardening = 1e-12 }):press{ pressure = 2 * H } end)
case:holds("with a hardening of 1e-12 of the elastic stiffness, the heights are lost in the approach, and the"
  .. " press is refused with its last residual", not ok
  and message:find("reached a residual of", 1, true) ~= nil)
local before = one:copy():press{ pressure = 0.5 * H }
for _, ratio in ipairs{ 1, 1 + 2 ^ -52, 1 + 1e-6, 2, 1e30 } do
  case:refused(("waves, p/H = %.17g"):format(ratio), function() one:press{ pressure = ratio * H } end,
    "cannot be carried",
    "`hardness` is 0.02 Pa")
end
local plane = bench(flat)
case:refused("a flat, p/H = 1", function() plane:press{ pressure = H } end, "cannot be carried",
  "`hardness` is 0.02 Pa")
case:holds("a flat at the last double below the hardness touches at every node, without approach", (function()
  local st = plane:press{ pressure = H * (1 - 2 ^ -53) }
  return st.nodes_in_contact == 64 and st.approach == 0 and st.plastic_volume == 0
end)())
case:holds("refused presses leave the contact unchanged",
  one:copy():press{ pressure = 0.5 * H }.digest == before.digest)

case:finish{ worst = "area 1.4e-3 on a soft body; refused from H on",
  verdict = "right answer, then a clear error" }

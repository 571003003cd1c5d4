-- SPDX-License-Identifier: GPL-3.0-or-later
-- Bodies of very different stiffness, and Poisson's ratios at both limits: do they press as E* predicts?
--
-- 1/E* = (1 - ν1²)/E1 + (1 - ν2²)/E2. At full contact the pressure of a wave is p̄ + πE*h/λ cos 2πx/λ, which
-- gives E*. The result does not depend on which body is the lower one or carries the heights.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 20, title = "Unlike bodies", edge = "ratio of moduli from 1e-30 to 1e30; Poisson's"
    .. " ratios from one ulp above -1 to 0.5; rigid bodies",
  elsewhere = "A rigid body gets a very large modulus. The approach of the other body is then lost in"
    .. " rounding, or becomes 0 times infinity.",
  here = "E* is right to rounding for any two bodies. Exchanged bodies give the same press. A rigid body"
    .. " does not deform and needs no modulus.",
}
local h = 0.01
local function wave(material) return lab.surface.sine{ cells = 32, size = 1, amplitude = h,
  material = material } end
local function modulus(a, b, pressure)
  local st = lab.contact{ lower = wave(a), upper = b, boundary = "periodic",
    effects = { elasticity = "half_space" },
    accuracy = { tolerance = 1e-12 } }:press{ pressure = pressure }
  return (st.peak_pressure - st.pressure) / (math.pi * h), st
end
local book = lab.notebook "moduli"
for _, ratio in ipairs{ 1e-30, 1e-15, 1e-8, 1e-3, 1, 1e3, 1e8, 1e15, 1e30 } do
  local a, b = lab.material{ young = 1, poisson = 0.3 }, lab.material{ young = ratio, poisson = 0.2 }
  local wanted = 1 / ((1 - 0.09) / 1 + (1 - 0.04) / ratio)
  local found, st = modulus(a, b, wanted)
  local other = modulus(b, a, wanted)
  book:write{ ratio = ratio, modulus = found, error = math.abs(found / wanted - 1),
    exchanged = other == found and "same" or "other",
    same = other == found and 1 or 0, iterations = st.iterations, certificate = st.residual }
end
case:evidence(book, "E1 = 1, ν1 = 0.3 against E2, ν2 = 0.2: E* from the pressures of full contact,"
  .. " 32 x 32 nodes.", { { "ratio", "%.0e", "E2/E1" },
  { "modulus", "%.6e", "E*" }, { "error", "%.0e" }, { "exchanged", "%s" }, { "iterations", "%d" },
  { "certificate", "%.0e" } })
case:expect(book, "error", { at_most = 5e-14 }) -- measured 5e-15
case:expect(book, "same", { at_least = 1 })

local poisson = lab.notebook "poisson"
for _, nu in ipairs{ -1 + 2 ^ -53, -1 + 1e-9, -0.999, -0.5, 0, 0.3, 0.4999, 0.5 } do
  local wanted = 1 / ((1 - nu) * (1 + nu))
  local found, st = modulus(lab.material{ young = 1, poisson = nu }, lab.rigid, wanted)
  poisson:write{ nu = nu, left = 1 + nu, modulus = found, error = math.abs(found / wanted - 1),
    certificate = st.residual }
end
case:evidence(poisson, "One elastic body on a rigid flat: E* = E/(1 - ν²).",
  { { "nu", "%.10g", "ν" }, { "left", "%.0e", "1 + ν" }, { "modulus", "%.6e", "E*" },
  { "error", "%.0e" }, { "certificate", "%.0e" } })
case:expect(poisson, "error", { at_most = 6e-14 }) -- measured 6e-15

-- Two rough bodies, exchanged. A lower face turned over is an upper face, so pressures are mirrored.
local function rough(seed, E)
  return lab.surface.self_affine{ cells = 33, size = 1, hurst = 0.8, rms_height = 0.01, short_wave = 0.2,
    seed = seed,
    material = lab.material{ young = E, poisson = 0.3, hardness = 0.2 } }
end
local pairs_ = lab.notebook "exchanged"
for _, E in ipairs{ 1e-6, 1, 1e6 } do
  for _, plasticity in ipairs{ false, {} } do
    local a, b = rough(1, 1), rough(2, E)
    local load = 0.03 * math.min(1, E)
    local function pressed(lower, upper)
      return lab.contact{ lower = lower, upper = upper, boundary = "periodic",
        effects = { elasticity = "half_space", plasticity = plasticity or nil },
        accuracy = { tolerance = 1e-10 } }:press{ pressure = load }
    end
    local one, two = pressed(a, b), pressed(b, a)
    local P, Q, worst = one:field "pressure", two:field "pressure", 0
    for j = 0, 32 do for i = 0, 32 do worst = math.max(worst,
      math.abs(P:value(i, j) - Q:value(32 - i, j)) / P.max) end end
    pairs_:write{ E = E, plastic = plasticity and "yes" or "no", nodes = one.nodes_in_contact, other = two.nodes_in_contact,
      worst = worst, same = one.nodes_in_contact == two.nodes_in_contact and 1 or 0,
      certificate = math.max(one.residual, two.residual) }
  end
end
case:evidence(pairs_, "Two rough bodies of 33 x 33 nodes, exchanged and mirrored: largest difference of a"
  .. " pressure over the peak.", { { "E", "%.0e", "E2/E1" },
  { "plastic", "%s", "with a cap" }, { "nodes", "%d" }, { "other", "%d", "exchanged" },
  { "worst", "%.0e", "difference" }, { "certificate", "%.0e" } })
case:expect(pairs_, "worst", { at_most = 3e-14 }) -- measured 3e-15
case:expect(pairs_, "same", { at_least = 1 })

for _, nu in ipairs{ -1, 0.5 + 2 ^ -53, 1, 0 / 0 } do
  case:refused(("ν = %.17g"):format(nu):gsub("-nan", "nan"), function() lab.material{ young = 1,
    poisson = nu } end, "`poisson`")
end
for _, E in ipairs{ 0, -1, math.huge, 0 / 0 } do
  case:refused("E = " .. tostring(E):gsub("-nan", "nan"), function() lab.material{ young = E,
    poisson = 0 } end, "`young`")
end
case:refused("both bodies rigid", function()
  lab.contact{ lower = wave(lab.rigid), upper = lab.rigid, boundary = "periodic",
    effects = { elasticity = "half_space" } }
end, "both bodies are rigid")
case:finish{ worst = "6e-15 of E*", verdict = "right answer" }

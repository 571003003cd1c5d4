-- SPDX-License-Identifier: GPL-3.0-or-later
-- The published surface has waves of up to γⁿ = 1.5^100 = 4e17 turns per sample length. Their phases need
-- exact arithmetic.
--
-- z = L (G/L)^(D-2) √(ln γ/M) Σ_m Σ_n γ^((D-3)n) {cos φ - cos(2π γⁿ (x cos(πm/M) + y sin(πm/M))/L + φ)}. A
-- double has 53 bits: γⁿ x/L in doubles has no phase left from n = 84 on (γ = 1.5) and no value from n = 1751
-- on. With γ = 3/2 and 64 nodes, γⁿ i/64 modulo 1 is an integer 3ⁿ i modulo 2^(n+6), computed below in
-- integers of any length. With M = 2 the directions are the axes. These phases are the reference; "in
-- doubles" is the sum as written.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 6, title = "Exact phases", edge = "n_max from 0 to 2000, then to the limit n_max log2 γ ="
    .. " 2048 and past it; γ from 1 + 2^-52 to 1e300",
  elsewhere = "Phases are computed in doubles. They are wrong by a thousandth of a radian from n = 63 on"
    .. " and by half a turn from n = 84 on, and 1.5^1751 is infinite. The published surface cannot be"
    .. " reproduced.",
  here = "Turns per grid step are reduced modulo 1 with as many bits as n_max needs, then stored as 64-bit"
    .. " integers, whose overflow is the reduction. Past the limit n_max is refused by name.",
}

local cells, M, L, G = 64, 2, 50, 5

-- Turns of wave n at node i, from 3ⁿ in limbs of 24 bits.
local turns = {}
local limbs = { 1 }
for n = 0, 2000 do
  local bits = n + 6
  local count = (bits + 23) // 24
  for k = #limbs + 1, count do limbs[k] = 0 end
  -- 3ⁿ i modulo 2^bits, over 2^bits: the leading limbs are enough.
  turns[n] = {}
  for i = 0, cells - 1 do
    local carry, top = 0, {}
    for k = 1, count do
      local v = limbs[k] * i + carry
      carry, v = v >> 24, v & 0xffffff
      if k == count then v = v & ((1 << (bits - 24 * (count - 1))) - 1) end
      top[k] = v
    end
    local value, scale = 0.0, 1.0 / 2.0 ^ (bits - 24 * (count - 1))
    for k = count, math.max(1, count - 3), -1 do
      value, scale = value + top[k] * scale, scale / 2.0 ^ 24
    end
    turns[n][i] = value
  end
  local carry = 0
  for k = 1, #limbs do
    local v = 3 * limbs[k] + carry
    limbs[k], carry = v & 0xffffff, v >> 24
  end
  if carry > 0 then limbs[#limbs + 1] = carry end
end

-- Reproducible phases.
local function phase(m, n) return 2 * math.pi * ((0.3 + 0.61 * m + 0.377 * n) % 1) end

-- Heights along the line j = 5 for every wanted n_max, with exact phases or with phases in doubles.
local function heights(D, wanted, exact)
  local amplitude = L * (G / L) ^ (D - 2) * math.sqrt(math.log(1.5) / M)
  local found, sum = {}, {}
  for i = 0, cells - 1 do sum[i] = 0 end
  local last = 0
  for _, n in ipairs(wanted) do last = math.max(last, n) end
  local j, k = 5, 1
  for n = 0, last do
    local weight = 1.5 ^ ((D - 3) * n)
    for i = 0, cells - 1 do
      -- m = 1 runs along y, m = 2 against x.
      local y, x
      if exact then
        y, x = turns[n][j], (1 - turns[n][i]) % 1
      else
        y, x = 1.5 ^ n * (j * L / cells) / L, -(1.5 ^ n) * (i * L / cells) / L
      end
      for m, t in ipairs{ y, x } do
        local phi = phase(m, n)
        sum[i] = sum[i] + weight * (math.cos(phi) - math.cos(2 * math.pi * t + phi))
      end
    end
    if n == wanted[k] then
      found[n], k = {}, k + 1
      for i = 0, cells - 1 do found[n][i] = amplitude * sum[i] end
    end
  end
  return found
end

local wanted = { 0, 1, 2, 5, 10, 20, 40, 50, 60, 63, 70, 84, 100, 150, 200, 500, 1000, 1500, 1750, 1751, 1800,
  2000 }
local book = lab.notebook "phases"
for _, D in ipairs{ 2.5, 2.9, 3 } do
  local reference, doubles = heights(D, wanted, true), heights(D, wanted, false)
  for _, n_max in ipairs(wanted) do
    local s = lab.surface.weierstrass_mandelbrot{ cells = cells, D = D, L = L, G = G, gamma = 1.5, M = M,
      n_max = n_max, phases = phase }
    local here, there, square, mean = 0, 0, 0, 0
    for i = 0, cells - 1 do mean = mean + reference[n_max][i] / cells end
    for i = 0, cells - 1 do
      square = square + (reference[n_max][i] - mean) ^ 2
      here = math.max(here, math.abs(s:height(i, 5) - reference[n_max][i]))
      local d = math.abs(doubles[n_max][i] - reference[n_max][i])
      there = d == d and math.max(there, d) or 0 / 0
    end
    local rq = math.sqrt(square / cells)
    local lost = there ~= there or there == math.huge
    book:write{ D = D, n_max = n_max, ["exact phases"] = here / rq,
      ["phases in doubles"] = lost and "not a number" or there / rq,
      charted = n_max <= 200 and "yes" or "no" }
  end
end
for _, D in ipairs{ 2.5, 2.9, 3 } do
  case:evidence(book, ("D = %g: largest error along a line of 64 nodes, relative to Rq."):format(D),
    { { "n_max", "%d" },
    { "exact phases", "%.0e" }, { "phases in doubles", "%.0e" } }, { D = D })
end
case:expect(book, "exact phases", { at_most = 2e-13 }) -- measured 2e-14
case:chart(book, "Error of the heights against n_max, with exact phases and with phases in doubles, D = 2.9",
  { x = "n_max",
  y = { "exact phases", "phases in doubles" }, where = { D = 2.9, charted = "yes" }, log_y = true,
  title = "Error of the heights at D = 2.9",
  y_label = "greatest error over Rq", file = "error_against_n.svg" })

-- The published surface with golden-ratio phases, against numbers computed once to 20 digits.
local published = lab.notebook "published"
for D, known in lab.sorted{ [2.5] = { -2.2579597274, 11.9812989022, 108.3493302162, -1.8465009186 },
  [2.2] = { -4.2184139916, 20.3032959226, 164.8778831984, -8.0472892570 } } do
  local s = lab.surface.weierstrass_mandelbrot{ cells = 150, D = D, span = 3, n_max = 7,
    phases = function(m, n) return 2 * math.pi * ((0.6180339887498949 * (10 * n + m)) % 1) end }
  local r = s:roughness()
  published:write{ D = D, mean = math.abs(r.mean / known[1] - 1), Rq = math.abs(r.Rq / known[2] - 1),
    amplitude = math.abs(r.amplitude / known[3] - 1), height = math.abs(s:height(75, 40) / known[4] - 1),
    origin = math.abs(s:height(0, 0)) / r.Rq }
end
case:evidence(published, "150 x 150 nodes, M = 10, n_max = 7: relative errors against numbers of ten digits.",
  { { "D", "%g" },
  { "mean", "%.0e" }, { "Rq", "%.0e" }, { "amplitude", "%.0e" }, { "height", "%.0e", "z(75, 40)" },
  { "origin", "%.0e", "z(0, 0)/Rq, exactly 0" } })
-- measured 3e-11
for _, column in ipairs{ "mean", "Rq", "amplitude", "height", "origin" } do case:expect(published, column,
  { at_most = 3e-10 }) end

-- γ over its range. At γ = 1 + 2^-52 all waves of a ridge have one length, and z = √(ln γ) times their sum.
local function published_surface(options)
  options.cells, options.D, options.M, options.phases = 64, options.D or 2.5, options.M or 2, phase
  return lab.surface.weierstrass_mandelbrot(options)
end
local flat = published_surface{ gamma = 1 + 2 ^ -52, n_max = 100 }
local worst, square = 0, 0
for i = 0, cells - 1 do
  local z = 0
  for n = 0, 100 do
    for m, t in ipairs{ 5 / cells, -i / cells } do z = z + math.cos(phase(m,
      n)) - math.cos(2 * math.pi * t + phase(m, n)) end
  end
  z = z * L * (G / L) ^ 0.5 * math.sqrt(2.0 ^ -52 / M)
  worst, square = math.max(worst, math.abs(flat:height(i, 5) - z)), square + z * z / cells
end
local gamma = lab.notebook "gamma"
gamma:write{ gamma = "1 + 2^-52", n_max = 100, error = worst / math.sqrt(square) }
case:evidence(gamma, "γ next to 1, against the sum of 101 waves of one length.",
  { { "gamma", "%s" }, { "n_max", "%d" }, { "error", "%.0e" } })
case:expect(gamma, "error", { at_most = 2e-12 }) -- measured 2e-13

for _, case_of in ipairs{ { 2, 2048 }, { 1.5, 3501 }, { 1 + 2 ^ -52, 4096 }, { 2.0 ^ 1023, 2 },
  { 16, 512 } } do
  local g, n_max = case_of[1], case_of[2]
  local s = published_surface{ gamma = g, n_max = n_max }
  local r = s:roughness()
  case:holds(("γ = %.17g, n_max = %d, the largest accepted: heights are finite"):format(g, n_max),
    r.Rq > 0 and r.Rq < math.huge)
  case:refused(("γ = %.17g, n_max = %d"):format(g, n_max + 1),
    function() published_surface{ gamma = g, n_max = n_max + 1 } end, "`n_max`")
end
case:refused("γ = 1", function() published_surface{ gamma = 1 } end, "`gamma`")
case:finish{ worst = "2e-14 of Rq; refused past the limit", verdict = "right answer, then a clear error" }

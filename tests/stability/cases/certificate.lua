-- SPDX-License-Identifier: GPL-3.0-or-later
-- The conditions for a solver to report convergence.
--
-- Contact has four conditions: no negative gap, no negative pressure, no pressure across an open gap, and the
-- right load. Complementarity Σ p g alone is 0 for zero pressure and for bodies that pass through each other.
-- This script recomputes the gaps from the pressures by an independent sum over waves, u = Σ 2/(E*|q|) p_q,
-- and measures all four conditions, at tolerances from 0.1 to the smallest accepted.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 9, title = "When a solve has converged", edge = "tolerance from 0.1 to 1e-15, by load, with"
    .. " and without a cap",
  elsewhere = "A residual of complementarity alone accepts a start with penetration, and a start without"
    .. " pressure. A residual of the load alone stops at a plausible area.",
  here = "`converged` means complementarity, penetration, tension, load and cap together, each"
    .. " relative. The conditions recomputed from the fields agree with the certificate.",
}

local nx, ny = 24, 16
local s = lab.surface.self_affine{ cells = { nx, ny }, size = { 1.5, 1 }, hurst = 0.8, rms_height = 0.01,
  short_wave = 0.25, seed = 3,
  material = lab.material{ young = 1, poisson = 0, hardness = 0.06 } }

-- Displacements under pressures, by direct Fourier sums along x and then along y.
local cos, sin = math.cos, math.sin
-- `count` sums of n terms; the sums are `step` apart, the terms `stride`.
local function along(re, im, sign, n, stride, count, step)
  local out_re, out_im = {}, {}
  for j = 0, count - 1 do
    for k = 0, n - 1 do
      local a, b = 0, 0
      for i = 0, n - 1 do
        local c, d = cos(2 * math.pi * ((i * k) % n) / n), sign * sin(2 * math.pi * ((i * k) % n) / n)
        local x, y = re[j * step + i * stride], im[j * step + i * stride]
        a, b = a + x * c - y * d, b + x * d + y * c
      end
      out_re[j * step + k * stride], out_im[j * step + k * stride] = a, b
    end
  end
  return out_re, out_im
end
local function transform(re, im, sign)
  re, im = along(re, im, sign, nx, 1, ny, nx)
  return along(re, im, sign, ny, nx, nx, 1)
end
local function displacements(p)
  local zero = {}
  for k = 0, nx * ny - 1 do zero[k] = 0 end
  local re, im = transform(p, zero, -1)
  for l = 0, ny - 1 do
    for k = 0, nx - 1 do
      local kx, ky = k <= nx / 2 and k or k - nx, l <= ny / 2 and l or l - ny
      local q = 2 * math.pi * math.sqrt((kx / 1.5) ^ 2 + ky ^ 2)
      local factor = q > 0 and 2 / q / (nx * ny) or 0
      re[l * nx + k], im[l * nx + k] = re[l * nx + k] * factor, im[l * nx + k] * factor
    end
  end
  return (transform(re, im, 1))
end

-- Violations of the conditions by pressures p at a mean pressure, relative to Σ p · rms h, rms h and p̄.
local heights, mean, rms = {}, s:roughness().mean, s:roughness().Rq
for j = 0, ny - 1 do
  for i = 0, nx - 1 do heights[j * nx + i] = s:height(i, j) - mean end
end
local function conditions(p, wanted, cap)
  local u, load, offset, free = displacements(p), 0, 0, 0
  for k = 0, nx * ny - 1 do
    load = load + p[k] / (nx * ny)
    if p[k] > 0 and p[k] < cap then free, offset = free + 1, offset + u[k] - heights[k] end
  end
  offset = free > 0 and offset / free or 0
  local found = { complementarity = 0, penetration = 0, tension = 0, load = math.abs(load - wanted) / wanted,
    cap = 0 }
  local sum = 0
  for k = 0, nx * ny - 1 do
    local g = u[k] - heights[k] - offset -- the flat is at height -offset
    sum = sum + p[k]
    found.complementarity = found.complementarity + p[k] * math.max(g,
      0) + (cap < math.huge and (cap - p[k]) * math.max(-g, 0) or 0)
    if p[k] < cap then found.penetration = math.max(found.penetration, -g / rms) end
    found.tension = math.max(found.tension, -p[k] / wanted)
    found.cap = math.max(found.cap, p[k] / cap - 1)
  end
  found.complementarity = sum > 0 and found.complementarity / (sum * rms) or 0
  return found
end

local book = lab.notebook "tolerance"
for _, scene in ipairs{ { "elastic", nil, math.huge }, { "with a cap", {}, 0.06 } } do
  for _, tolerance in ipairs{ 0.1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-15 } do
    local wanted = 0.02
    local st = lab.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
      effects = { elasticity = "half_space",
      plasticity = scene[2] }, accuracy = { tolerance = tolerance,
      on_failure = "best" } }:press{ pressure = wanted }
    local p, P = {}, st:field "pressure"
    for j = 0, ny - 1 do
      for i = 0, nx - 1 do p[j * nx + i] = P:value(i, j) end
    end
    local found, worst = conditions(p, wanted, scene[3]), 0
    for _, value in pairs(found) do worst = math.max(worst, value) end
    book:write{ scene = scene[1], tolerance = tolerance, converged = st.converged and "yes" or "no",
      nodes = st.nodes_in_contact,
      capped = scene[2] and st.plastic_fraction or 0, certificate = st.residual, measured = worst,
      complementarity = found.complementarity, penetration = found.penetration,
      load = found.load, over = worst / tolerance, iterations = st.iterations }
  end
end
for _, scene in ipairs{ "elastic", "with a cap" } do
  case:evidence(book, ("%s, 24 x 16 nodes: the conditions recomputed from the pressures."):format(
    scene:gsub("^%l", string.upper)),
    { { "tolerance", "%.0e" }, { "converged", "%s" }, { "nodes", "%d" },
      { "capped", "%.3f", "share at the cap" },
      { "iterations", "%d" }, { "certificate", "%.0e" }, { "complementarity", "%.0e" },
      { "penetration", "%.0e" }, { "load", "%.0e" } }, { scene = scene })
end
local met = true
for _, row in ipairs(book:rows()) do met = met
  and (row.certificate <= row.tolerance) == (row.converged == "yes") end
case:holds("`converged` is true exactly if every entry of the certificate is within the tolerance", met)
case:expect(book, "over", { at_most = 1.1 }) -- times the tolerance; measured 0.91

-- Complementarity alone would accept these starts.
local naive = lab.notebook "naive"
local none, even, most = {}, {}, -math.huge
for k = 0, nx * ny - 1 do none[k], even[k] = 0, 0.02 end
for what, p in lab.sorted{ ["no pressure at all"] = none, ["the mean pressure everywhere"] = even } do
  local found = conditions(p, 0.02, math.huge)
  naive:write{ what = what, complementarity = found.complementarity, penetration = found.penetration,
    load = found.load }
end
case:evidence(naive, "Starts that complementarity alone would accept or nearly accept.",
  { { "what", "%s", "pressures" }, { "complementarity", "%.0e" },
  { "penetration", "%.0e" }, { "load", "%.0e" } })
case:expect(naive, "load", { where = { what = "no pressure at all" }, at_least = 1 })
case:expect(naive, "penetration", { where = { what = "the mean pressure everywhere" }, at_least = 1 })
case:finish{ worst = "recomputed conditions 0.91 of the tolerance", verdict = "right answer" }

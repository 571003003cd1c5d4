-- SPDX-License-Identifier: GPL-3.0-or-later
-- A map with heights far from zero, for example nanometres of roughness on a stage at a metre.
--
-- Heights are doubles: at 1e9 times the roughness they have seven digits of it, and no program can recover
-- more. Nothing else may be lost. An offset that leaves the heights exact (a power of two, heights in whole
-- multiples of its rounding) must leave the contact unchanged.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 17, title = "Heights far from zero", edge = "an offset from 0 to 2^34 m, 4e11 times the"
    .. " height of the map",
  elsewhere = "Squares are summed before the mean is subtracted: the roughness of a map far from zero is"
    .. " zero, or negative under the root. Fourier sums carry the offset as noise in every wave.",
  here = "Roughness and contact do not depend on the offset, as long as the heights lose no digits.",
}
local n = 48
local base = lab.surface.self_affine{ cells = n, size = 1, hurst = 0.8, rms_height = 0.01, short_wave = 0.125,
  seed = 5 }:heights()
-- Whole multiples of 2^-18: exact with offsets up to 2^34.
for _, row in ipairs(base) do for i,
  z in ipairs(row) do row[i] = math.floor(z * 2 ^ 18 + 0.5) / 2 ^ 18 end end
local unit = lab.material{ young = 1, poisson = 0, hardness = 0.08 }
local function moved(offset)
  local rows = {}
  for j, row in ipairs(base) do rows[j] = {} for i, z in ipairs(row) do rows[j][i] = z + offset end end
  return lab.surface.from_table{ size = 1, heights = rows, material = unit }
end
local function contacts(s)
  local found = {}
  for _, scene in ipairs{ { "periodic", "half_space" }, { "free", "half_space" },
    { "periodic", "half_space", {} }, { "free", "box" } } do
    local st = lab.contact{ lower = s, upper = lab.rigid, boundary = scene[1],
      effects = { elasticity = scene[2], plasticity = scene[3] },
      accuracy = { tolerance = 1e-9 } }:press{ pressure = 0.01 }
    table.insert(found, { st.nodes_in_contact, st.approach, st.energy, st.peak_pressure, st.residual, st.iterations })
  end
  return found
end
local usual, r0 = contacts(moved(0)), moved(0):roughness()
local book = lab.notebook "offsets"
for _, power in ipairs{ 0, 4, 8, 16, 24, 30, 34 } do
  local offset = 2.0 ^ power
  local s = moved(offset)
  local r, found = s:roughness(), contacts(s)
  local worst, nodes, residual, iterations = 0, 0, 0, 0
  for k, state in ipairs(found) do
    nodes = nodes + math.abs(state[1] - usual[k][1])
    for m = 2, 4 do worst = math.max(worst, math.abs(state[m] / usual[k][m] - 1)) end
    residual, iterations = math.max(residual, state[5]), math.max(iterations, state[6])
  end
  book:write{ offset = offset / r0.amplitude, Rq = math.abs(r.Rq / r0.Rq - 1),
    Ra = math.abs(r.Ra / r0.Ra - 1), skewness = math.abs(r.skewness - r0.skewness),
    slope = math.abs(r.rms_slope / r0.rms_slope - 1), nodes = nodes, contact = worst, iterations = iterations,
    certificate = residual }
end
case:evidence(book, "A map with an offset: change of its roughness, and of approach, energy and peak pressure"
  .. " of four contacts (half-space periodic, free and with a cap, boxes).",
  { { "offset", "%.0e", "offset over height" }, { "Rq", "%.0e" }, { "Ra", "%.0e" }, { "skewness", "%.0e" },
  { "slope", "%.0e" },
  { "nodes", "%d", "nodes changed" }, { "contact", "%.0e", "contact" }, { "iterations", "%d" },
  { "certificate", "%.0e" } })
for _, column in ipairs{ "Rq", "Ra" } do case:expect(book, column, { at_most = 9e-15 }) end -- measured 9e-16
case:expect(book, "skewness", { at_most = 1e-13 }) -- measured 1e-14
case:expect(book, "slope", { at_most = 0 })
case:expect(book, "contact", { at_most = 3e-13 }) -- measured 3e-14
case:expect(book, "nodes", { at_most = 0 })
case:finish{ worst = "3e-14 of the approach", verdict = "right answer" }

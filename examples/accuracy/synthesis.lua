-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does a Weierstrass-Mandelbrot surface cost: how many terms, and how exact must their phases
-- be? Heights at sixteen nodes are compared with their definition, summed in hundreds of bits.
--
--   asperity run examples/accuracy/synthesis.lua
--
-- Found: at D = 2.9 the weight of an order falls by only 4 %, so 80 of 101 terms still have an
-- error of several percent of the roughness. Phases in double precision are right for some eighty
-- orders. Beyond, 1.5^n exceeds the digits of a double, and 101 terms have an error of 3 %.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"

local options = require "asperity.arguments"({ budget = 30, cells = 24 }, ...)
local cells, D, golden = options.cells, 2.9, 0.6180339887498949
local Rq = lab.surface.weierstrass_mandelbrot{ cells = cells, D = D, phases = "golden" }
  :roughness().Rq
local nodes = {}
for k = 0, 15 do
  local i, j = 1 + 5 * k % (cells - 1), 1 + 7 * k % (cells - 1)
  nodes[k + 1] = { i = i, j = j, height = lab.exact.weierstrass_mandelbrot{ cells = cells, D = D,
    phases = "golden", node = { i, j } } }
end

-- The phases of the whole sum: a shorter sum has the first of the same terms.
local function phase(m, n) return 2 * math.pi * ((101 * m + n) * golden % 1) end

-- A direct implementation of eq. (2).
local L, G, M, gamma = 50, 5, 10, 1.5
local function height(x, y, terms)
  local sum = 0
  for m = 1, M do
    local along = (x * math.cos(math.pi * m / M) + y * math.sin(math.pi * m / M)) / L
    for n = 0, terms - 1 do
      local start = phase(m, n)
      local wave = math.cos(start) - math.cos(2 * math.pi * gamma ^ n * along + start)
      sum = sum + gamma ^ ((D - 3) * n) * wave
    end
  end
  return L * (G / L) ^ (D - 2) * math.sqrt(math.log(gamma) / M) * sum
end

-- The rms error at the nodes over Rq.
local function error_of(knobs)
  local surface = knobs.phases == "double" and lab.surface.from_function{ cells = cells,
    size = L, height = function(x, y) return height(x, y, knobs.terms) end }
    or lab.surface.weierstrass_mandelbrot{ cells = cells, D = D, n_max = knobs.terms - 1,
      phases = phase }
  local sum = 0
  for _, node in ipairs(nodes) do sum = sum + (surface:height(node.i, node.j) - node.height) ^ 2 end
  return math.sqrt(sum / #nodes) / Rq
end

local terms = { 5, 10, 20, 40, 60, 80, 101 }
accuracy.show{ number = 6, title = "Synthesis of a Weierstrass-Mandelbrot surface",
  question = "D = 2.9, 101 orders, 10 directions, golden phases: the rms error of sixteen heights "
    .. "over Rq, for the time of all heights.",
  truth = "the sum of the definition in 187 bits; the answers are errors, whose truth is 0.",
  study = lab.work_precision{ ask = error_of, truth = 0, repeats = 3, at_most = options.budget,
    try = { { name = "exact phases", terms = terms },
      { name = "phases in double precision", phases = "double", terms = terms } } },
  finding = "Every term counts at this D. Phases in double precision do not improve further where "
    .. "1.5^n outgrows their digits. As a loop in Lua they cost a hundred times as much." }

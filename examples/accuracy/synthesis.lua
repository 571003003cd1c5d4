-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does a Weierstrass-Mandelbrot surface cost: how many terms, and how exact must their phases be?
--
--   asperity run examples/accuracy/synthesis.lua
--   asperity run examples/accuracy/synthesis.lua -- budget=120
--
-- Heights at sixteen nodes, against their definition summed in hundreds of bits. At D = 2.9 the weight of an order
-- falls by 4 % only, and every term left out is missed: 80 of 101 still err by several percent of the roughness.
-- Phases in plain double precision are right for some eighty orders and then are noise, for 1.5^n has
-- outgrown the digits that hold its place on the circle: all 101 of them err by 3 %, for good.
local lab = require "asperity"
local accuracy = require "asperity.accuracy"
local arguments = require "asperity.arguments"

local options = arguments({ budget = 30, cells = 24 }, ...)
local cells, n_max, M, gamma, D = options.cells, 100, 10, 1.5, 2.9
local golden = 0.6180339887498949
local nodes = {}
for k = 0, 15 do
  local node = { 1 + 5 * k % (cells - 1), 1 + 7 * k % (cells - 1) }
  node.height = lab.exact.weierstrass_mandelbrot{ cells = cells, D = D, phases = "golden", node = { node[1], node[2] } }
  nodes[k + 1] = node
end
local roughness = lab.surface.weierstrass_mandelbrot{ cells = cells, D = D, phases = "golden" }:roughness().Rq

-- The rms error at the nodes, over Rq.
local function error_of(surface)
  local sum = 0
  for _, node in ipairs(nodes) do sum = sum + (surface:height(node[1], node[2]) - node.height) ^ 2 end
  return math.sqrt(sum / #nodes) / roughness
end

-- The phases of the whole sum, so that fewer terms are the first of the same ones.
local function phase(m, n) return 2 * math.pi * ((m * (n_max + 1) + n) * golden % 1) end

local function with_exact_phases(terms)
  local surface <close> = lab.surface.weierstrass_mandelbrot{
    cells = cells, D = D, n_max = terms - 1, phases = phase,
  }
  return error_of(surface)
end

-- Eq. (2) as one would write it first, for the same number of heights.
local function in_doubles(terms)
  local L, G = 50, 5
  local function z(x, y)
    local sum = 0
    for m = 1, M do
      local along = (x * math.cos(math.pi * m / M) + y * math.sin(math.pi * m / M)) / L
      for n = 0, terms - 1 do
        local start = phase(m, n)
        sum = sum + gamma ^ ((D - 3) * n) * (math.cos(start) - math.cos(2 * math.pi * gamma ^ n * along + start))
      end
    end
    return L * (G / L) ^ (D - 2) * math.sqrt(math.log(gamma) / M) * sum
  end
  local surface <close> = lab.surface.from_function{ cells = cells, size = L, height = z }
  return error_of(surface)
end

local study = lab.work_precision{
  ask = function(knobs)
    return knobs.phases == "double" and in_doubles(knobs.terms) or with_exact_phases(knobs.terms)
  end,
  truth = 0,
  try = {
    { name = "exact phases", terms = { 5, 10, 20, 40, 60, 80, 101 } },
    { name = "phases in double precision", phases = "double", terms = { 5, 10, 20, 40, 60, 80, 101 } },
  },
  repeats = 3, at_most = options.budget,
}
accuracy.show{
  number = 6, title = "Synthesis of a Weierstrass-Mandelbrot surface", study = study,
  question = "D = 2.9, 101 orders, 10 directions, golden phases: the rms error of sixteen heights over Rq, for the time "
    .. "of all heights.",
  truth = "the sum of the definition in 187 bits; the answers are errors, whose truth is 0.",
  finding = "Every term counts at this D. Phases in double precision stop getting better where 1.5^n outgrows their "
    .. "digits, and cost a hundred times as much when they are written as a loop.",
}

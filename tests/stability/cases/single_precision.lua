-- SPDX-License-Identifier: GPL-3.0-or-later
-- Single precision inside a solve: does the answer meet its tolerance, and is the precision reported?
--
-- Transforms of steps are in single precision; gaps, sums and the certificate are in double. The answer
-- differs from a double solve by at most both tolerances, down to tolerances a thousand times below the
-- precision of a float. A solve that stalls is repeated in double, and `solver` reports the precision.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 21, title = "Single precision", edge = "tolerance from 1e-2 to 1e-12; area from one node in a thousand to"
    .. " nearly all; moduli and lengths over 60 decades",
  elsewhere = "The residual stalls at the precision of a float. The solver runs to its iteration limit, or reports"
    .. " convergence from sums without correct digits.",
  here = "The certificate is computed in double and met at every tolerance. The same nodes touch as in a double"
    .. " solve, and no scale overflows a float.",
}

local function pressed(given)
  local scale = given.scale or 1
  local surface <close> = lab.surface.self_affine{
    cells = 128, size = scale, hurst = 0.8, rms_slope = 0.1, short_wave = scale / 16, seed = 2,
    material = lab.material{ young = given.young or 1, poisson = 0 },
  }
  local contact <close> = lab.contact{
    lower = surface, upper = lab.rigid, boundary = given.boundary or "periodic",
    effects = { elasticity = "half_space", plasticity = given.hardness and { hardness = given.hardness } or nil },
    accuracy = { tolerance = given.tolerance or 1e-6, precision = given.precision },
  }
  return contact:press{ pressure = (given.share or 0.05) * 0.1 * (given.young or 1) }
end

-- Presses in both precisions and writes the differences to a notebook.
local function compare(book, columns, given)
  given.precision = "double"
  local double = pressed(given)
  given.precision = "single"
  local single = pressed(given)
  columns.area = double.area_fraction
  columns.nodes = math.abs(single.nodes_in_contact - double.nodes_in_contact)
  columns.approach = math.abs(single.approach / double.approach - 1)
  columns.certificate, columns.tolerance = single.residual, given.tolerance or 1e-6
  columns.kept = columns.certificate / columns.tolerance
  columns.solver = single.solver:find "single" and "single" or "double"
  book:write(columns)
end
local shown = { { "area", "%.3f" }, { "nodes", "%d", "nodes apart" }, { "approach", "%.0e", "approach apart" },
  { "certificate", "%.0e" }, { "solver", "%s", "finished in" } }
local function with(...)
  local columns = { ... }
  for _, column in ipairs(shown) do columns[#columns + 1] = column end
  return columns
end

local by_tolerance = lab.notebook "tolerance"
for _, scene in ipairs{ { "periodic" }, { "free", boundary = "free" }, { "periodic, capped", hardness = 0.03 } } do
  for _, tolerance in ipairs{ 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12 } do
    compare(by_tolerance, { scene = scene[1] },
      { tolerance = tolerance, boundary = scene.boundary, hardness = scene.hardness })
  end
end
case:evidence(by_tolerance, "128 x 128 nodes at 0.05 E* times the slope, by tolerance.",
  with({ "scene", "%s" }, { "tolerance", "%.0e" }))

local by_load = lab.notebook "load"
for _, share in ipairs{ 1e-4, 1e-3, 1e-2, 0.1, 0.5, 1, 2 } do
  compare(by_load, { share = share }, { share = share, tolerance = 1e-8 })
end
case:evidence(by_load, "By load over E* times the slope, tolerance 1e-8.", with({ "share", "%g", "load" }))

local by_scale = lab.notebook "scale"
for _, scale in ipairs{ 1e-30, 1e-15, 1, 1e15, 1e30 } do
  for _, young in ipairs{ 1e-30, 1e30 } do
    compare(by_scale, { scale = scale, young = young }, { scale = scale, young = young, tolerance = 1e-8 })
  end
end
case:evidence(by_scale, "By the side of the tile and the modulus, tolerance 1e-8.",
  with({ "scale", "%.0e", "side" }, { "young", "%.0e", "E*" }))

for _, book in ipairs{ by_tolerance, by_load, by_scale } do
  case:expect(book, "kept", { at_most = 1, label = "every certificate is met" })
end
case:expect(by_tolerance, "nodes", { where = { tolerance = { 1e-6, 1e-8, 1e-10, 1e-12 } }, at_most = 0,
  label = "the same nodes touch" })
for _, book in ipairs{ by_load, by_scale } do
  case:expect(book, "nodes", { at_most = 0, label = "the same nodes touch" })
  case:expect(book, "approach", { at_most = 1e-8, label = "the same approach" }) -- measured 2e-9
end
case:finish{ worst = "1e-10 of the approach at a tolerance of 1e-8", verdict = "right answer" }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- A press to an approach must return the right load, from the lightest touch to full contact.
--
-- A wave under f times the load of full contact has the approach h f (1 - ln f) (Westergaard). A press to
-- this approach must return f. Near first touch and near full contact the load is a steep or a flat function
-- of the approach. At full contact the planes can come no nearer, so an approach of h or more has no answer.
-- On a free boundary every approach has an answer.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 19, title = "Pressing to an approach", edge = "approach from 1e-30 of the height to full"
    .. " contact and past it; indentation and flattening from 0 to 1",
  elsewhere = "The search for the load has an absolute tolerance, or brackets that close at one end. Past"
    .. " full contact it never stops.",
  here = "The load matches the approach over all decades. If no load reaches the approach, the error names"
    .. " the approach of full contact.",
}
local h, n, unit = 0.01, 1024, lab.material{ young = 1, poisson = 0 }
local function bench(tolerance)
  return lab.contact{ lower = lab.surface.sine{ cells = { n, 1 }, size = { 1, 1 / n }, amplitude = h,
    material = unit }, upper = lab.rigid,
    boundary = "periodic", effects = { elasticity = "half_space" },
    accuracy = { tolerance = tolerance or 1e-12 } }
end
local line, full = bench(), math.pi * h
local book = lab.notebook "wave"
for _, f in ipairs{ 1e-3, 0.01, 0.05, 0.2, 0.5, 0.8, 0.95, 0.99, 0.999, 1 - 1e-4 } do
  local ok, st = pcall(line.press, line, { approach = h * f * (1 - math.log(f)) })
  local area = n * 2 / math.pi * math.asin(math.sqrt(f))
  if not ok then print(st) book:write{ f = f, left = 1 - f, solved = 0 } else
  book:write{ solved = 1, f = f, left = 1 - f, error = math.abs(st.pressure / (f * full) - 1),
    area = math.abs(st.nodes_in_contact - area), iterations = st.iterations, certificate = st.residual }
  end
end
case:expect(book, "solved", { at_least = 1 })
case:evidence(book, "A wave on a line of 1024 nodes, pressed to the approach of f and compared with f.",
  { { "f", "%.6g" }, { "error", "%.0e", "error of the pressure" },
  { "area", "%.1f", "area error (nodes)" }, { "iterations", "%d" }, { "certificate", "%.0e" } })
case:expect(book, "error", { at_most = 2e-3 }) -- measured 2e-4, at 20 nodes in contact
case:expect(book, "area", { at_most = 2 }) -- measured 1.3

-- There and back: a load, its approach, and the load of this approach.
local rough = lab.surface.self_affine{ cells = 48, size = 1, hurst = 0.8, rms_height = 0.01,
  short_wave = 0.125,
  material = lab.material{ young = 1, poisson = 0, hardness = 0.1 } }
local back = lab.notebook "back"
for _, scene in ipairs{ { "half-space, periodic", "periodic", "half_space" },
  { "half-space, free", "free", "half_space" },
  { "with a cap", "periodic", "half_space", {} }, { "boxes", "free", "box" } } do
  local function pressed(how)
    return lab.contact{ lower = rough, upper = lab.rigid, boundary = scene[2],
      effects = { elasticity = scene[3], plasticity = scene[4] },
      accuracy = { tolerance = 1e-10 } }:press(how)
  end
  local row = { scene = scene[1], approach = 0, indentation = 0, flatten = 0, loads = 0 }
  for _, load in ipairs{ 1e-200, 1e-100, 1e-30, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.05 } do
    local st = pressed{ load = load }
    row.loads = row.loads + 1
    for _, by in ipairs{ "approach", "indentation", "flatten" } do
      row[by] = math.max(row[by], math.abs(pressed{ [by] = st[by] }.load / load - 1))
    end
  end
  back:write(row)
end
case:evidence(back, "Loads from 1e-200 to 0.05 N: each is pressed, then its approach, indentation or"
  .. " flattening is prescribed on fresh bodies. The columns are the largest errors of the load.", {
  { "scene", "%s" }, { "loads", "%d" }, { "approach", "%.0e" }, { "indentation", "%.0e" },
  { "flatten", "%.0e" } })
-- measured 8e-10
for _, by in ipairs{ "approach", "indentation", "flatten" } do case:expect(back, by, { at_most = 8e-9 }) end

for name, approach in lab.sorted{ ["1"] = 1, ["1 + 1e-12"] = 1 + 1e-12, ["2"] = 2, ["1e300"] = 1e300 } do
  case:refused("approach of " .. name .. " times h", function() line:press{ approach = approach * h } end,
    "cannot be reached", "full contact")
end
case:refused("an approach of 5e-324 m", function() line:press{ approach = 2.0 ^ -1074 } end, "1e-280")
case:refused("a negative approach", function() line:press{ approach = -1e-300 } end, "`approach`")
case:refused("a flattening above 1", function() line:press{ flatten = 1 + 2 ^ -52 } end, "`flatten`")
case:holds("an approach of 0 has no load, and a flattening of 0 has no contact",
  line:press{ approach = 0 }.load == 0
  and line:press{ flatten = 0 }.nodes_in_contact == 0)
local free = lab.contact{ lower = rough, upper = lab.rigid, boundary = "free",
  effects = { elasticity = "half_space" } }
local punch = lab.notebook "punch"
local one
for _, approach in ipairs{ 1, 10, 1e3, 1e6, 1e12 } do
  local st = free:press{ approach = approach }
  local slope = st.stiffness
  one = one or slope
  punch:write{ approach = approach, nodes = st.nodes_in_contact, stiffness = slope, error = math.abs(slope / one - 1),
    certificate = st.residual }
end
case:evidence(punch, "On a free boundary every approach has an answer: with all nodes in contact the tile"
  .. " is a square punch of constant stiffness.", { { "approach", "%.0e", "approach (m)" },
  { "nodes", "%d" }, { "stiffness", "%.4f", "stiffness (Pa/m)" }, { "error", "%.0e", "change" },
  { "certificate", "%.0e" } })
case:expect(punch, "nodes", { at_least = 48 * 48 })
case:expect(punch, "error", { at_most = 1e-15 }) -- measured 0
-- A surface that is soft after yield: the few distinct heights of a wave touch one after the other. Between
-- two of these heights the load hardly depends on the approach.
local soft = lab.notebook "soft"
local metal = lab.material{ young = 1e11, poisson = 0 }
for _, cells in ipairs{ 8, 16, 96 } do
  local function fresh()
    return lab.contact{ lower = lab.surface.sine{ cells = cells, size = 1e-3, amplitude = 1e-6,
      material = metal }, upper = lab.rigid, boundary = "periodic",
      effects = { elasticity = "half_space", plasticity = { hardness = 2e7, hardening = 1e11 } } }
  end
  local st = fresh():press{ indentation = 0.3 }
  local again = fresh():press{ pressure = st.pressure }
  soft:write{ cells = cells, transforms = st.cost.transforms, load = again.cost.transforms,
    error = math.abs(st.indentation / 0.3 - 1), apart = math.abs(again.indentation / 0.3 - 1),
    certificate = st.residual }
end
case:evidence(soft, "A wave that is soft after yield, pressed to 0.3 of its height, and then by the resulting"
  .. " pressure.", {
  { "cells", "%d" }, { "transforms", "%.0f" }, { "load", "%.0f", "transforms by pressure" },
  { "error", "%.0e" }, { "apart", "%.0e", "difference by pressure" }, { "certificate", "%.0e" } })
case:expect(soft, "error", { at_most = 1e-15 })
case:expect(soft, "transforms", { at_most = 150 })
case:finish{ worst = "8e-10 of the load, there and back", verdict = "right answer, then a clear error" }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- The opposite rims of a measured map differ: how does a periodic half-space treat the step?
--
-- A periodic tile repeats itself. A tilted map has a step at the rim, as high as the whole tilt, and the
-- upper edge carries the load in every tile. The solution is right, but the user may have meant another
-- problem: the program warns and names the free boundary.
--! error: does not continue across the rim
--! error: boundary="free"

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 8, title = "A step at the rim", edge = "a tilt of a rough map from 0 to 100 times its height",
  elsewhere = "The Fourier transform treats every map as periodic. The rim carries the load, without a"
    .. " warning.",
  here = "The first press warns, also in the journal of the run, and suggests `boundary = \"free\"`,"
    .. " which has no step. A surface generated as periodic gives no warning.",
}

local n, unit = 64, lab.material{ young = 1, poisson = 0 }
local rough = lab.surface.self_affine{ cells = n, size = 1, hurst = 0.8, rms_height = 1e-3, short_wave = 0.1,
  material = unit }
local base = rough:heights()
local function tilted(times)
  local height = rough.peak_to_valley
  local rows = {}
  for j = 1, n do
    rows[j] = {}
    for i = 1, n do rows[j][i] = base[j][i] + times * height * (i - 1) / n end
  end
  return lab.surface.from_table{ size = 1, heights = rows, material = unit }
end
local book = lab.notebook "tilt"
for _, times in ipairs{ 0, 1e-3, 0.01, 0.1, 0.3, 1, 3, 10, 100 } do
  local s = times == 0 and rough or tilted(times)
  local row = { tilt = times, continues = s.periodic and "yes" or "no" }
  for _, boundary in ipairs{ "periodic", "free" } do
    local st = lab.contact{ lower = s, upper = lab.rigid, boundary = boundary,
      effects = { elasticity = "half_space" } }
      :press{ pressure = 3e-3 }
    local rim, P = 0, st:field "pressure"
    for j = 0, n - 1 do
      for i = n - 4, n - 1 do rim = rim + P:value(i, j) end
    end
    row[boundary] = rim / (n * n * st.pressure)
    row.iterations, row.certificate = math.max(row.iterations or 0, st.iterations),
      math.max(row.certificate or 0, st.residual)
  end
  book:write(row)
end
case:evidence(book, "Share of the load on the last four of 64 columns, the upper edge of the tilt.",
  { { "tilt", "%g", "tilt over height" },
  { "continues", "%s", "continues across the rim" }, { "periodic", "%.3f" }, { "free", "%.3f" },
  { "iterations", "%d" },
  { "certificate", "%.0e" } })
case:expect(book, "certificate", { at_most = 1e-6 })
case:holds("`periodic` is true for a generated periodic surface, and false after a tilt by its own height",
  rough.periodic and not tilted(1).periodic)
-- A step in the middle of the tile gives the same periodic contact.
local step = tilted(1)
local function pressed(surface)
  return lab.contact{ lower = surface, upper = lab.rigid, boundary = "periodic",
    effects = { elasticity = "half_space" },
    accuracy = { tolerance = 1e-12 } }:press{ pressure = 3e-3 }
end
local there, here = pressed(step), pressed(step:shifted{ x = 0.5 })
local moved = lab.notebook "moved"
moved:write{ nodes = there.nodes_in_contact, ["nodes moved"] = here.nodes_in_contact,
  approach = math.abs(here.approach / there.approach - 1),
  energy = math.abs(here.energy / there.energy - 1), certificate = here.residual }
case:evidence(moved, "A step as high as the rough map, at the rim and shifted to the middle of the"
  .. " tile.", { { "nodes", "%d" },
  { "nodes moved", "%d", "nodes, shifted" }, { "approach", "%.0e", "change of approach" },
  { "energy", "%.0e", "change of energy" },
  { "certificate", "%.0e" } })
case:expect(moved, "approach", { at_most = 1e-14 }) -- measured 0
case:expect(moved, "energy", { at_most = 1e-14 }) -- measured 1e-16, at a tolerance of 1e-12
case:expect(moved, "nodes moved", { near = there.nodes_in_contact, within = 0 })
case:finish{ worst = "warned", verdict = "right answer, with a warning" }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- A measured map does not end where it began: what does a periodic half-space make of the step at its rim?
--
-- Periodic means that the tile goes on with itself. A tilted map then has a step as high as the whole tilt at
-- the rim, and its upper edge carries the load, row after row of tiles. The answer to the question asked is
-- right, but the question may not be what was meant: the program says so, and names the free boundary.
--! error: does not continue across the rim
--! error: boundary="free"

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 8, title = "A step at the rim", edge = "a tilt of a rough map from 0 to 100 times its height",
  elsewhere = "The Fourier transform takes every map as periodic, the rim carries the load, and nothing"
    .. " says so.",
  here = "The first press warns, in the journal of the run too, and offers `boundary = \"free\"`, which"
    .. " knows no step. A surface generated as periodic gives no warning.",
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
case:holds("a generated periodic surface is known to continue; tilted by its own height it is known not to",
  rough.periodic and not tilted(1).periodic)
-- The same step in the middle of the tile is the same periodic contact.
local step = tilted(1)
local function pressed(surface)
  return lab.contact{ lower = surface, upper = lab.rigid, boundary = "periodic",
    effects = { elasticity = "half_space" },
    accuracy = { tolerance = 1e-12 } }:press{ pressure = 3e-3 }
end
local there, here = pressed(step), pressed(step:shifted{ x = 0.5 })
local moved = lab.notebook "moved"
moved:write{ nodes = there.contacts, ["nodes moved"] = here.contacts,
  approach = math.abs(here.approach / there.approach - 1),
  energy = math.abs(here.energy / there.energy - 1), certificate = here.residual }
case:evidence(moved, "A step of the rough map's own height, at the rim and shifted to the middle of the"
  .. " tile.", { { "nodes", "%d" },
  { "nodes moved", "%d", "nodes, shifted" }, { "approach", "%.0e", "change of approach" },
  { "energy", "%.0e", "change of energy" },
  { "certificate", "%.0e" } })
case:expect(moved, "approach", { at_most = 1e-14 }) -- measured 0
case:expect(moved, "energy", { at_most = 1e-14 }) -- measured 1e-16, at a tolerance of 1e-12
case:expect(moved, "nodes moved", { near = there.contacts, within = 0 })
case:finish{ worst = "warned", verdict = "right answer, with a warning" }

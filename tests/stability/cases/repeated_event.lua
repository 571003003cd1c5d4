-- SPDX-License-Identifier: GPL-3.0-or-later
-- The same event again without a turn: does the second event yield anything? Does a smaller load before a
-- larger load matter?
--
-- Yielded ground fits the other body. Under the same load nothing more yields, and the contact uses this fact
-- as long as nobody moves the bodies. Without hardening, a smaller load before a larger load leaves no trace
-- either. A load greater by its last digit is solved anew: its plastic volume is the error of both solves.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 11, title = "The same event again", edge = "tolerance from 1e-4 to 1e-12; ten repeats; the"
    .. " first load from 1 % to 99.9 % of the second",
  elsewhere = "The solver's error makes every repeat yield a little more: a specimen wears without being"
    .. " moved.",
  here = "A repeat yields nothing. A load greater by its last digit yields less than ten times the"
    .. " tolerance, relative to the first event. A smaller load before a larger one leaves no trace.",
}
local function specimen(seed)
  return lab.surface.self_affine{ cells = 64, size = "250 um", hurst = 0.8, ra = "2 um", short_wave = "24 um",
    seed = seed,
    material = lab.material "Al-2011" }
end
local a, b = specimen(1), specimen(2)
local function bench(tolerance, boundary, hardening)
  return lab.contact{ lower = a, upper = b, boundary = boundary,
    effects = { elasticity = "half_space", plasticity = { hardening = hardening } },
    accuracy = { tolerance = tolerance } }
end
local scenes = { { "periodic", "periodic" }, { "free", "free" }, { "periodic, hardening", "periodic", 8e13 } }
local book = lab.notebook "again"
for _, scene in ipairs(scenes) do
  for _, tolerance in ipairs{ 1e-4, 1e-6, 1e-8, 1e-10, 1e-12 } do
    local c = bench(tolerance, scene[2], scene[3])
    local first = c:press{ pressure = "150 MPa" }
    c:release()
    local again = 0
    for _ = 1, 10 do
      local st = c:press{ pressure = "150 MPa" }
      again = math.max(again, math.abs(st.plastic_volume) / first.plastic_volume)
      c:release()
    end
    local more = c:press{ pressure = 150e6 * (1 + 2^-52) }.plastic_volume / first.plastic_volume
    book:write{ scene = scene[1], tolerance = tolerance, first = first.plastic_volume, again = again,
      more = more, over = more / tolerance, iterations = first.iterations, certificate = first.residual }
  end
end
case:evidence(book, "Two rough bodies, 64 x 64 nodes, 150 MPa eleven times: the largest plastic volume of a"
  .. " repeat over the first plastic volume, and the plastic volume of a load greater by its last digit.",
  { { "scene", "%s" }, { "tolerance", "%.0e" }, { "first", "%.2e", "first event (m^3)" },
  { "again", "%g", "a repeat, over the first" }, { "more", "%.0e", "one more digit, over the first" },
  { "iterations", "%d" },
  { "certificate", "%.0e" } })
case:expect(book, "again", { at_most = 0, label = "a repeat yields nothing" })
-- measured 1
case:expect(book, "over", { at_most = 10, label = "a load greater by its last digit yields less than ten"
  .. " times the tolerance" })

local path = lab.notebook "path"
for _, scene in ipairs(scenes) do
  local alone = bench(1e-10, scene[2], scene[3])
  local once = alone:press{ pressure = "150 MPa" }
  alone:release()
  local heights = alone:lower():heights()
  for _, share in ipairs{ 0.01, 0.1, 0.5, 0.9, 0.999 } do
    local c = bench(1e-10, scene[2], scene[3])
    local before = c:press{ pressure = share * 150e6 }
    c:release()
    local after = c:press{ pressure = "150 MPa" }
    c:release()
    local worst, most = 0, 0
    local depth = once:field "plastic".max
    for j, row in ipairs(c:lower():heights()) do
      for i, z in ipairs(row) do worst = math.max(worst, math.abs(z - heights[j][i]) / depth) end
    end
    path:write{ scene = scene[1], share = share,
      volume = math.abs((before.plastic_volume + after.plastic_volume) / once.plastic_volume - 1),
      heights = worst, certificate = after.residual }
  end
end
case:evidence(path, "A smaller load first, tolerance 1e-10: change of the plastic volume, and of the lower heights"
  .. " over the largest plastic depth.",
  { { "scene", "%s" }, { "share", "%g", "first load over second" }, { "volume", "%.0e" },
    { "heights", "%.0e" }, { "certificate", "%.0e" } })
case:expect(path, "volume", { at_most = 1e-10, label = "the tolerance" }) -- measured 1e-11
case:expect(path, "heights", { at_most = 2e-10 }) -- measured 2e-11
case:finish{ worst = "a repeat yields nothing; a load greater by its last digit, about the tolerance",
  verdict = "right answer" }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Dwells from zero to longer than the age of the universe: the hardness under creep.
--
-- H(t) = H_ref (1 + b ln(1 + t_ref/t_c)) / (1 + b ln(1 + t/t_c)). H must equal H_ref at t_ref, never rise
-- with time and never be zero, and a load above H(t) must be refused. On soft waves the share of the tile in
-- contact is p̄/H(t), so the area gives H.

local lab = require "asperity"
local case = require "asperity.hard_case"{
  number = 18, title = "Long dwells", edge = "dwell from 0 and 5e-324 s to 1e308 s; rate from 0 to 1e6",
  elsewhere = "ln(1 + t/t_c) is computed as written: it is zero for short times and infinite for long times.",
  here = "The hardness falls with the logarithm of time up to the end of the range. A load above the"
    .. " hardness is refused.",
}
local H = 1e-6
local s = lab.surface.sine{ cells = 128, size = 1, amplitude = 0.01, directions = 2,
  material = lab.material{ young = 1, poisson = 0, hardness = H } }
local function bench(rate)
  return lab.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
    effects = { elasticity = "half_space", plasticity = {}, creep = { rate = rate, onset = 1,
      reference = 600 } }, accuracy = { tolerance = 1e-9 } }
end
local function log1p(x) -- ln(1 + x), right to rounding for small x too
  if x < 1e-5 then return x - x * x / 2 + x * x * x / 3 end
  return math.log(1 + x)
end
local book, before = lab.notebook "dwell", 0
for _, t in ipairs{ 0, 2.0 ^ -1074, 1e-300, 1e-9, 1e-3, 1, 600, 3600, 86400, 3e7, 4.4e17, 1e100, 1e300,
  1.7e308 } do
  local st = bench(0.02):press{ pressure = 0.05 * H, dwell = t }
  local hardness = H * (1 + 0.02 * log1p(600)) / (1 + 0.02 * log1p(t))
  book:write{ dwell = t, peak = st.peak_pressure / H, error = math.abs(st.peak_pressure / hardness - 1),
    capped = st.plastic_fraction,
    area = math.abs(st.area_fraction / (0.05 * H / hardness) - 1),
    falls = st.plastic_fraction >= before and 1 or 0, certificate = st.residual }
  before = st.plastic_fraction
end
case:evidence(book, "A soft body under a twentieth of its stated hardness, rate 0.02, onset 1 s,"
  .. " reference 600 s, 128 x 128 nodes.", { { "dwell", "%.1e", "dwell (s)" },
  { "peak", "%.6f", "hardness over the hardness at 600 s" }, { "error", "%.0e", "error of the hardness" },
  { "capped", "%.4f", "share at the cap" }, { "area", "%.0e", "area error" },
  { "certificate", "%.0e" } })
case:expect(book, "error", { at_most = 2e-15 }) -- measured 2e-16
case:expect(book, "area", { at_most = 5e-2 }) -- measured 2e-2
case:expect(book, "falls", { at_least = 1 })
case:holds("at the reference time the hardness equals the stated hardness to the last bit",
  bench(0.02):press{ pressure = 0.05 * H, dwell = 600 }.peak_pressure == H)
case:holds("a press without `dwell` is a press of the reference time",
  bench(0.02):press{ pressure = 0.05 * H }.digest == bench(0.02):press{ pressure = 0.05 * H,
  dwell = 600 }.digest)
case:holds("with a rate of 0 the dwell changes nothing", bench(0):press{ pressure = 0.05 * H,
  dwell = 1e300 }.digest == bench(0):press{ pressure = 0.05 * H, dwell = 1 }.digest)
case:refused("0.05 of the hardness for 1e300 s at a rate of 1e6",
  function() bench(1e6):press{ pressure = 0.05 * H, dwell = 1e300 } end, "cannot be carried")
case:refused("0.9 of the hardness for 1e17 s", function() bench(0.02):press{ pressure = 0.9 * H,
  dwell = 1e17 } end, "cannot be carried")
case:refused("a negative dwell", function() bench(0.02):press{ pressure = 0.05 * H,
  dwell = -1 } end, "`dwell`")
case:refused("an infinite dwell", function() bench(0.02):press{ pressure = 0.05 * H,
  dwell = math.huge } end, "`dwell`")
case:finish{ worst = "2e-16 of the hardness; refused above it", verdict = "right answer, then a clear error" }

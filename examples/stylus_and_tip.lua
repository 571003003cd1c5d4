-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does a stylus miss because its tip is round?
--
--   asperity run examples/stylus_and_tip.lua
--   asperity run examples/stylus_and_tip.lua -- cells=1600 tile="400 um" count=10
--
-- A self-affine specimen with waves down to 2 µm is traced by ever blunter tips along the same lines, a
-- sample every 0.25 µm. A tip of 2 µm, the usual one, keeps Ra, which lives in the long waves; it rides
-- over the fine valleys, so slope and profile length (the source paper's measure of dimension) are lost
-- first. The blunter the tip, the more. The control: where the specimen itself has no fine waves, the
-- tip changes nothing.

local lab = require "asperity"
local arguments = require "asperity.arguments"
local um = lab.units.um
local given = arguments({ cells = 800, tile = "200 um", count = 5, seed = 1 }, ...)

-- 1. The specimen, and the same long waves without the fine ones.
local function specimen(short_wave)
  return lab.surface.self_affine{ cells = given.cells, size = given.tile, hurst = 0.5, ra = "1 um",
                                  roll_off = "100 um", short_wave = short_wave, seed = given.seed }
end
local fine, coarse = specimen "2 um", specimen "40 um"

-- 2. The same lines with every tip.
local book = lab.notebook "stylus-and-tip"
local function trace(surface, tip)
  local traces = lab.stylus{ tip = tip, length = "1 mm" }:scan(surface, { count = given.count, seed = given.seed })
  local excess = 0
  for _, t in ipairs(traces) do excess = excess + (t:fractal_dimension{ method = "length" }.D - 1) / #traces end
  return traces.tip_effect, excess
end

print "tip        Ra kept   slope kept   D - 1     tip stands above the surface"
local sharp
for _, radius in ipairs{ 0, 2, 5, 12.5 } do
  local effect, excess = trace(fine, radius * um)
  sharp = sharp or excess
  print(("%4.1f um   %6.3f    %6.3f       %.5f   %.0f nm"):format(radius, effect.Ra_ratio, effect.rms_slope_ratio,
    excess, effect.mean_lift * 1e9))
  book:write{ ["tip [m]"] = radius * um, Ra_kept = effect.Ra_ratio, slope_kept = effect.rms_slope_ratio,
              dimension_kept = excess / sharp, ["lift [m]"] = effect.mean_lift }
end
local control = trace(coarse, 2 * um)
print(("without fine waves a tip of 2 um keeps %.4f of Ra and %.4f of the slope"):format(control.Ra_ratio,
  control.rms_slope_ratio))

-- 3. What must hold.
book:expect("lift", { increasing_in = "tip" })
book:expect("slope_kept", { decreasing_in = "tip" })
book:expect("dimension_kept", { decreasing_in = "tip" })
book:expect("Ra_kept", { where = { tip = 2 * um }, near = 1, within = 0.02 })
book:write{ control = control.rms_slope_ratio }
book:expect("control", { near = 1, within = 0.02 })
book:chart{ x = "tip", y = "slope_kept" }

-- SPDX-License-Identifier: GPL-3.0-or-later
-- What does a stylus miss because its tip is round?
--
--   asperity run examples/stylus_and_tip.lua
--
-- The usual tip of 2 µm preserves Ra, which depends on the long waves. It rides over fine valleys
-- and loses slope and profile length, the source paper's measure of dimension; blunter tips lose
-- more. On a specimen without fine waves the tip changes nothing.

local lab = require "asperity"
local given = require "asperity.arguments"({ cells = 800, tile = "200 um", count = 5, seed = 1 }, ...)

-- 1. The specimen, and a specimen with the long waves only.
local function specimen(short_wave)
  return lab.surface.self_affine{ cells = given.cells, size = given.tile, hurst = 0.5, ra = "1 um",
                                  roll_off = "100 um", short_wave = short_wave, seed = given.seed }
end
local fine, coarse = specimen "2 um", specimen "40 um"

-- 2. Traces along the same lines with every tip.
local book = lab.notebook "stylus-and-tip"
local function trace(surface, tip)
  local stylus, excess = lab.stylus{ tip = tip, length = "1 mm" }, 0
  local traces = stylus:scan(surface, { count = given.count, seed = given.seed })
  for _, t in ipairs(traces) do
    excess = excess + (t:fractal_dimension{ method = "length" }.D - 1) / #traces
  end
  return traces.tip_effect, excess
end

for _, tip in ipairs{ "0 um", "2 um", "5 um", "12.5 um" } do
  local effect, excess = trace(fine, tip)
  book:write{ tip = tip, Ra_kept = effect.Ra_ratio, slope_kept = effect.rms_slope_ratio, excess = excess,
    dimension_kept = excess / (book[1] and book[1].excess or excess), ["lift [m]"] = effect.mean_lift }
end
print "The kept shares of Ra and slope, D - 1, and how far the tip stands above the surface:"
book:show{ "tip [um]", "Ra_kept", "slope_kept", "excess", "lift [nm]", digits = 4 }
local control = trace(coarse, "2 um")
lab.say("without fine waves a tip of 2 um keeps %.4f of Ra and %.4f of the slope", control.Ra_ratio,
  control.rms_slope_ratio)

-- 3. Expectations.
book:expect("lift", { increasing_in = "tip" })
book:expect("slope_kept", { decreasing_in = "tip" })
book:expect("dimension_kept", { decreasing_in = "tip" })
book:expect("Ra_kept", { where = { tip = "2 um" }, near = 1, within = 0.02 })
book:write{ control = control.rms_slope_ratio }
book:expect("control", { near = 1, within = 0.02 })
book:chart{ x = "tip", y = "slope_kept" }

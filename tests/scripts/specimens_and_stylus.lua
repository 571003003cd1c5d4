-- SPDX-License-Identifier: GPL-3.0-or-later
-- Bead-blasted specimens and the stylus from a script: what they give, and what they refuse.
--! output: all as it should be
local lab = require "asperity"
local S, um = lab.surface, lab.units.um
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
local function near(a, b, relative) assert(math.abs(a / b - 1) <= relative, a .. " is not near " .. b) end

-- The specimen.
local keys = { cells=128, size="500 um", ra="3 um" }
local s = S.bead_blasted(keys)
near(s:roughness().Ra, 3 * um, 1e-12)
assert(s.periodic and s.aliased_share == nil and s == S.bead_blasted(keys))
local al = lab.material "Al-2011"
assert(S.bead_blasted{ cells=64, size="500 um", ra="3 um", fine=false, material=al }.material == al)
local blunt = S.bead_blasted{ cells=128, size="500 um", ra="3 um", bead="280 um", dent={ "30 um", 40e-6 },
                              coverage=2, fine={ hurst=0.7, roll_off="50 um", short_wave="20 um", share=0.2 } }
assert(blunt ~= s)
refused(function() S.bead_blasted{ cells=128, size="500 um" } end, "`ra` is missing: mean absolute height")
refused(function() S.bead_blasted{ cells=128, size="500 um", ra="3 um", beads=1 } end, "(did you mean `bead`?)")
refused(function() S.bead_blasted{ cells=128, size="500 um", ra="3 um", fine={ hurts=0.7 } } end,
  "`fine`: unknown key `hurts` (did you mean `hurst`?)")
refused(function() S.bead_blasted{ cells=128, size="500 um", ra="3 um", fine=true } end,
  "`fine` is the boolean true; give a table of named keys, or false for none")
refused(function() S.bead_blasted{ cells=128, size="500 um", ra="3 um", dent={ "60 um", "25 um" } } end,
  "`dent` runs from 60 um down to 25 um")
refused(function() S.bead_blasted{ cells=128, size="500 um", ra="3 um", dent="200 um" } end,
  "`dent` allows a radius of 200 um", "give smaller radii as `dent`")
refused(function() S.bead_blasted{ cells=8, size="500 um", ra="3 um" } end, "give more `cells`")
refused(function() S.bead_blasted{ cells=25, size="500 um", ra="3 um" } end, "the fine texture: `short_wave` is 16 um")
refused(function() S.bead_blasted{ cells=128, size="500 um", ra="3 MPa", coverage=0, bead={ 1, 2, 3 } } end,
  "3 problems", "`ra`: ", "`coverage` is 0", "`bead` is a list of 3")

-- The instrument.
local stylus = lab.stylus{ length="1 mm" }
assert(stylus.tip == 2e-6 and stylus.spacing == 0.25e-6 and stylus.samples == 4000 and stylus.speed == nil)
assert(lab.stylus() == lab.stylus{} and lab.stylus{} ~= stylus)
local timed = lab.stylus{ speed="50 um/s", rate="100 Hz" }
near(timed.spacing, 0.5 * um, 1e-15)
near(lab.stylus{ spacing="0.5 um", speed="50 um/s" }.rate, 100, 1e-15)
refused(function() lab.stylus{ spacing="0.25 um", speed="50 um/s", rate="100 Hz" } end,
  "`spacing` is 250 nm, and `speed`/`rate` is 500 nm")
refused(function() lab.stylus{ tip="-2 um" } end, '`tip` is "-2 um"')
refused(function() lab.stylus{ radius="2 um" } end, "unknown key `radius`")
refused(function() lab.stylus{ length="0.3 um" } end, "at least two spacings")
refused(function() return stylus.lenght end, "a stylus has no field `lenght` (did you mean `length`?)")

-- Its traces: a plain list, and the effect of the tip.
local traces = stylus:scan(s, { count=3, seed=2 })
assert(#traces == 3 and #traces.lines == 3)
local count = 0
for k, trace in ipairs(traces) do
  count = count + 1
  assert(k == count and trace.points == 4000 and trace.length == 1e-3)
  assert(trace:levelled():roughness().Ra > 1 * um)
end
assert(count == 3)
assert(traces[1] == stylus:scan(s, { seed=2 })[1] and #stylus:scan(s) == 5)
assert(traces[1] ~= stylus:scan(s, { seed=3 })[1])
assert(traces[1]:fractal_dimension{ method="structure" }.D >= 1)
traces[1]:write "trace.csv"
assert(lab.profile.read "trace.csv" .points == 4000)
local effect = traces.tip_effect
assert(effect.mean_lift > 0 and effect.greatest_lift >= effect.mean_lift and effect.rms_slope_ratio > 0)
refused(function() return effect.Raratio end, "a tip effect result has no field `Raratio` (did you mean `Ra_ratio`?)")
local needle = lab.stylus{ tip=0, length="1 mm" }:scan(s, { count=3, seed=2 })
assert(needle.tip_effect.Ra_ratio == 1 and needle.tip_effect.mean_lift == 0)
near(traces[1]:roughness().Ra + traces[2]:roughness().Ra + traces[3]:roughness().Ra,
  effect.Ra_ratio * (needle[1]:roughness().Ra + needle[2]:roughness().Ra + needle[3]:roughness().Ra), 1e-12)
local open = s:cropped{ size="200 um" }
assert(#stylus:scan(S.flat{ cells=4, size="2 mm" }, { count=2 }) == 2)
refused(function() stylus:scan(open) end, "a trace of `length` 1 mm does not fit", "its diagonal")
refused(function() stylus:scan() end, "surface")
refused(function() stylus:scan(s, { count=0 }) end, "`count` is 0")
refused(function() stylus:scan(s, { conut=3 }) end, "(did you mean `count`?)")

-- The map as the tip gives it, and the part within reach of the tip.
local wide = lab.stylus{ tip="50 um" }
local felt, reached = wide:dilated(s), wide:closed(s)
assert(felt.periodic and felt:roughness().valley > s:roughness().valley)
assert(reached:height(3, 4) <= felt:height(3, 4) and reached:height(3, 4) >= s:height(3, 4) - 1e-20)
print "all as it should be"

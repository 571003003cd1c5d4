-- Fractal dimension and its traps
-- Question: A profile was made with D = 1.5. Does a ruler walked along
--   it find this D?
-- Predict: From valley to peak it is 0.5 um, from end to end 50 um.
--   Which D does the ruler find: 1.0, 1.1, 1.3 or 1.5?
-- Minutes: 20
--
-- A ruler of length s walks along a profile and measures a length L;
-- L/L0 grows as s^(1-D), as on a coastline, where east and north are
-- lengths of the same kind. The **structure function** is the mean
-- square of the change of height over a distance s, and grows as
-- s^(4-2D) in any unit of height. Other methods count the **boxes**
-- along the profile, or fit a line to its spectrum (**psd**).
--
-- *Then try:* the knob `D`, the seed, `cells=1024`, or a face of your
-- own in section 3. Can you make a face that deceives the structure
-- function, too?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local prose = require "asperity.prose"
local my_guess = nil -- the ruler's D on heights of 0.5 um
guess.choices(my_guess, "1.0", "1.1", "1.3", "1.5")
local D = lab.knob{ name="D", from=1.2, to=1.8, value=1.5 }

-- The profiles of a surface of dimension D + 1 have dimension D.
local function fractal(D)
  return lab.surface.weierstrass_mandelbrot{ cells=256, D=D + 1, seed=1,
    L="50 um", G="5 um" }:scaled{ amplitude="0.5 um" }
end
-- Adds the D of every method to a row. The ruler is `length`.
local function dimensions(row, s)
  for _, method in ipairs{ "length", "structure", "box", "psd" } do
    row[method] = s:fractal_dimension{ method=method }.D
  end
  return row
end

-- 1. One surface with larger and larger heights. The longest ruler has
-- 16 cells.
local book, surface = lab.notebook "stretched", fractal(D)
for power = -1, 4 do
  local s = 10 ^ power * surface
  local change = s:fractal_dimension{ method="structure" }.lengths[5]
  book:write(dimensions({ stretch=10 ^ power, built_in=D,
    slope=s:roughness().rms_slope,
    over_longest=change ^ 0.5 / (16 * s.size[1] / s.cells[1]),
    believed=s:fractal_dimension().resolved }, s))
end
book:show{ "stretch", "slope", "over_longest", "length", "believed",
  "structure", "box", digits=5 }
book:chart{ x="stretch", y={ "built_in", "structure", "box", "length" },
  y_label="D of the profiles", log_x=true, file="stretched.svg",
  title="One fractal, three answers" }

-- 2. The built-in D and the D that the methods find.
local scale = lab.notebook "built in"
for _, built_in in ipairs{ 1.1, 1.3, 1.5, 1.7, 1.9 } do
  scale:write(dimensions({ built_in=built_in }, fractal(built_in)))
end
scale:chart{ x="built_in", y={ "built_in", "structure", "box", "psd" },
  y_label="D", title="D built in, D found", file="built_in.svg" }

-- 3. Three faces that are not fractal.
local others = lab.notebook "others"
others:write(dimensions({ face="a wave" }, lab.surface.sine{ cells=256,
  size="50 um", amplitude="1 um", wavelength="12.5 um" }))
others:write(dimensions({ face="noise" }, lab.surface.from_function{
  cells=256, size=1, height=function() return math.random() end }))
others:write(dimensions({ face="dents" }, lab.surface.bead_blasted{
  cells=256, size="500 um", ra="3 um", fine=false }))
others:show{ "face", "structure", digits=3 }

-- 4. Expectations, and the reason.
book:expect("structure", { near=D, within=0.1, label="in any unit" })
book:expect("length", { where={ stretch=1 }, at_most=1.01,
  label="the ruler finds almost nothing of D" })
book:expect("length", { where={ stretch=1e4 }, near=D, within=0.1,
  label="until hills are needles" })
scale:expect("box", { where={ built_in=1.5 }, near=1.5, within=0.1,
  should_fail=true, label="boxes on so few points find 1.5" })
local one = book:where{ stretch=1 }[1]
-- The least slope from which the program believes the ruler, to 2 %.
local steep = 5
repeat
  steep = 1.02 * steep
until (steep / one.slope * surface):fractal_dimension().resolved
guess{ said=my_guess, found=("%.1f"):format(one.length),
  of="the ruler's D", replies={
    ["1.1"]="With slopes of one in ten the path grows by 0.5 % only.",
    ["1.3"]="With slopes of one in ten the path grows by 0.5 % only.",
    ["1.5"]="A D that is built in is not a D that a ruler finds." } }
prose([[
On heights of 0.5 um the ruler found %.3f, stretched a hundredfold %.2f.

Why: a step of slope m is longer than its shadow by m^2/2, so the ruler
mixes slope and dimension: tenfold heights multiply its D - 1 by %.0f.
The structure function finds one D for all heights.

The program believes the ruler (`resolved`) if nine tenths of D - 1
should show: here from an rms slope of %.0f on, or %.1f over the longest
ruler. No machined face is that steep.

On %d points the worst errors of D are %+.2f by boxes, %+.2f by psd and
%+.2f by the structure function. Even dents get a D: first look
for a straight line over several decades in a log-log chart.]],
  one.length, book:where{ stretch=100 }[1].length,
  (one.length - 1) / (book:min "length" - 1), steep,
  steep / one.slope * one.over_longest, surface.cells[1],
  scale:max "box" - 1.9, scale:max "psd" - 1.9,
  scale:min "structure" - 1.1)

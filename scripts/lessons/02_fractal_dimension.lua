-- Fractal dimension and its traps
-- Question: A profile was made with D = 1.5. What does a ruler walked
--   along it say?
-- Predict: From valley to peak it is 0.5 um, from end to end 50 um.
--   Which D does the ruler find: 1.0, 1.1, 1.3 or 1.5? And what if only
--   the heights are stretched a hundredfold?
-- Minutes: 20
--
-- Walk along a profile with a ruler of length s. Shorter rulers follow
-- more of the bends, so the profile gets longer: L/L0 grows as s^(1-D).
-- On a coastline that works, for east and north are the same sort of
-- length. Are the heights and the widths of a surface?
--
-- The **structure function** asks something else: how much does the
-- height change, in the mean square, over a distance s? It grows as
-- s^(4-2D), whatever unit the heights are in. Other methods exist:
-- **boxes** counts the squares that the profile visits, **psd** fits a
-- line to its spectrum.
--
-- *Your prediction:* put its number into `my_guess` in the script; the
-- last lines compare it with what was found.
--
-- *Then try:* the seed, `cells = 1024`, or a face of your own in
-- `not_fractal`. Can you make one that fools the structure function
-- too?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local prose = require "asperity.prose"
local um = lab.units.um
local my_guess = nil -- the D that the ruler finds on heights of 0.5 um
local cells, seed = 256, 1
local function fractal(D)
  return lab.surface.weierstrass_mandelbrot{ cells=cells, D=D,
    L="50 um", G="5 um", seed=seed }
end

-- 1. One surface of D = 2.5, whose profiles have 1.5, stretched in
-- height: what do the methods say?
local book, found = lab.notebook "stretched", {}
-- The rulers are 1, 2, 4, 8 and 16 cells long; `structure` finds the
-- mean square of the change over each, too.
local function slope_of_longest(structure)
  local ruler = structure.steps[5] * 50 * um / cells
  return math.sqrt(structure.lengths[5]) / ruler
end
print("heights        rms slope   over the longest   ruler    "
  .. "believed   structure   boxes")
for power = -1, 4 do
  local height = 10 ^ power
  local s = fractal(2.5):scaled{ amplitude=0.5 * um * height }
  local ruler = s:fractal_dimension{ method="length" }
  local structure = s:fractal_dimension{ method="structure" }
  local row = { height=height, slope=s:roughness().rms_slope,
    ["slope over the longest"]=slope_of_longest(structure),
    ["built in"]=1.5, ruler=ruler.D, structure=structure.D,
    boxes=s:fractal_dimension{ method="box" }.D }
  found[power] = row
  book:write(row)
  local line = "0.5 um x %-5g  %8.4g   %8.3g           %.4f   %-3s   "
    .. "     %.3f       %.3f"
  print(line:format(height, row.slope, row["slope over the longest"],
    row.ruler, ruler.resolved and "yes" or "no", row.structure,
    row.boxes))
end
book:chart{ x="height", y={ "built in", "structure", "boxes", "ruler" },
  log_x=true, file="stretched.svg", x_label="heights stretched by",
  y_label="D of the profiles", title="One fractal, three answers" }

-- 2. What is built in against what is found.
local scale = lab.notebook "built in"
for _, D in ipairs{ 1.1, 1.3, 1.5, 1.7, 1.9 } do
  local s = fractal(D + 1)
  for _, method in ipairs{ "structure", "box", "psd" } do
    scale:write{ ["built in"]=D,
      found=s:fractal_dimension{ method=method }.D, method=method }
  end
  scale:write{ ["built in"]=D, found=D, method="(true)" }
end
scale:chart{ x="built in", y="found", one_line_per="method",
  file="built_in.svg", title="D built in, D found" }

-- 3. Faces that are no fractals at all get a D as well.
local not_fractal = {
  ["a wave"] = lab.surface.sine{ cells=256, size="50 um",
    amplitude="1 um", wavelength="12.5 um" },
  ["round dents"] = lab.surface.bead_blasted{ cells=256, size="500 um",
    ra="3 um", fine=false },
  ["pure noise"] = lab.surface.from_function{ cells=256, size="50 um",
    height=function() return um * math.random() end },
}
local others = lab.notebook "others"
print "\nno fractal      D by the structure function"
for name, s in lab.sorted(not_fractal) do
  local D = s:fractal_dimension{ method="structure" }.D
  print(("%-14s  %.2f"):format(name, D))
  others:write{ face=name, D=D }
end

-- 4. What must hold, and why.
book:expect("structure", { near=1.5, within=0.1,
  label="the structure function does not mind the unit of height" })
book:expect("ruler", { where={ height=1 }, at_most=1.01,
  label="the ruler sees next to nothing of D" })
scale:expect("found", { where={ ["built in"]=1.5, method="box" },
  near=1.5, within=0.1, should_fail=true,
  label="counting boxes on so few points finds 1.5" })
book:expect("ruler", { where={ height=1e4 }, near=1.5, within=0.1,
  label="until hills are needles" })

-- From which slope on does the program believe the ruler? Halve the
-- interval in which that begins.
local gentle, steep, believed = 1, 1000, nil
while steep / gentle > 1.02 do
  local slope = math.sqrt(gentle * steep)
  local s = fractal(2.5):scaled{
    amplitude=0.5 * um * slope / found[0].slope }
  if s:fractal_dimension{ method="length" }.resolved then
    steep, believed = slope, s
  else
    gentle = slope
  end
end
local off = {}
for _, row in ipairs(scale:rows()) do
  local error = row.found - row["built in"]
  if math.abs(error) >= math.abs(off[row.method] or 0) then
    off[row.method] = error
  end
end
local growth = (found[0].ruler - 1) / (found[-1].ruler - 1)
print()
prose([[
On heights of 0.5 um the ruler found %.3f, stretched a hundredfold
%.2f.]], found[0].ruler, found[2].ruler)
guess{ said=my_guess, found=found[0].ruler, of="the ruler's D",
  near=0.02 }
prose([[
Why: a step of slope m is longer than its shadow by m^2/2. While slopes
are small, D - 1 by the ruler goes with the slope squared: stretch the
heights tenfold, and it grows %.0f times here. So the ruler mixes how
rough a face is with how fractal it is. Heights and widths are not the
same sort of length: stretched heights are "the same" fractal, and the
structure function finds the same D, but the ruler walks along another
profile.

Every ruler must meet steep ground, and the longest meets the gentlest.
The program believes the ruler (`resolved`) where nine tenths of D - 1
should show: on this face from an rms slope of %.0f on, which is %.1f
over the longest ruler. No machined face is that steep. Below it
`resolved` is false, and `reason` says why.

No method is perfect: see built_in.svg. On profiles of %d points the
worst D that boxes find is off by %+.2f, that of the spectrum by %+.2f,
that of the structure function by %+.2f.

And a number always comes out: round dents are no fractal, but get their
D. First look whether a log-log chart is a straight line over several
decades; then believe its slope.]],
  growth, steep,
  slope_of_longest(believed:fractal_dimension{ method="structure" }),
  cells, off.box, off.psd, off.structure)

-- Fractal dimension and its traps
-- Question: A profile was made with D = 1.5. What does a ruler walked along it say?
-- Predict: From valley to peak it is 0.5 um, from end to end 50 um. Which D does the ruler find: 1.0, 1.1, 1.3
--   or 1.5? And what if only the heights are stretched a hundredfold?
-- Minutes: 20
--
-- Walk along a profile with a ruler of length s. Shorter rulers follow more of the bends, so the profile gets
-- longer: L/L0 grows as s^(1-D). On a coastline that works, for east and north are the same sort of length.
-- Heights and widths of a surface are not: double the heights and it is still "the same" fractal, but the
-- ruler sees another profile.
--
-- The **structure function** asks something else: how much does the height change, in the mean square, over
-- a distance s? It grows as s^(4-2D), whatever unit the heights are in. Other methods exist: **boxes** counts
-- the squares that the profile visits, **psd** fits a line to its spectrum.
--
-- *Then try:* the seed, `cells=1024`, or a face of your own in `not_fractal`. Can you make one that fools the
-- structure function too?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local um = lab.units.um
local my_guess = nil -- the D that the ruler finds on heights of 0.5 um
local function fractal(D)
  return lab.surface.weierstrass_mandelbrot{ cells=256, D=D, L="50 um", G="5 um", seed=1 }
end

-- 1. One surface of D = 2.5, whose profiles have 1.5, stretched in height: what do the methods say?
local book, found = lab.notebook "stretched", {}
print "heights       rms slope    ruler    structure   boxes"
for power = -1, 4 do
  local height = 10 ^ power
  local s = fractal(2.5):scaled{ amplitude=0.5 * um * height }
  local row = { height=height, slope=s:roughness().rms_slope, ["built in"]=1.5,
    ruler=s:fractal_dimension{ method="length" }.D, structure=s:fractal_dimension{ method="structure" }.D,
    boxes=s:fractal_dimension{ method="box" }.D }
  found[power] = row
  book:write(row)
  print(("0.5 um x %-6g %7.3g    %.4f   %.3f       %.3f"):format(height, row.slope, row.ruler, row.structure,
    row.boxes))
end
book:chart{ x="height", y={ "built in", "structure", "boxes", "ruler" }, log_x=true, file="stretched.svg",
            x_label="heights stretched by", y_label="D of the profiles", title="One fractal, three answers" }

-- 2. What is built in against what is found.
local scale = lab.notebook "built in"
for _, D in ipairs{ 1.1, 1.3, 1.5, 1.7, 1.9 } do
  local s = fractal(D + 1)
  for _, method in ipairs{ "structure", "box", "psd" } do
    scale:write{ ["built in"]=D, found=s:fractal_dimension{ method=method }.D, method=method }
  end
  scale:write{ ["built in"]=D, found=D, method="(true)" }
end
scale:chart{ x="built in", y="found", one_line_per="method", file="built_in.svg", title="D built in, D found" }

-- 3. Faces that are no fractals at all get a D as well.
local not_fractal = {
  ["a wave"] = lab.surface.sine{ cells=256, size="50 um", amplitude="1 um", wavelength="12.5 um" },
  ["round dents"] = lab.surface.bead_blasted{ cells=256, size="500 um", ra="3 um", fine=false },
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
book:expect("structure", { near=1.5, within=0.1, label="the structure function does not mind the unit of height" })
book:expect("ruler", { where={ height=1 }, at_most=1.01, label="the ruler sees next to nothing of D" })
scale:expect("found", { where={ ["built in"]=1.5, method="box" }, near=1.5, within=0.1, should_fail=true,
                        label="counting boxes on 256 points finds 1.5" })
book:expect("ruler", { where={ height=1e4 }, near=1.5, within=0.1, label="until hills are needles" })
local gentle = (found[0].ruler - 1) / (found[-1].ruler - 1)
print(([[

You said %s for the ruler. On heights of 0.5 um it found %.3f, stretched a hundredfold %.2f.
Why: a step of slope m is longer than its shadow by m^2/2. While slopes are small, D - 1 by the ruler goes with
the slope squared: stretch the heights tenfold, and it grows %.0f times here. So the ruler mixes how rough a face is
with how fractal it is. It tells the truth where slopes are above about 5, which no machined face has. The
program says so: fractal_dimension{...}.resolved is false, and `reason` says why.
No method is perfect: see built_in.svg. Counting boxes is far too low on a profile of 256 points. The structure
function is 0.12 too high for 1.1, the spectrum 0.13 for 1.9, where waves too short for the grid fill it up.
And a number always comes out: round dents are no fractal, but get their D. First look whether a log-log chart is
a straight line over several decades; then believe its slope.]]):format(my_guess or "nothing", found[0].ruler,
  found[2].ruler, gentle))

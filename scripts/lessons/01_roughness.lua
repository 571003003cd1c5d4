-- What roughness is, and what a stylus misses
-- Question: Three faces have the same Ra. Are they equally rough, and
--   can a stylus tell?
-- Predict: A ball of 5 um radius is drawn over the finest of them. What
--   share of Ra does it still find, and what share of the slope?
-- Minutes: 15
--
-- A hill of a rough face is called an **asperity**. **Ra** is how far
-- heights lie from their mean, on average. The **rms slope** is how
-- steep the face is, in the root mean square; it decides how two faces
-- touch (lesson 4).
--
-- A stylus is a ball on an arm. It comes down until it first touches,
-- and the height of the ball is what is written down.
--
-- *Your prediction:* put its numbers into `my_guess` in the script; the
-- last lines compare them with what was found.
--
-- *Then try:* `scanned = "swell"`, tips on another face. And `hurst =
-- 0.9`: less of the slope is then in the short waves. Which numbers
-- change, and why?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local prose = require "asperity.prose"
local um = lab.units.um
local my_guess = { Ra=nil, slope=nil } -- shares between 0 and 1
guess.names(my_guess, "Ra", "slope")
local scanned, hurst = "fine", 0.5

-- 1. Three faces, 100 um wide, with Ra = 0.5 um. They differ in their
-- shortest wave alone.
local function face(short_wave)
  return lab.surface.self_affine{ cells=512, size="100 um", hurst=hurst,
    ra="0.5 um", roll_off="50 um", short_wave=short_wave, seed=1 }
end
local faces =
  { swell=face "25 um", ground=face "5 um", fine=face "1 um" }
local three = lab.notebook "faces"
print "face      Ra, um   rms slope"
for number, name in ipairs{ "swell", "ground", "fine" } do
  local r = faces[name]:roughness()
  print(("%-8s  %.3f    %.2f"):format(name, r.Ra / um, r.rms_slope))
  three:write{ face=name, number=number, ["Ra [m]"]=r.Ra,
    slope=r.rms_slope }
end

-- 2. The same five lines over one face with ever larger balls; a radius
-- of 0 is a needle.
local book, lines, kept = lab.notebook "tips", lab.notebook "lines", {}
print "\ntip, um   Ra kept   slope kept"
for _, tip in ipairs{ 0, 1, 2, 5, 12.5 } do
  local stylus = lab.stylus{ tip=tip * um, spacing="0.1 um",
    length="200 um" }
  local traces = stylus:scan(faces[scanned], { count=5, seed=1 })
  kept[tip] = traces.tip_effect
  print(("%5.1f      %.3f     %.3f"):format(tip, kept[tip].Ra_ratio,
    kept[tip].rms_slope_ratio))
  book:write{ ["tip [m]"]=tip * um, ["Ra kept"]=kept[tip].Ra_ratio,
    ["slope kept"]=kept[tip].rms_slope_ratio }
  if tip == 0 or tip == 5 then
    local x, z = traces[1]:positions(), traces[1]:heights()
    for k = 1, 250 do
      lines:write{ ["x [m]"]=x[k], ["height [m]"]=z[k],
        tip=tip == 0 and "needle" or "ball of 5 um" }
    end
  end
end

-- 3. To look at.
lines:chart{ x="x", y="height", one_line_per="tip", points=false,
  file="lines.svg",
  title="The same line, felt by a needle and by a ball" }
book:chart{ x="tip", y={ "Ra kept", "slope kept" }, file="tips.svg",
  x_label="radius of the ball", y_label="share of what a needle finds",
  title="What a ball still finds" }
faces[scanned]:picture(scanned .. ".png",
  { view="relief", title="The face that is scanned: " .. scanned })

-- 4. What must hold, and why.
three:expect("slope", { increasing_in="number",
  label="one Ra, ever steeper" })
book:expect("Ra kept", { where={ tip=5 * um }, at_least=0.9,
  label="a ball of 5 um finds nearly all of Ra" })
if scanned ~= "fine" then
  book:expect("slope kept", { where={ tip=5 * um }, at_least=0.9,
    label="on long waves a ball finds the slope, too" })
else
  local losses = lab.notebook "losses"
  losses:write{
    ratio=(1 - kept[5].rms_slope_ratio) / (1 - kept[5].Ra_ratio) }
  losses:expect("ratio", { at_least=3,
    label="but of the slope it loses many times what it loses of Ra" })
end
local reason = [[
Why: Ra lives in the long waves, where the high hills are, and the ball
follows those. The slope lives in the short waves: over a wave the
height changes by little, but it does so within a micrometre. There the
ball does not reach the ground. Look at lines.svg: the ball draws round
hills and sharp valleys; a real face often has it the other way round,
so sharp valleys on a trace are the mark of the tip. Where the ball runs
high above the needle's line, a hill beside the line carries it: a tip
feels an area, not a line.]]
if scanned ~= "fine" then reason = [[
Why: the shortest waves of this face are so long and flat that a ball of
5 um reaches the ground nearly everywhere, and what it draws is the
face. On the fine face the same ball does not.]] end
print(("\nOf Ra %.2f is left, of the slope %.2f."):format(
  kept[5].Ra_ratio, kept[5].rms_slope_ratio))
guess{ said=my_guess.Ra, found=kept[5].Ra_ratio, of="the share of Ra" }
guess{ said=my_guess.slope, found=kept[5].rms_slope_ratio,
  of="the share of the slope" }
prose([[
%s

Ra does not say how *quickly* heights change: the three faces share one
Ra, and their slopes run from %.2f to %.2f. So a roughness number
belongs to a face *and* to the tip that found it.]],
  reason, faces.swell:roughness().rms_slope,
  faces.fine:roughness().rms_slope)

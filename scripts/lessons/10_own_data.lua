-- Your own scan or table
-- Question: You measured a face. Which Ra and which dimension D may you
--   write down, and with which conditions?
-- Predict: A map of 2 mm is filtered with a cut-off of 0.8 mm, then
--   with 0.08 mm. Which share of Ra does the shorter cut-off leave?
-- Minutes: 15
--
-- The **cut-off** separates roughness from waviness: a filter removes
-- the waves that are longer. A standard asks for five cut-offs on the
-- evaluation length.
--
-- A fractal has one **D** at all distances. The structure function, the
-- mean square of the change of height over a distance s, grows as
-- s^(4-2D). So each doubling of s gives a value of D, and the face has
-- a D only where these values agree. Here we ask for five doublings in
-- a row: a factor of 32, or a decade and a half.
--
-- Your data: on the page paste a trace of two columns (position and
-- height, both in um) into `pasted`; in the terminal name a map in
-- `file`. Without either, the lesson makes a map with D = 1.3 and adds
-- the noise of an instrument.
--
-- *Then try:* your data. Or the knob `noise` at 0 and at 0.05 um. When
-- does the face get a D, and is it 1.3?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local my_guess = nil -- a share between 0 and 1
local pasted = nil -- lines such as 2.5 0.31 between [[ and ]]
local file = nil -- such as "scan.x3p"
local cut_offs = { 0.8e-3, 0.25e-3, 0.08e-3 } -- m
local noise = lab.knob{ name="noise", from="0 um", to="0.2 um",
  value="0.1 um" }

-- 1. The face, without its tilt.
local face
if pasted then
  local text = assert(io.open("own.txt", "w"))
  text:write(pasted)
  text:close()
  face = lab.profile.read("own.txt", { unit_xy="um", unit="um" })
elseif file then
  face = lab.surface.read(file)
else
  local function map(hurst, long_wave, height, seed)
    return lab.surface.self_affine{ cells=512, size="2 mm", seed=seed,
      hurst=hurst, roll_off=long_wave, short_wave="8 um",
      rms_height=1e-6 } * (height / 1e-6)
  end
  face = map(0.7, "2 mm", 1e-6, 1) + map(0.5, "8 um", noise, 2)
end
face = face:levelled()
local length = pasted and face.length or face.size[1]
local samples = pasted and face.points or face.cells[1]

-- 2. Ra with the cut-offs of the standard that fit on the face.
local book = lab.notebook("Ra", { units={ cut_off="mm" } })
for _, cut_off in ipairs(cut_offs) do
  if cut_off <= length and cut_off >= 5 * length / samples then
    local Ra = face:filtered{ long_wave=cut_off }:roughness().Ra
    book:write{ ["cut_off [m]"]=cut_off, sections=length / cut_off,
      ["Ra [m]"]=Ra, enough=length >= 5 * cut_off }
  end
end
assert(#book:rows() > 1, "choose `cut_offs` that fit on your face")
book:show{ "cut_off [mm]", "sections", "enough", "Ra [um]", digits=3 }
book:chart{ x="cut_off", y="Ra", log_x=true, log_y=true,
  file="cut_off.svg", title="No Ra without its cut-off" }

-- 3. D of each doubling of the distance, and the longest row of
-- doublings that agree within 0.15.
local steps = { 1 }
while 8 * steps[#steps] <= samples do
  steps[#steps + 1] = 2 * steps[#steps]
end
local whole = face:fractal_dimension{ method="structure", steps=steps }
local scales, found = lab.notebook "scales", {}
for k = 1, #steps - 1 do
  found[k] = 2 - math.log(whole.lengths[k + 1] / whole.lengths[k], 4)
  scales:write{ ["distance [m]"]=steps[k] * length / samples,
    D=found[k], ["one line"]=whole.D }
end
scales:show{ "distance [um]", "D", digits=3 }
scales:chart{ x="distance", y={ "D", "one line" }, log_x=true,
  y_label="D", file="D.svg", title="Does one D hold at all distances?" }
local best = { doublings=0, D=0 }
for first = 1, #found do
  local low, high, sum = math.huge, -math.huge, 0
  for k = first, #found do
    low, high = math.min(low, found[k]), math.max(high, found[k])
    sum = sum + found[k]
    local n = k - first + 1
    if high - low <= 0.15 and n > best.doublings then
      best = { doublings=n, D=sum / n }
    end
  end
end

-- 4. Expectations, and the reason.
local own = pasted or file
local share = book:min "Ra" / book:max "Ra"
book:expect("Ra", { increasing_in="cut_off", label="longer, larger" })
if not own then
  book:expect("Ra", { where={ cut_off=0.08e-3 }, label="far less",
    at_most=0.6 * book:max "Ra" })
end
if not own and noise >= 0.1e-6 then
  scales:expect("D", { where={ distance=scales:min "distance" },
    at_least=1.5, label="noise raises D at short distances" })
end
lab.say("The shortest cut-off leaves %.2f of Ra. One line through all \z
  distances has D = %.2f.", share, whole.D)
lab.say("D agrees over %d doublings: %s.", best.doublings,
  best.doublings >= 5 and ("D = %.2f"):format(best.D)
    or "no dimension")
require "asperity.guess"{ said=my_guess, found=share, near=0.35,
  of="the share of Ra that is left" }
require "asperity.prose"[[Why: long waves are the highest, so a shorter
cut-off removes most of Ra. A number without its cut-off and its length
means nothing, and one section is one throw of the dice.

A line can be drawn through any points. Noise raises D at short
distances, and the end of the long waves raises it at long ones. One
line through all distances mixes three causes. A straight line is
necessary, not sufficient: a little noise bends the whole line.]]

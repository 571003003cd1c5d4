-- What roughness is, and what a stylus misses
-- Question: Three faces have the same Ra. Are they equally rough, and
--   can a stylus tell?
-- Predict: A ball of 5 um radius is drawn over the finest face. Which
--   share of Ra does it still find, and which share of the slope?
-- Minutes: 15
--
-- **Ra** is the mean distance of the heights from their mean. The **rms
-- slope** is the root mean square of the slope, which decides how two
-- faces touch (lesson 4). The tip of a stylus is a ball: it comes down
-- until it first touches, and the instrument records its height.
--
-- *Then try:* the knob `tip`, the radius of the ball. And `hurst=0.9`:
-- the short waves then have less of the slope. Which numbers change,
-- and why?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local prose = require "asperity.prose"
local my_guess = { Ra=nil, slope=nil } -- shares between 0 and 1
guess.names(my_guess, "Ra", "slope")
local tip = lab.knob{ name="tip", from="1 um", to="9 um", value="5 um" }

-- 1. Three faces with the same Ra and another shortest wave.
local faces, three = {}, lab.notebook "faces"
for name, wave in pairs{ swell="25 um", ground="5 um", fine="1 um" } do
  faces[name] = lab.surface.self_affine{ cells=512, size="100 um",
    hurst=0.5, ra="0.5 um", roll_off="50 um", short_wave=wave }
  local r = faces[name]:roughness()
  three:write{ face=name, wave=wave, Ra=r.Ra, slope=r.rms_slope }
end
three:show{ "face", "wave [um]", "Ra [um]", "slope", digits=3 }

-- 2. The same five lines with larger and larger balls. A ball of radius
-- 0 is a needle.
local book, lines = lab.notebook "tips", lab.notebook "lines"
for _, radius in ipairs{ 0, 1e-6, 2e-6, tip, 12.5e-6 } do
  local traces = lab.stylus{ tip=radius, spacing="0.1 um",
    length="200 um" }:scan(faces.fine)
  book:write{ ["radius [m]"]=radius, Ra_kept=traces.tip_effect.Ra_ratio,
    slope_kept=traces.tip_effect.rms_slope_ratio }
  if radius == 0 or radius == tip then
    local x, z = traces[1]:positions(), traces[1]:heights()
    for k = 1, 250 do
      lines:write{ ["x [m]"]=x[k], ["height [m]"]=z[k],
        tip=radius == 0 and "needle" or "ball" }
    end
  end
end
book:show{ "radius [um]", "Ra_kept", "slope_kept", digits=3 }

-- 3. Charts and a picture.
lines:chart{ x="x", y="height", one_line_per="tip", points=false,
  title="One line, by a needle and by a ball", file="lines.svg" }
book:chart{ x="radius", y={ "Ra_kept", "slope_kept" },
  y_label="share kept", title="The share that a ball finds",
  file="tips.svg" }
faces.fine:picture("fine.png", { view="relief", title="The fine face" })

-- 4. Expectations, and the reason. The ball loses at least three times
-- as large a share of the slope as of Ra.
local kept = book:where{ radius=tip }[1]
three:expect("slope", { decreasing_in="wave", label="ever steeper" })
book:expect("Ra_kept", { where={ radius=tip }, at_least=0.9,
  label="the ball finds nearly all of Ra" })
book:expect("slope_kept", { where={ radius=tip },
  at_most=3 * kept.Ra_kept - 2, label="but far less of the slope" })
lab.say("%.2f of Ra is left, and %.2f of the slope.", kept.Ra_kept,
  kept.slope_kept)
guess{ said=my_guess.Ra, name="Ra", found=kept.Ra_kept, near=0.05,
  of="the share of Ra" }
guess{ said=my_guess.slope, name="slope", found=kept.slope_kept,
  near=0.2, of="the share of the slope" }
prose([[
Why: the ball follows the long waves, which carry Ra. It does not reach
the ground between the short waves, which carry the slope of the fine
face. It draws round hills and sharp valleys (lines.svg), and a hill
next to the line can lift it: a tip feels an area, not a line.

One Ra, and slopes from %.2f to %.2f. A roughness number belongs to a
face *and* to a tip.]], three:min "slope", three:max "slope")

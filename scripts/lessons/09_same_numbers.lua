-- What a roughness number hides
-- Question: Two faces have the same Sa, the same Sq and the same Sdr,
--   to the last digit. Does rubber touch both alike?
-- Predict: One face is honed, the other is its cast. Which of them
--   touches rubber on more under 0.01 MPa (lightly)? Which under 0.3
--   MPa (hard)? And which seals under the smaller load?
-- Minutes: 15
--
-- **Sa** and **Sq** measure the distance of the heights from their
-- mean: the mean distance and the root mean square. **Sdr** is the
-- share by which the true area exceeds the projected area, so it
-- measures the slopes. Technical drawings require such numbers.
--
-- One of the two faces was honed: its hills were cut off, and the flats
-- have a finer roughness. The other face is its **cast**: every hill is
-- a pit, every pit a hill. A mean of squares or of magnitudes does not
-- distinguish up from down.
--
-- Rubber is so soft that nothing yields.
--
-- *Then try:* the knob `cut`, the share of the peak-to-valley height
-- that honing removes; at 0 only chance distinguishes the two faces.
-- Which numbers of the list would have warned you?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local my_guess = { lightly=nil, hard=nil, seals=nil }
guess.names(my_guess, "lightly", "hard", "seals")
guess.choices(my_guess, "honed", "cast", "alike")
local cut = lab.knob{ name="cut", from=0, to=0.7, value=0.5 }

-- 1. A face of rubber with its hills cut off and a finer face on top,
-- and its cast. Both are pressed onto a rigid flat.
local function rough(ra, longest, shortest, seed)
  return lab.surface.self_affine{ cells=256, size="500 um", hurst=0.8,
    ra=ra, roll_off=longest, short_wave=shortest, seed=seed,
    material=lab.material{ young="5 MPa", poisson=0.49 } }
end
local honed = rough("1 um", "100 um", "20 um", 3):cut{ fraction=cut }
  + rough("0.05 um", "40 um", "8 um", 4)
local numbers, curves = lab.notebook "numbers", lab.notebook "curves"
local book = lab.notebook "seal"
for name, face in lab.sorted{ honed=honed, cast=-honed } do
  local p, curve = face:areal_parameters(), face:bearing()
  numbers:write{ face=name, ["Sa [m]"]=p.Sa, ["Sq [m]"]=p.Sq, Sdr=p.Sdr,
    Ssk=p.Ssk, ["Spk [m]"]=p.Spk, ["Svk [m]"]=p.Svk }
  for percent = 1, 99 do
    curves:write{ face=name, ["share above"]=percent / 100,
      ["height [m]"]=curve:height(percent / 100) }
  end
  face:picture(name .. ".png", { view="relief", title=name })
  for st in lab.contact{ lower=face, upper=lab.rigid,
    boundary="periodic", effects={ elasticity="half_space" } }:sweep{
    pressure={ "0.01 MPa", "0.03 MPa", "0.1 MPa", "0.3 MPa" } } do
    book:write{ face=name, ["pressure [Pa]"]=st.pressure,
      area=st.corrected_area_fraction, ["gap [m]"]=st.mean_gap,
      ["stiffness [Pa/m]"]=st.stiffness, open=st:open_path() }
  end
end
numbers:show{ "face", "Sa [um]", "Sq [um]", "Sdr [%]", "Ssk",
  "Spk [um]", "Svk [um]", digits=7 }
book:show{ "face", "pressure [MPa]", "area [%]", "gap [um]",
  "stiffness [GPa/m]", "open", digits=5 }
curves:chart{ x="share above", y="height", one_line_per="face",
  points=false, file="bearing.svg", title="Same numbers, upside down" }
book:chart{ x="pressure", y="area", one_line_per="face", log_x=true,
  log_y=true, file="touching.svg", title="Which face touches on more?" }

-- 2. Expectations, and the reason.
-- The cast has the same Sa, Sq and Sdr.
for _, key in ipairs{ "Sa", "Sq", "Sdr" } do
  numbers:expect(key, { near=numbers:max(key), rel=1e-12, label=key })
end
local times = book:where{ face="honed" }:joined(
  book:where{ face="cast" }, { by="pressure", suffix="_cast" }):with{
  areas=function(row) return row.area / row.area_cast end,
  gaps=function(row) return row.gap / row.gap_cast end }
times:show{ "pressure [MPa]", "areas", "gaps", digits=3 }
local light = times:where{ ["pressure [MPa]"]=0.01 }
local hard = times:where{ ["pressure [MPa]"]=0.3 }
if cut >= 0.4 then
  light:expect("areas", { at_least=2, label="lightly twice the area" })
  hard:expect("areas", { at_most=1, label="hard less: open pits" })
  hard:expect("gaps", { at_least=2 * light[1].gaps, label="the gaps" })
end
book:with{ half=function(row)
  return row.open and row.area < 0.6 or not row.open and row.area > 0.35
end }:expect("half", { at_least=1,
  label="an open path ends at 35 to 60 % of the area" })
if cut == 0.5 then
  book:where{ ["pressure [MPa]"]=0.1 }:expect("open",
    { where={ face="honed" }, at_most=0, label="0.1 MPa: tight" })
end
local function larger(ratio)
  return ratio > 1.05 and "honed" or ratio < 0.95 and "cast" or "alike"
end
local function tight(face)
  return book:where{ face=face, open=false }:min "pressure" or 1e9
end
local means = "Means do not distinguish hills from pits."
guess{ said=my_guess.lightly, name="lightly", of="the light load",
  found=larger(light[1].areas), replies={ alike=means,
    cast="Light rubber touches tops, and the cast has few." } }
guess{ said=my_guess.hard, name="hard", of="the hard load",
  found=larger(hard[1].areas), replies={ alike=means,
    honed="Under a hard load the bottoms decide: pits stay open." } }
guess{ said=my_guess.seals, name="seals", of="the seal",
  found=larger(tight "cast" / tight "honed"), replies={ alike=means,
    cast="A small gap still leaks if the open ground is joined." } }
require "asperity.prose"[[Why: Sa, Sq and Sdr are means over the face. A
deep pit counts as much as a high hill. Light rubber touches the tops
only: flat and fine on the honed face, few and steep on its cast. Rubber
pressed hard reaches the bottoms: flat on the cast, narrow and deep on
the honed face. The less is cut, the more alike are both. The sign of
Ssk distinguishes the faces, and so do Spk and Svk.

Area and gap do not say which face seals: a gas needs an open path from
side to side. Such a path ends where 35 to 60 % touch. With half of the
height cut off, the honed face is tight under 0.1 MPa and its cast
leaks, although the mean gap of the honed face is larger: its pits are
islands. So press the map itself, not its numbers.]]

-- What a roughness number hides
-- Question: Two faces have the same Sa, the same Sq and the same Sdr,
--   to the last digit. Do they seal alike?
-- Predict: Both are pressed against rubber, with 0.01 MPa and then with
--   0.3 MPa. How many times the area of the one does the other touch
--   on, lightly and hard?
-- Minutes: 15
--
-- **Sa** and **Sq** say how far the heights of a face lie from their
-- mean, as a mean and as a root mean square. **Sdr** says how much
-- longer its skin is than its shadow, so how steep it is. Drawings ask
-- for such numbers.
--
-- One of the two faces was honed: its hills are cut away, and a finer
-- roughness is left on the flats. The other is its **cast**: what was
-- up is down. Squares and moduli do not know up from down.
--
-- Rubber is so soft that everything stays elastic. What it touches
-- carries; through what it does not a gas leaks.
--
-- *Your prediction:* put its numbers into `my_guess` in the script; the
-- last lines compare them with what was found.
--
-- *Then try:* `cut = 0.2`, which hones less, or `cut = 0`: two faces
-- that nothing but chance tells apart. Which numbers of the list would
-- have warned you?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local prose = require "asperity.prose"
local um, MPa = lab.units.um, lab.units.MPa
local my_guess = { lightly=nil, hard=nil } -- area, honed over cast
guess.names(my_guess, "lightly", "hard")
local cut, seed = 0.5, 3

-- 1. A face whose hills are cut away, with a finer one on top, and its
-- cast.
local function rough(ra, waves, shortest, number)
  return lab.surface.self_affine{ cells=256, size="500 um", hurst=0.8,
    ra=ra, roll_off=waves, short_wave=shortest, seed=number }
end
local honed = rough("1 um", "100 um", "20 um", seed):cut{ fraction=cut }
  + rough("0.05 um", "40 um", "8 um", seed + 1)
local faces = { honed=honed, cast=-honed }
local numbers, of = lab.notebook "numbers", {}
print("face       Sa, um    Sq, um       Sdr, %     Ssk     "
  .. "Spk, um   Svk, um")
for name, face in lab.sorted(faces) do
  local p = face:areal_parameters()
  print(("%-8s  %.6f  %.6f  %.7f  %6.3f    %.3f     %.3f"):format(name,
    p.Sa / um, p.Sq / um, 100 * p.Sdr, p.Ssk, p.Spk / um, p.Svk / um))
  numbers:write{ face=name, ["Sa [m]"]=p.Sa, ["Sq [m]"]=p.Sq, Sdr=p.Sdr,
    Ssk=p.Ssk }
  of[name] = p
  face:picture(name .. ".png", { view="relief",
    title="The " .. name .. " face" })
end

-- 2. Rubber pressed onto each.
local rubber =
  lab.material{ young="5 MPa", poisson=0.49, name="rubber" }
local book, found = lab.notebook "seal", { honed={}, cast={} }
print("\nface      pressure    touching   mean gap, um   "
  .. "stiffness, GPa/m")
for name, face in lab.sorted(faces) do
  local seal = lab.contact{ lower=face:with{ material=rubber },
    upper=lab.rigid, boundary="periodic",
    effects={ elasticity="half_space" } }
  for _, pressure in ipairs{ 0.01, 0.03, 0.1, 0.3 } do
    local st = seal:press{ pressure=pressure * MPa }
    local row = { face=name, ["pressure [Pa]"]=pressure * MPa,
      area=st.corrected_area_fraction, ["gap [m]"]=st.mean_gap,
      ["stiffness [Pa/m]"]=st.stiffness }
    book:write(row)
    found[name][pressure] = { area=row.area, gap=st.mean_gap }
    print(("%-8s  %.2f MPa   %6.2f %%      %.3f          %.1f"):format(
      name, pressure, 100 * row.area, st.mean_gap / um,
      st.stiffness / 1e9))
  end
end

-- 3. To look at: how much of each face lies above a height, and what
-- touches.
local curves = lab.notebook "curves"
for name, face in lab.sorted(faces) do
  local curve = face:bearing()
  for percent = 1, 99 do
    curves:write{ face=name, ["share above"]=percent / 100,
      ["height [m]"]=curve:height(percent / 100) }
  end
end
curves:chart{ x="share above", y="height", one_line_per="face",
  points=false, file="bearing.svg",
  title="The same numbers, upside down" }
book:chart{ x="pressure", y="area", one_line_per="face", log_x=true,
  log_y=true, file="touching.svg",
  x_label="mean pressure on the rubber", y_label="share that touches",
  title="Which touches on more, the honed face or its cast?" }

-- 4. What must hold, and why.
for _, key in ipairs{ "Sa", "Sq", "Sdr" } do
  numbers:expect(key, { near=of.cast[key], rel=1e-12,
    label="the cast has the same " .. key })
end
local function times(key, pressure)
  return found.honed[pressure][key] / found.cast[pressure][key]
end
local ratios = lab.notebook "ratios"
ratios:write{ lightly=times("area", 0.01), hard=times("area", 0.3),
  gap=times("gap", 0.3) / times("gap", 0.01) }
if cut >= 0.4 then
  ratios:expect("lightly", { at_least=2,
    label="lightly pressed the honed face touches on more than "
      .. "twice the area" })
  ratios:expect("hard", { at_most=1,
    label="pressed hard on less: its pits stay open" })
  ratios:expect("gap", { at_least=2,
    label="and so it is with the gaps" })
end
print()
prose([[
Honed over cast: %.2f times the area lightly, %.2f times hard; %.2f and
%.2f times the gap.]], times("area", 0.01), times("area", 0.3),
  times("gap", 0.01), times("gap", 0.3))
guess{ said=my_guess.lightly, found=times("area", 0.01),
  of="the area under 0.01 MPa, times" }
guess{ said=my_guess.hard, found=times("area", 0.3),
  of="the area under 0.3 MPa, times" }
local reason = [[
What touches lightly is the top alone. The top of the honed face is flat
and fine; that of its cast is the bottom of the pits, upside down: few,
high, steep, and the rubber hangs between them. Pressed hard the rubber
reaches down everywhere, and what counts is the bottom: flat on the
cast, on the honed face pits too narrow and deep to fill. So neither
face is the better seal, and no number of a face alone can say which is:
it hangs on the load, too.]]
if cut < 0.4 then reason = [[
Here so little was cut away that tops and bottoms are much alike, and so
are the contacts of the two, but for the few highest hills under the
lightest load.]] end
prose([[
Why: Sa, Sq and Sdr are means over all of a face, and count a deep pit
as they count a high hill. %s

The sign of Ssk tells the two apart (%.2f and %.2f), and so do Spk and
Svk, which have changed places. Even these say nothing of how hills lie
beside each other, which elastic bodies feel: so press the map itself,
not its numbers.]],
  reason, of.honed.Ssk, of.cast.Ssk)

-- Real area: how much of a face touches
-- Question: An aluminium block rests on a hard flat. On how much of its
--   face does it really touch?
-- Predict: At a mean pressure of 3 MPa (30 kg on a square centimetre),
--   what percentage touches? And with ten times the load, by how much
--   does the pressure inside the spots grow?
-- Minutes: 20
--
-- Two faces touch on some of their tops. The spots carry all the load,
-- so the mean pressure in them is the load over their area. How high is
-- it, and does it rise with the load?
--
-- Two things could limit it. Elastic tops push back the more, the
-- stiffer the body (E*) and the steeper the face (its rms slope h').
-- And no metal carries more than its **hardness**: 1.1 GPa here. So the
-- same face is pressed twice, as if it could carry any pressure and
-- with its hardness.
--
-- *Your prediction:* put its numbers into `my_guess` in the script; the
-- last lines compare them with what was found.
--
-- *Then try:* a gentler face, `slope = 0.02`: does it yield? Or another
-- of `asperity materials` with a hardness, such as "gold", "silicon" or
-- "PMMA".

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local prose = require "asperity.prose"
local MPa, um = lab.units.MPa, lab.units.um
local my_guess = { percent=nil, growth=nil }
guess.names(my_guess, "percent", "growth")
local metal = lab.material "Al-2011"
local slope = 0.1
assert(metal.hardness, "this material has no hardness: choose another,"
  .. " asperity materials lists them")
local modulus = metal.young / (1 - metal.poisson ^ 2)

-- 1. One face, twice: as if it could carry any pressure, and with its
-- hardness.
local face = lab.surface.self_affine{ cells=256, size="500 um",
  hurst=0.8, rms_slope=slope, roll_off="125 um", short_wave="16 um",
  seed=1, material=metal }
local book, law = lab.notebook "area",
  lab.friction{ tau0="300 MPa", alpha=0.1 }
-- A face that yields cannot carry its hardness all over.
local found, highest = { elastic={}, yielding={} }, 0
print("           pressure   touching    "
  .. "pressure in the spots   friction")
for _, body in ipairs{ "elastic", "yielding" } do
  for _, pressure in ipairs{ 3, 10, 30, 100, 300 } do
    if pressure * MPa > metal.hardness / 2 then break end
    local c = lab.contact{ lower=face, upper=lab.rigid,
      boundary="periodic", effects={ elasticity="half_space",
        plasticity=body == "yielding" and {} or nil } }
    local st = c:press{ pressure=pressure * MPa }
    local area = st.corrected_area_fraction
    local row = { body=body, ["pressure [Pa]"]=pressure * MPa,
      area=area, ["in the spots [Pa]"]=st.pressure / area,
      ["over hardness"]=st.pressure / area / metal.hardness,
      friction=law:on(st).mu }
    local elastic = found.elastic[pressure] or row
    row["over elastic"] =
      row["in the spots [Pa]"] / elastic["in the spots [Pa]"]
    book:write(row)
    found[body][pressure], highest = row, pressure
    local line = "%-9s  %3d MPa    %6.3f %%    %4.2f GPa%21.3f"
    print(line:format(body, pressure, 100 * area,
      st.pressure / area / 1e9, row.friction))
    if pressure == 30 and body == "yielding" then
      st:field "pressure":picture("pressure.png",
        { title="pressure in the spots, 30 MPa on the block" })
    end
  end
end
for _, pressure in ipairs{ 3, highest } do
  local theory = lab.exact.persson{ modulus=modulus, rms_slope=slope,
    pressure=pressure * MPa }
  book:write{ body="theory (Persson)", ["pressure [Pa]"]=pressure * MPa,
    area=theory.area_fraction }
end

-- 2. To look at.
book:chart{ x="pressure", y="area", one_line_per="body", log_x=true,
  log_y=true, file="area.svg", x_label="mean pressure on the block",
  y_label="share that touches", title="Real area grows with the load" }
book:chart{ x="pressure", y="in the spots", one_line_per="body",
  where={ body={ "elastic", "yielding" } }, log_x=true,
  file="in_the_spots.svg", x_label="mean pressure on the block",
  y_label="mean pressure in the spots",
  title="The pressure in the spots does not" }

-- 3. What must hold, and why. How many times the hardness would elastic
-- tops have to carry?
local elastic, yielding = found.elastic, found.yielding
local needed = elastic[3]["over hardness"]
local theory = modulus * slope / 2
local expected = 3 * MPa / math.min(theory, metal.hardness)
book:expect("area", { where={ body="yielding", pressure=3 * MPa },
  at_least=0.8 * expected, at_most=1.6 * expected,
  label="what touches: the load over about E* h'/2 or over the "
    .. "hardness, whichever is less" })
if needed >= 1.5 then
  book:expect("over hardness", { where={ body="yielding" }, near=1,
    rel=0.1, label="the spots carry the hardness, at every load" })
  book:expect("over hardness", { where={ body="elastic" }, at_least=1.5,
    label="without a hardness they would have to carry far more" })
else
  book:expect("over hardness", { where={ body="yielding" }, at_most=1.1,
    label="the spots carry no more than the hardness" })
  book:expect("over elastic", { where={ body="yielding" },
    at_least=needed < 0.8 and 0.85 or 0.6, at_most=1.05,
    label="tops that need not carry the hardness stay elastic, "
      .. "or nearly" })
end
local law_of_area =
  "they yield. So area = load / hardness: %.2f %% at 3 MPa"
local yields = law_of_area:format(100 * 3 * MPa / metal.hardness)
if needed < 0.8 then
  yields = "most stay elastic, and the hardness changes little"
elseif needed < 1.5 then
  yields = "many yield, and neither law holds alone"
end
local in_spots = yielding[3]["in the spots [Pa]"]
local rise = yielding[highest]["in the spots [Pa]"] / in_spots
if rise > 1.15 then
  local crowded = ".\n\nAt %d MPa, where %.0f %% touches, the spots"
    .. " carry %.2f times as much: the law is for small areas"
  yields = yields .. crowded:format(highest,
    100 * yielding[highest].area, rise)
end
local growth = yielding[30]["in the spots [Pa]"] / in_spots
print()
prose([[
At 3 MPa %.2f %% touches. Ten times the load multiplies the pressure in
the spots by %.2f.]], 100 * yielding[3].area, growth)
guess{ said=my_guess.percent, found=100 * yielding[3].area,
  of="the share that touches", unit="%" }
guess{ said=my_guess.growth, found=growth,
  of="the growth of the pressure" }
prose([[
Why: the pressure in the spots has next to nothing to do with the load.
Press harder, and tops that were apart begin to touch: more spots, not
fuller ones. Elastic bodies touch on k p / (E* h') of the face, with a k
between 1.6 (Persson's theory, the line in area.svg) and 2.5 (that of
Bush, Gibson and Thomas); here it is %.1f. So their spots carry E* h'/k
at any load, here %.2f GPa. That is %.1f times what the material can
(%.2f GPa): %s.

A disc of 4.3 g, the paper's, with such a face under its own weight
would touch on %.0f um^2 of its 491 mm^2. The section of one hair is
some 3000 um^2.

And that is why friction is a coefficient: it is made in the spots, they
grow in proportion to the load, and the ratio (last column) goes from
%.3f to %.3f while the load grows %.0f times. Amontons found the rule in
1699; this reason is Bowden and Tabor's.]],
  modulus * slope / elastic[3]["in the spots [Pa]"],
  elastic[3]["in the spots [Pa]"] / 1e9, needed, metal.hardness / 1e9,
  yields, 0.0043 * 9.81 / in_spots / um ^ 2, yielding[3].friction,
  yielding[highest].friction, highest / 3)

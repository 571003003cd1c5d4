-- Why real area is tiny
-- Question: An aluminium block rests on a hard flat. On how much of its face does it really touch?
-- Predict: At a mean pressure of 3 MPa (30 kg on a square centimetre), what percentage touches? And with ten
--   times the load, by how much does the pressure inside the spots grow?
-- Minutes: 20
--
-- Two faces touch on their highest tops alone. There the pressure must be enormous, for the spots are small
-- and carry all the load. How enormous, and does it rise with the load?
--
-- For elastic bodies theory and computation agree on about 2 p / (E* h') of the face, with p the mean pressure and
-- h' the rms slope: the area grows with the load, and the pressure in the spots stays near E* h' / 2. But no metal
-- carries more than its **hardness**; above it the tops are squashed until they carry the load at that pressure.
--
-- *Then try:* a gentler face, `slope = 0.02`: does it yield? Or another of `asperity materials` with a hardness.

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local MPa, um = lab.units.MPa, lab.units.um
local my_guess = { percent=nil, growth=nil }
local metal = lab.material "Al-2011"
local modulus, slope = metal.young / (1 - metal.poisson ^ 2), 0.1

-- 1. One face, twice: as if it could carry any pressure, and with its hardness.
local face = lab.surface.self_affine{ cells=256, size="500 um", hurst=0.8, rms_slope=slope, roll_off="125 um",
                                      short_wave="16 um", seed=1, material=metal }
local book, law, found = lab.notebook "area", lab.friction{ tau0="300 MPa", alpha=0.1 }, {}
print "           pressure   touching    pressure in the spots   friction"
for _, body in ipairs{ "elastic", "yielding" } do
  for _, pressure in ipairs{ 3, 10, 30, 100, 300 } do
    local c = lab.contact{ lower=face, upper=lab.rigid, boundary="periodic",
                           effects={ elasticity="half_space", plasticity=body == "yielding" and {} or nil } }
    local st = c:press{ pressure=pressure * MPa }
    local area = st.corrected_area_fraction
    local row = { body=body, ["pressure [Pa]"]=pressure * MPa, area=area, ["in the spots [Pa]"]=st.pressure / area,
                  ["over hardness"]=st.pressure / area / metal.hardness, friction=law:on(st).mu }
    book:write(row)
    if body == "yielding" then found[pressure] = row end
    print(("%-9s  %3d MPa    %6.3f %%    %4.2f GPa                %.3f"):format(body, pressure, 100 * area,
      st.pressure / area / 1e9, row.friction))
    if pressure == 30 and body == "yielding" then
      st:field "pressure":picture("pressure.png", { title="pressure in the spots, 30 MPa on the block" })
    end
  end
end
for _, pressure in ipairs{ 3, 300 } do
  local theory = lab.exact.persson{ modulus=modulus, rms_slope=slope, pressure=pressure * MPa }
  book:write{ body="theory (Persson)", ["pressure [Pa]"]=pressure * MPa, area=theory.area_fraction }
end

-- 2. To look at.
book:chart{ x="pressure", y="area", one_line_per="body", log_x=true, log_y=true, file="area.svg",
            x_label="mean pressure on the block", y_label="share that touches", title="Real area grows with the load" }
book:chart{ x="pressure", y="in the spots", one_line_per="body", where={ body={ "elastic", "yielding" } }, log_x=true,
            file="in_the_spots.svg", x_label="mean pressure on the block", y_label="mean pressure in the spots",
            title="The pressure in the spots does not" }

-- 3. What must hold, and why.
book:expect("over hardness", { where={ body="yielding" }, near=1, rel=0.1,
                               label="the spots carry the hardness, at every load" })
book:expect("over hardness", { where={ body="elastic" }, at_least=1.5,
                               label="without a hardness they would have to carry far more" })
book:expect("area", { where={ body="yielding", pressure=3 * MPa }, at_most=0.01, label="under one per cent touches" })
local own_weight = 0.0043 * 9.81 / metal.hardness -- m^2, of a disc of 4.3 g
print(([[

You said %s %% at 3 MPa: it is %.2f %%. You said %s times the pressure in the spots at ten times the load: it is
%.2f.
Why: the pressure in the spots has nothing to do with the load. Press harder, and tops that were apart begin to
touch: more spots, not fuller ones. So area = load / hardness: %.2f %% here, where elastic tops would have to
carry three times what the metal can. The paper's disc of 4.3 g under its own weight touches on %.0f um^2 of its
491 mm^2: less than the section of a hair.
And that is why friction is a coefficient: it is made in the spots, they grow in proportion to the load, and the
ratio (last column) hardly changes. Amontons found the rule in 1699; this reason is
Bowden and Tabor's.]]):format(
  my_guess.percent or "nothing", 100 * found[3].area, my_guess.growth or "nothing",
  found[30]["in the spots [Pa]"] / found[3]["in the spots [Pa]"], 100 * 3 * MPa / metal.hardness, own_weight / um ^ 2))

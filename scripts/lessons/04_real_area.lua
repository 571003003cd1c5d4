-- Real area: how much of a face touches
-- Question: An aluminium block rests on a hard flat. On how much of its
--   face does it really touch?
-- Predict: At a mean pressure of 3 MPa (30 kg on a square centimetre),
--   which percentage touches? And with ten times the load, by which
--   factor (growth) does the pressure inside the spots grow?
-- Minutes: 20
--
-- Two faces touch on some of their tops, and these spots carry all the
-- load. Elastic tops push back more on a stiffer body (E*) and on a
-- steeper face (rms slope h'), but no metal carries more than its
-- **hardness**, here 1.1 GPa. We press one face as if it could carry
-- any pressure, and then with its hardness.
--
-- *Then try:* the knob `slope`: does a gentler face yield? Or another
-- of `asperity materials` with a hardness, such as "gold", "silicon" or
-- "PMMA".

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local prose = require "asperity.prose"
local my_guess = { percent=nil, growth=nil }
guess.names(my_guess, "percent", "growth")
local slope = lab.knob{ name="slope", from=0.02, to=0.15, value=0.1 }
local metal = lab.material "Al-2011"
local modulus = metal.young / (1 - metal.poisson ^ 2)
local H = assert(metal.hardness, "choose a material with a hardness")

-- 1. One face, elastic and yielding, up to half the hardness.
local face = lab.surface.self_affine{ cells=256, size=500e-6, hurst=0.8,
  rms_slope=slope, roll_off=125e-6, short_wave=16e-6, material=metal }
local law = lab.friction{ tau0="300 MPa", alpha=0.1 }
local book = lab.notebook("area", { units={ pressure="MPa", area="%",
  in_spots="GPa" } })
for body, cap in pairs{ elastic=math.huge, yielding=H } do
  for _, pressure in ipairs{ 3e6, 10e6, 30e6, 100e6, 300e6 } do
    if pressure > H / 2 then break end
    local st = lab.contact{ lower=face, upper=lab.rigid,
      boundary="periodic", effects={ elasticity="half_space",
        plasticity={ hardness=cap } } }:press{ pressure=pressure }
    local area = st.corrected_area_fraction
    book:write{ body=body, pressure=pressure, area=area,
      in_spots=pressure / area, mu=law:on(st).mu }
    if body == "yielding" and pressure == 30e6 then
      st:field "pressure":picture("pressure.png", { title="30 MPa" })
    end
  end
end
local highest = book:max "pressure"
book:show{ "body", "pressure", "area", "in_spots", "mu", digits=5 }
for _, p in ipairs{ 3e6, highest } do
  book:write{ body="Persson", pressure=p, area=lab.exact.persson{
    modulus=modulus, rms_slope=slope, pressure=p }.area_fraction }
end

-- 2. Charts.
book:chart{ x="pressure", y="area", one_line_per="body", log_x=true,
  log_y=true, title="Real area grows with the load", file="area.svg" }
book:chart{ x="pressure", y="in_spots", one_line_per="body", log_x=true,
  title="The pressure in spots does not", file="in_the_spots.svg" }

-- 3. Expectations, and the reason.
local function at(body, pressure)
  return book:where{ body=body, pressure=pressure }[1]
end
local needed, first = at("elastic", 3e6).in_spots, at("yielding", 3e6)
local growth = at("yielding", 30e6).in_spots / first.in_spots
local expected = 3e6 / math.min(modulus * slope / 2, H)
book:expect("area", { where={ body="yielding", pressure=3e6 },
  at_least=0.8 * expected, at_most=1.6 * expected,
  label="the load over E* h'/2 or the hardness, whichever is less" })
book:expect("in_spots", { where={ body="yielding" },
  at_least=needed < 0.8 * H and 0.85 * needed
    or math.min(0.9 * H, 0.6 * needed), at_most=1.1 * H,
  label="the spots carry the hardness, or less if less is needed" })
book:expect("in_spots", { where={ body="elastic" },
  at_least=math.min(1.5 * H, 0.8 * needed),
  label="without a hardness they would carry far more" })
lab.say("At 3 MPa %.2f [%] touches. Ten times the load multiplies the \z
  pressure in the spots by %.2f.", first.area, growth)
guess{ said=my_guess.percent, name="percent", unit="%", near=0.3,
  found=100 * first.area, of="the share that touches" }
guess{ said=my_guess.growth, name="growth", found=growth, near=0.1,
  of="the growth" }
prose([[
Why: a higher load makes more spots, not fuller ones. Elastic bodies
touch on k p / (E* h') of the face, with k between 1.6 (Persson's
theory, in area.svg) and 2.5 (that of Bush, Gibson and Thomas); here it
is %.1f. Their spots carry E* h'/k at any load, here %.2f GPa, or %.1f
times the hardness (%.2f GPa). If this factor is far above 1, the tops
yield, and area = load / hardness: %.2f %% at 3 MPa. If it is far below
1, they stay elastic.

A disc of 4.3 g, as in the paper, touches with such a face under its own
weight on %.0f um^2 of 491 mm^2. A hair's section is about 3000 um^2.

And that is why friction is a coefficient (Amontons, 1699): the spots
grow with the load. Friction over load goes from %.3f to %.3f, while the
load grows %.0f times. The reason is Bowden and Tabor's.]],
  modulus * slope / needed, needed / 1e9, needed / H, H / 1e9,
  100 * 3e6 / H, 0.0043 * 9.81 / first.in_spots * 1e12, first.mu,
  at("yielding", highest).mu, highest / 3e6)

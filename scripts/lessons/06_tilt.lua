-- Tilt it
-- Question: You tilt a plate until the block on it slides. Which block
--   holds on longer: a rough one or a smooth one? A light one or a
--   heavy one?
-- Predict: The rough block slides at about 10 degrees. Does it slide
--   at a smaller, the same or a larger angle if all its heights are
--   halved? And the rough block under thirty times the load (heavy)?
-- Minutes: 15
--
-- Friction acts where the faces really touch. A junction of area A
-- resists with tau0 A + alpha F: a part proportional to the area, and
-- a part proportional to the load F. A plate tilted by theta divides
-- the weight W: W cos theta presses the block on, W sin theta pulls it
-- down. The block slides at tan theta = mu = alpha + tau0 A/F.
--
-- Roughness and load enter through A/F only, the real area over the
-- load. Lesson 4 explains this area. tau0 is an input of this lesson,
-- so trust the ratios of the angles more than their degrees.
--
-- *Then try:* the knob `alpha`, from 0 on. Which part of friction is
-- left at 0, and which property of the block does it depend on?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local my_guess = { halved=nil, heavy=nil } -- angle of each block
guess.names(my_guess, "halved", "heavy")
guess.choices(my_guess, "smaller", "same", "larger")
local law = lab.friction{ tau0="300 MPa",
  alpha=lab.knob{ name="alpha", from=0, to=0.3, value=0.1 } }
local rough = lab.surface.self_affine{ cells=256, size="500 um",
  hurst=0.8, rms_slope=0.2, roll_off="125 um", short_wave="16 um",
  material=lab.material "Al-2011" }
-- The block on quartz, all its heights multiplied by `height`.
local function pair(height, plasticity)
  return lab.contact{ lower=height * rough, upper=lab.material "quartz",
    boundary="periodic",
    effects={ elasticity="half_space", plasticity=plasticity } }
end

-- 1. The load: the block and its half-high twin under 3 to 100 MPa.
local loads = lab.notebook "loads"
for _, height in ipairs{ 1, 0.5 } do
  for _, MPa in ipairs{ 3, 10, 30, 100 } do
    local st = pair(height):press{ pressure=MPa .. " MPa" }
    loads:write{ height=height, ["pressure [MPa]"]=MPa,
      ["angle [deg]"]=math.deg(math.atan(law:on(st).mu)) }
  end
end
loads:show{ "height", "pressure [MPa]", "angle [deg]", digits=3 }

-- 2. The roughness: six heights on the tilt stage, with elastic tops
-- and with tops that yield. Under 4.3 g alone less than one cell would
-- touch. So the stage presses with 1 to 3 MPa, where A/F is the same.
local function tilt(height, plasticity)
  return lab.tilt_stage{ contact=pair(height, plasticity), friction=law,
    mass="4.3 g", specimen_area="490.87 mm^2" }:raise{ repeats=1 }
end
local angles = lab.notebook("angles", { columns={ "height", "slope",
  "elastic [deg]", "A/F x slope [1/GPa]", "yielding [deg]" } })
for _, height in ipairs{ 1, 0.7, 0.5, 0.35, 0.25, 0.125 } do
  local slope = (height * rough):roughness().rms_slope
  local elastic = tilt(height)
  angles:write{ height=height, slope=slope, elastic=elastic.angle,
    yielding=tilt(height, {}).angle,
    ["A/F x slope"]=elastic.area_per_load * slope }
end
angles:show{ digits=3 }
angles:chart{ x="slope", y={ "elastic", "yielding" }, log_x=true,
  y_label="angle", file="angles.svg",
  title="The smoother, the steeper" }
loads:chart{ x="pressure", y="angle", one_line_per="height", log_x=true,
  file="loads.svg", title="Load hardly matters" }

-- 3. Expectations, and the reason.
local whole = loads:where{ height=1 }
local yields = math.atan(law.alpha + law.tau0 / rough.material.hardness)
angles:expect("elastic", { decreasing_in="slope", label="rough first" })
angles:expect("A/F x slope", { near=angles:max "A/F x slope", rel=0.1,
  label="real area is proportional to one over slope" })
whole:expect("angle", { near=whole:sum "angle" / 4, rel=0.1,
  label="thirty times the load: the same angle, to a tenth" })
angles:expect("yielding", { where={ height={ 1, 0.7, 0.5 } }, rel=0.1,
  near=yields, label="tops that yield: roughness does not matter" })
local function change(ratio)
  return ratio > 1.1 and "larger" or ratio < 0.9 and "smaller" or "same"
end
guess{ said=my_guess.halved, name="halved", of="half the height",
  found=change(angles:where{ height=0.5 }[1].elastic
    / angles:where{ height=1 }[1].elastic), replies={
    smaller="Rough faces interlock, but the quartz is flat.",
    same="The load is the same, but the real area is not." } }
guess{ said=my_guess.heavy, name="heavy", of="the heavy load",
  found=change(whole:where{ ["pressure [MPa]"]=100 }[1].angle
    / whole:where{ ["pressure [MPa]"]=3 }[1].angle), replies={
    smaller="The weight pulls it down, but also presses it on.",
    larger="The weight presses it on, but also pulls it down." } }
require "asperity.prose"([[Why: half the height is half the slope. The
same load then needs twice the real area, so tau0 A/F doubles: smooth
blocks slide *later*. More load makes more area in proportion and
cancels. Tops that yield at the hardness H have the area F/H at any
slope, and mu = alpha + tau0/H: %.1f degrees.]], math.deg(yields))

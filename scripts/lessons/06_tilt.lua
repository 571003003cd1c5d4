-- Tilt it
-- Question: A block lies on a plate that is tilted until the block
--   slides. Which block holds on longer: a rough one or a smooth one? A
--   light one or a heavy one?
-- Predict: The rough block slides at about 10 degrees. The same face
--   with all heights halved: at about 5, 10 or 14 degrees? And the
--   rough block under thirty times the load?
-- Minutes: 15
--
-- Friction is made where faces really touch. A junction of area A
-- resists with tau0 A + alpha F: some strength of its own, and some
-- that grows with what presses on it. On a plate tilted by theta the
-- weight W presses with W cos theta and pulls with W sin theta, so it
-- slides where tan theta = mu = alpha + tau0 A/F.
--
-- Nothing else enters. So the question is what roughness and load do to
-- A/F, real area over load. You know that from lesson 4.
--
-- *Your prediction:* put its numbers into `my_guess` in the script; the
-- last lines compare them with what was found.
--
-- *Then try:* `alpha = 0`. Which part of friction is left, and what
-- does it go with?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local prose = require "asperity.prose"
local MPa, deg = lab.units.MPa, lab.units.deg
local my_guess = { halved=nil, heavy=nil } -- in degrees
guess.names(my_guess, "halved", "heavy")
local alpha = 0.1
local law = lab.friction{ tau0="300 MPa", alpha=alpha }
local aluminium, quartz = lab.material "Al-2011", lab.material "quartz"
local rough = lab.surface.self_affine{ cells=256, size="500 um",
  hurst=0.8, rms_slope=0.2, roll_off="125 um", short_wave="16 um",
  seed=1, material=aluminium }
local function on_quartz(surface, yields)
  return lab.contact{ lower=surface, upper=quartz, boundary="periodic",
    effects={ elasticity="half_space",
      plasticity=yields and {} or nil } }
end

-- 1. The load: what do the rough block and its half-high twin do under
-- 3 to 100 MPa?
local loads, under = lab.notebook "loads", {}
local halved = rough:scaled{ rms=0.5 * rough:roughness().Rq }
print "pressed by   rough slides at   half as high at"
for _, pressure in ipairs{ 3, 10, 30, 100 } do
  local function angle(block)
    local st = on_quartz(block):press{ pressure=pressure * MPa }
    return math.atan(law:on(st).mu) / deg
  end
  under[pressure] = angle(rough)
  loads:write{ block="rough", ["pressure [Pa]"]=pressure * MPa,
    angle=under[pressure] }
  loads:write{ block="half as high", ["pressure [Pa]"]=pressure * MPa,
    angle=angle(halved) }
  print(("%3d MPa      %.1f degrees      %.1f degrees"):format(pressure,
    under[pressure], angle(halved)))
end

-- 2. The roughness: heights of the same face times 1, 0.7, 0.5 ..., on
-- the tilt stage.
local book, found = lab.notebook "angles", {}
print "\nheights   rms slope   elastic    A/F x slope   yielding"
for _, height in ipairs{ 1, 0.7, 0.5, 0.35, 0.25, 0.125 } do
  local block = rough:scaled{ rms=height * rough:roughness().Rq }
  local angle = {}
  local slope = block:roughness().rms_slope
  for _, body in ipairs{ "elastic", "yielding" } do
    local contact = on_quartz(block, body == "yielding")
    local stage = lab.tilt_stage{ contact=contact, friction=law,
      mass="4.3 g", specimen_area="490.87 mm^2" }
    local t = stage:raise{ repeats=1 }
    angle[body] = t.angle / deg
    local times_slope = t.area_per_load * slope * 1e9 -- in 1/GPa
    if body == "elastic" then angle.times_slope = times_slope end
    book:write{ body=body, height=height, slope=slope,
      angle=angle[body], ["area over load [1/Pa]"]=t.area_per_load,
      ["times slope"]=times_slope }
  end
  found[height] = angle
  local line = "%.3f     %.3f       %4.1f deg   %.4f /GPa   %4.1f deg"
  print(line:format(height, slope, angle.elastic, angle.times_slope,
    angle.yielding))
end
book:chart{ x="slope", y="angle", one_line_per="body", log_x=true,
  file="angles.svg", x_label="rms slope of the block",
  y_label="slides at (degrees)", title="The smoother, the steeper" }
loads:chart{ x="pressure", y="angle", one_line_per="block", log_x=true,
  file="loads.svg", y_label="slides at (degrees)",
  title="Load hardly matters" }

-- 3. What must hold, and why.
local yielding = math.atan(alpha + law.tau0 / aluminium.hardness) / deg
local middle = found[0.35].times_slope
book:expect("angle", { where={ body="elastic" }, decreasing_in="slope",
  label="the rougher, the earlier it slides" })
book:expect("times slope", { where={ body="elastic" }, near=middle,
  rel=0.1, label="real area goes with one over slope" })
loads:expect("angle", { where={ block="rough" },
  near=under[30], rel=0.1,
  label="thirty times the load slides at the same angle, to a tenth" })
book:expect("angle", { near=yielding, rel=0.1,
  where={ body="yielding", height={ 1, 0.7, 0.5 } },
  label="tops that yield: roughness does not matter" })
print()
prose([[
With half the height it slides at %.1f degrees; under the heavy load at
%.1f (at 3 MPa %.1f).]], found[0.5].elastic, under[100], under[3])
guess{ said=my_guess.halved, found=found[0.5].elastic,
  of="half the height", unit="deg", near=0.1 }
guess{ said=my_guess.heavy, found=under[100], of="the heavy load",
  unit="deg", near=0.1 }
prose([[
Why: half the height is half the slope, so twice the real area for the
same load, and twice the tau0 A/F. Smooth blocks hold on *longer*. More
load brings more area in proportion, so it cancels. Roughness acts on
tau0 A/F alone: with alpha = 0 nothing else is left, and tan theta goes
with real area, so with one over slope.

The second column of angles lets the tops yield at the hardness H: then
A = F/H whatever the roughness, and rough blocks all slide at the angle
of alpha + tau0/H, %.1f degrees. Only where the face is so smooth that
its tops stay elastic do the two agree. So turning (lesson 5) can only
help where tops touch the quartz elastically.

One thing was put in, not found: tau0. Ratios are predictions here,
degrees are not. And the stage solves at 1 to 3 MPa, since under 4.3 g
alone less than one cell would touch: that the load cancels is what
allows it.]],
  yielding)

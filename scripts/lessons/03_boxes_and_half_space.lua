-- Boxes against the half-space
-- Question: Does a hill know that its neighbour is being pressed?
-- Predict: Two hills, one 0.2 um lower. A flat comes down on them. When
--   it meets the low hill, is it less than 0.2 um below the top of the
--   high hill, exactly 0.2 um (equal), or more?
-- Minutes: 15
--
-- The simplest model of a rough body is a brush of springs: each point
-- is a **box**, which only its own load pushes down. The source paper
-- uses boxes. A real body is one piece, an elastic **half-space**: a
-- force at one place can move the whole surface.
--
-- *Then try:* the knob `R`, the radius of the hills, or `lower =
-- 0.1e-6`. Which column changes?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local prose = require "asperity.prose"
local my_guess = nil -- than 0.2 um, for hills 20 um apart
guess.choices(my_guess, "less", "equal", "more")
local R = lab.knob{ name="R", from="30 um", to="150 um", value=100e-6 }
local lower = 0.2e-6 -- m below the high hill
local metal = lab.material{ young="70 GPa", poisson=0.33 }

-- 1. Two hills at a distance. How deep is the flat when it meets the
-- low one? The interval of this depth is halved again and again.
local book = lab.notebook("hills", { units={ distance="um", box="um",
  half_space="um", theory="um" } })
for _, distance in ipairs{ 60e-6, 40e-6, 30e-6, 20e-6 } do
  local hills = lab.surface.from_function{ cells=128, size="100 um",
    material=metal, height=function(x, y)
      local high = (x - 50e-6 + distance / 2) ^ 2
      local low = (x - 50e-6 - distance / 2) ^ 2 + 2 * R * lower
      return -(math.min(high, low) + (y - 50e-6) ^ 2) / (2 * R)
    end }
  local row = { distance=distance }
  for _, model in ipairs{ "box", "half_space" } do
    local c <close> = lab.contact{ lower=hills, upper=lab.rigid,
      boundary="free", effects={ elasticity=model } }
    local shallow, deep = 0, 2 * lower
    while deep - shallow > 0.5e-9 do
      local middle = (shallow + deep) / 2
      local both = c:press{ approach=middle }.spots > 1
      if both then deep = middle else shallow = middle end
    end
    row[model] = deep
  end
  -- Boussinesq: F/(pi E* d) at the distance d. Hertz: F = 4/3 E* R^0.5
  -- depth^1.5.
  row.theory = lower
    + 4 / 3 * R ^ 0.5 * row.half_space ^ 1.5 / (math.pi * distance)
  row.ratio = row.half_space / row.theory
  book:write(row)
end
book:show{ "distance", "box", "half_space", "theory", digits=3 }
book:chart{ x="distance", y={ "half_space", "theory", "box" },
  y_label="depth", title="Depth at which the low hill is met",
  file="hills.svg" }

-- 2. A rough face under both models, at the same real area. The boxes
-- touch on everything above one height, which `bearing` finds.
local face = lab.surface.self_affine{ cells=256, size=200e-6, hurst=0.8,
  ra="0.2 um", roll_off="100 um", short_wave="6 um", material=metal }
local half = lab.contact{ lower=face, upper=lab.rigid,
  boundary="periodic", effects={ elasticity="half_space" } }
local brush = lab.contact{ lower=face, upper=lab.rigid,
  boundary="periodic", effects={ elasticity="box" } }
local spots = lab.notebook "spots"
for _, pressure in ipairs{ 1e7, 3e7, 1e8, 3e8 } do
  local st = half:press{ pressure=pressure }
  local boxes = brush:press{ approach=face:roughness().peak
    - face:bearing():height(st.area_fraction) }
  spots:write{ area=st.area_fraction, half_space=st.spots,
    box=boxes.spots, ratio=st.spots / boxes.spots }
  if pressure == 1e8 then
    st:field "contact":picture("half_space.png", { title="half-space" })
    boxes:field "contact":picture("boxes.png", { title="boxes" })
  end
end
spots:show{ "area [%]", "half_space", "box", digits=3 }
spots:chart{ x="area", y={ "half_space", "box" }, log_x=true,
  y_label="spots", title="Spots on the same area", file="spots.svg" }

-- 3. Expectations, and the reason. A top between nodes is lower.
book:expect("box", { near=lower, label="a box ignores its neighbours",
  within=1e-9 + (100e-6 / 128) ^ 2 / (8 * R) })
book:expect("half_space", { decreasing_in="distance" })
book:expect("ratio", { near=1, within=0.01, label="by F/(pi E* d)" })
spots:expect("ratio", { at_least=1.5, label="more pieces" })
local depth = 1e6 * book:max "half_space"
lab.say("Hills 20 um apart: boxes meet the low one at %.3f [um], \z
  the half-space at %.3f um.", book:max "box", depth)
local beyond = book:max "half_space" / book:max "box" - 1
guess{ said=my_guess, of="the depth", found=beyond > 0.01 and "more"
    or beyond < -0.01 and "less" or "equal", replies={
    less="Nothing bulges: a load lowers the surface around it.",
    equal="So it is with boxes, and with springs." } }
prose([[
Why: the high hill pulls the surface around it down, by F/(pi E* d) at a
distance d; boxes cannot. On a rough face the load then moves to tops
further off: the same area has more and smaller pieces (half_space.png).

Boxes are exact if only the order of heights counts. Spots, gaps and
stiffness depend on neighbours: use the half-space.]])

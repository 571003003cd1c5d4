-- Boxes against the half-space
-- Question: Does a hill know that its neighbour is being pressed?
-- Predict: Two hills, one 0.2 um lower. A flat comes down on them. How
--   far below the top of the high hill is it when it meets the low one:
--   less than 0.2 um, exactly 0.2 um, or more?
-- Minutes: 15
--
-- The simplest model of a rough body is a brush of springs: every point
-- is a **box** that is pushed down by what lies on it, and by nothing
-- else. The source paper uses it. A real body is one piece: the elastic
-- **half-space**, a body so large that it has one face and no other
-- end, on which a force at one place may move the ground at every
-- other.
--
-- First two hills, then a rough face. Boxes need a stiffness, which
-- somebody has to choose; so on the rough face both models are compared
-- at equal real area, where it does not matter.
--
-- *Your prediction:* put its number into `my_guess` in the script; the
-- last lines compare it with what was found.
--
-- *Then try:* hills of another radius `R`, from 30 to 300 um, or `lower
-- = 0.1 * um`. Which column changes?

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local guess = require "asperity.guess"
local prose = require "asperity.prose"
local um, MPa = lab.units.um, lab.units.MPa
local my_guess = nil -- in um, of hills 20 um apart
local metal = lab.material{ young="70 GPa", poisson=0.33 }
local modulus = 70e9 / (1 - 0.33 ^ 2)

-- 1. Two hills at a distance; how deep is the flat when the low one is
-- first touched?
local R = 100 * um
local lower = 0.2 * um
local size, cells = 100 * um, 128
local function hills(distance)
  local middle = size / 2
  local function hill(x, y)
    return -((x - middle) ^ 2 + (y - middle) ^ 2) / (2 * R)
  end
  local function height(x, y)
    return math.max(hill(x + distance / 2, y),
      hill(x - distance / 2, y) - lower)
  end
  return lab.surface.from_function{ cells=cells, size=size,
    material=metal, height=height }
end
local function depth_of_second(distance, elasticity)
  local c <close> = lab.contact{ lower=hills(distance), upper=lab.rigid,
    boundary="free", effects={ elasticity=elasticity } }
  -- The ground is the low hill's from a line on that is lower R/d
  -- beyond the middle.
  local line = cells // 2
    + math.ceil(lower * R / distance / (size / cells))
  local shallow, deep = 0, 2 * lower
  -- Halve the interval in which the second hill is met.
  while deep - shallow > 0.0005 * um do
    local middle = (shallow + deep) / 2
    local pressures = c:press{ approach=middle }:field "pressure"
    local met = false
    for i = line, cells - 1 do
      met = met or pressures:value(i, cells // 2) > 0
    end
    if met then deep = middle else shallow = middle end
  end
  return deep
end
local book, found, of_boxes = lab.notebook "hills", {}, {}
local head = "distance   boxes     half-space   %.1f um + F/(pi E* d)"
print(head:format(lower / um))
for _, distance in ipairs{ 60, 40, 30, 20 } do
  local d = distance * um
  local box = { model="box", stiffness="80 GPa/um" }
  local boxes = depth_of_second(d, box)
  local half = depth_of_second(d, "half_space")
  local force = lab.exact.hertz{ radius=R, modulus=modulus,
    approach=half }.load
  local theory = lower + force / (math.pi * modulus * d)
  found[distance], of_boxes[distance] = half, boxes
  book:write{ ["distance [m]"]=d, ["boxes [m]"]=boxes,
    ["half-space [m]"]=half, ["theory [m]"]=theory,
    ["half/theory"]=half / theory, ["more than boxes"]=half / boxes }
  print(("%3d um     %.3f um  %.3f um     %.3f um"):format(distance,
    boxes / um, half / um, theory / um))
end
book:chart{ x="distance", y={ "half-space", "theory", "boxes" },
  file="hills.svg", x_label="distance of the hills",
  y_label="depth at which the low hill is met",
  title="A hill feels its neighbour" }

-- 2. A rough face at the same real area under both models: in how many
-- spots?
local face = lab.surface.self_affine{ cells=256, size="200 um",
  hurst=0.8, ra="0.2 um", roll_off="100 um", short_wave="6 um", seed=1,
  material=metal }
local function bench(elasticity)
  return lab.contact{ lower=face, upper=lab.rigid, boundary="periodic",
    effects={ elasticity=elasticity } }
end
local half, brush = bench "half_space", bench "box"
local spots = lab.notebook "spots"
print "\ntouching   spots, half-space   spots, boxes"
for _, pressure in ipairs{ 10, 30, 100, 300 } do
  local st = half:press{ pressure=pressure * MPa }
  local low, high = 1e3, 1e12
  -- The load under which the boxes touch on as many nodes.
  while high / low > 1.0001 do
    local middle = math.sqrt(low * high)
    local contacts = brush:press{ pressure=middle }.contacts
    if contacts < st.contacts then low = middle else high = middle end
  end
  local on_boxes = brush:press{ pressure=high }
  spots:write{ area=st.area_fraction, ["half-space"]=st.spots,
    boxes=on_boxes.spots, ratio=st.spots / on_boxes.spots }
  print(("%5.1f %%    %2d                  %2d"):format(
    100 * st.area_fraction, st.spots, on_boxes.spots))
  if pressure == 100 then
    st:field "contact":picture("half_space.png",
      { title="half-space: where it touches" })
    on_boxes:field "contact":picture("boxes.png",
      { title="boxes: where they touch, on the same area" })
  end
end
spots:chart{ x="area", y={ "half-space", "boxes" }, log_x=true,
  file="spots.svg", title="The same area in pieces",
  x_label="share of the face that touches", y_label="number of spots" }

-- 3. What must hold, and why.
-- So much lower a top may be that lies between nodes.
local between_nodes = (size / cells) ^ 2 / (8 * R)
book:expect("boxes", { near=lower, within=0.001 * um + between_nodes,
  label="a box does not know its neighbours" })
book:expect("half-space", { decreasing_in="distance",
  label="the nearer the hills, the later the low one is met" })
book:expect("half/theory", { near=1, within=0.01,
  label="by F/(pi E* d), as Boussinesq says" })
spots:expect("ratio", { at_least=1.5,
  label="the half-space touches in more pieces" })
print()
prose([[
Of hills 20 um apart boxes meet the low one at %.3f um, the half-space
at %.3f um.]], of_boxes[20] / um, found[20] / um)
guess{ said=my_guess, found=found[20] / um, of="the depth", unit="um" }
prose([[
Why: the high hill is pressed into the body and drags the ground around
it down, the low hill with it, by F/(pi E* d) at a distance d. Boxes
cannot do that. On a rough face it is the same a thousand times over:
ground near a loaded top sinks away from the flat, so the load goes to
tops further off, and the same area comes in more and smaller pieces.
Boxes touch on everything above one height: few large islands. Compare
half_space.png with boxes.png.

Boxes are exact and quick, and good where only the order of heights
counts; what depends on neighbours (spots, gaps, stiffness) is for the
half-space.]])

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Guards against a change that loses an answer: numbers of every kind of contact, control and reader, each with the
-- transforms it took. A number may move by 1e-4 of its value, and may take at most twice the transforms.
-- numbers.sh compares them with numbers.csv.
local lab = require "asperity"
local S = lab.surface
local soft = lab.material{ young="1 GPa", poisson=0.3, hardness="20 MPa" }
local firm = lab.material{ young="2 GPa", poisson=0.3, hardness="30 MPa" }
local al = lab.material "Al-2011"
local found = {}
local function keep(name, value, transforms)
  found[#found + 1] = { name=name, value=value, transforms=math.ceil(transforms or 0) }
end

-- Presses: both boundaries, every effect, all five controls
local function ground(cells, seed, material)
  return S.self_affine{ cells=cells, size="1 mm", hurst=0.8, ra="1 um", short_wave="60 um", seed=seed, material=material or soft }
end
local rough, other, dome = ground(64, 1), ground(64, 2, firm), S.sphere{ cells=60, size="1 mm", radius="2 mm", material=soft }
local function contact(lower, upper, boundary, effects, accuracy)
  effects.elasticity = effects.elasticity or "half_space"
  return lab.contact{ lower=lower, upper=upper or lab.rigid, boundary=boundary, effects=effects, accuracy=accuracy }
end
local function press(name, c, by, fields)
  local st = c:press(by)
  for _, field in ipairs(fields) do keep(name .. " " .. field, st[field], st.cost.transforms) end
  return st
end
for _, boundary in ipairs{ "periodic", "free" } do
  local function kind(effects) return contact(rough, nil, boundary, effects) end
  press(boundary .. " elastic", kind{}, { pressure="2 MPa" }, { "area_fraction", "corrected_area_fraction", "approach", "stiffness" })
  press(boundary .. " capped", kind{ plasticity={} }, { pressure="10 MPa" }, { "area_fraction", "plastic_volume" })
  press(boundary .. " hardening", kind{ plasticity={ hardening="500 GPa/m" } }, { pressure="10 MPa" }, { "area_fraction", "peak_pressure" })
  press(boundary .. " rough on rough", contact(rough, other, boundary, { plasticity={} }), { pressure="5 MPa" }, { "area_fraction", "approach" })
  press(boundary .. " by load", kind{}, { load="1 N" }, { "approach" })
  press(boundary .. " by approach", kind{}, { approach="1.5 um" }, { "pressure" })
  press(boundary .. " by indentation", kind{}, { indentation=0.01 }, { "pressure" })
  press(boundary .. " by flattening", kind{}, { flatten=0.1 }, { "pressure" })
end
press("free sphere", contact(dome, nil, "free", {}), { load="1 N" }, { "area", "peak_pressure" })
press("odd sides", contact(ground({ 61, 45 }, 3), nil, "periodic", {}), { pressure="2 MPa" }, { "area_fraction", "approach" })
press("single precision", contact(rough, nil, "periodic", {}, { precision="single", tolerance=1e-5 }), { pressure="2 MPa" }, { "area_fraction" })
press("requested accuracy", contact(rough, nil, "periodic", {}, { error=0.05 }), { pressure="2 MPa" }, { "corrected_area_fraction" })
press("layer", contact(rough, nil, "periodic", { elasticity={ model="layer", thickness="0.1 mm" } }), { pressure="2 MPa" }, { "area_fraction", "approach" })
press("boxes", contact(rough, other, "periodic", { elasticity="box", plasticity={} }), { pressure="5 MPa" }, { "area_fraction", "energy", "stiffness" })
press("creep", contact(rough, nil, "periodic", { plasticity={}, creep={ rate=0.1, onset="1 s" } }), { pressure="10 MPa", dwell="100 s" }, { "area_fraction" })
local unit = lab.material{ young="1 Pa", poisson=0 }
local ball = S.sphere{ cells=32, size=1, radius=1, shape="paraboloid", material=unit }
press("adhesion", contact(ball, nil, "free", { adhesion={ work=0.01, range=0.05 } }, { tolerance=1e-4 }), { load=-0.03 }, { "area", "approach" })

-- Events: place, turn, release; worn faces
local pair = contact(rough, other, "periodic", { plasticity={} })
for event = 1, 3 do
  pair:place{ seed=event }
  press("event " .. event, pair, { pressure="8 MPa" }, { "plastic_fraction" })
  pair:release()
end
keep("worn Ra", pair:lower():roughness().Ra)

-- Friction
local wm = S.weierstrass_mandelbrot{ cells=96, D=2.4, seed=7, material=al }
local stage = contact(ground(64, 4, al), ground(64, 5, firm), "periodic", { plasticity={} })
local law = lab.friction{ tau0="500 MPa", alpha=0.2 }
local st = stage:press{ pressure="20 MPa" }
keep("friction coefficient", law:on(st).mu)
keep("tilt angle", lab.tilt_stage{ contact=stage, friction=law, mass="4.3 g" }:raise{ repeats=2, seed=5 }.angle)

-- Metrology
local q, d = rough:roughness(), wm:fractal_dimension{ method="structure" }
for _, field in ipairs{ "Ra", "Rq", "skewness", "rms_slope" } do keep("rough " .. field, q[field]) end
keep("fractal dimension", d.D)
keep("stylus Ra", lab.stylus{ tip="2 um", spacing="1 um", length="0.4 mm" }:scan(rough, { count=2, seed=2 })[1]:roughness().Ra)

-- Tables, fits, budgets and logs
local rows = {}
for k = 1, 12 do rows[k] = { x=k, y=2 * k + 0.1 * math.sin(k * k) } end
local fit = lab.table.from(rows):fit{ x="x", y="y", model=function(q, row) return q.a * row.x + q.b end, start={ a=1, b=0 } }
keep("fit a", fit.values.a)
keep("fit standard error", fit.parameters.a.u)

-- The recording of the examples
local here = arg[0]:match "^(.*)/" or "."
local log = lab.protocol.read(here .. "/../../examples/data/press_recording.csv",
  { events="detect", area="490.87 mm^2", turn_step="90 deg" })
local presses, sum = 0, 0
for event in log:on(contact(rough, nil, "periodic", {})) do
  if event.kind == "press" then presses, sum = presses + 1, sum + event.pressure end
end
keep("presses of a recording", presses)
keep("their pressures", sum)
local given = ...
if given == "write" then
  print "name,value,transforms"
  for _, row in ipairs(found) do print(("%s,%.17g,%d"):format(row.name, row.value, row.transforms)) end
  return
end
local wrong = 0
local expected = {}
for _, row in ipairs(lab.table.read(given):rows()) do expected[row.name] = row end
for _, row in ipairs(found) do
  local was = expected[row.name]
  if not was then
    print(row.name .. " is new; write the table anew") wrong = wrong + 1
  elseif not (math.abs(row.value - was.value) <= 1e-4 * math.abs(was.value)) then
    print(("%s is %.9g; it was %.9g"):format(row.name, row.value, was.value)) wrong = wrong + 1
  elseif row.transforms > 2 * was.transforms then
    print(("%s takes %d transforms; it took %d"):format(row.name, row.transforms, was.transforms)) wrong = wrong + 1
  end
  expected[row.name] = nil
end
for name in pairs(expected) do print(name .. " is missing") wrong = wrong + 1 end
assert(wrong == 0, wrong .. " guards failed")
print(#found .. " numbers are as they were")

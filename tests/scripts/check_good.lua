-- SPDX-License-Identifier: GPL-3.0-or-later
-- A whole experiment on a grid that would take minutes: nothing heavy is run, everything is looked at.
--! command: check
--! output: check_good.lua: no problem found
--! not output: checked to line
--! not output: from the script
local lab = require "asperity"
local S, um = lab.surface, lab.units.um
local al = lab.material "Al-2011"
local book = lab.notebook "check"
book:units{ Ra="m", pressure="Pa" }
for _, D in ipairs{ 2.0, 2.5, 2.9 } do
  local rough = S.weierstrass_mandelbrot{ cells=16384, D=D, n_max=2000, material=al }
  local scaled = rough:scaled{ amplitude=rough:roughness().amplitude * 2 }:filtered{ long_wave="1 mm" }
  local c <close> = lab.contact{ lower=scaled, upper=rough:mirrored(), effects={ elasticity={ model="box", stiffness="80 MPa/um" } } }
  c:place{ seed=2 }
  for st in c:sweep{ pressure={ "1 MPa", "10 MPa", scaled:roughness().Ra * 1e12 } } do
    local shown = string.format("%.3f um %d %s", st.approach / um, st.nodes_in_contact, st) .. st.area
    book:write{ D=D, Ra=scaled:roughness().Ra, pressure=st.pressure, text=shown, mu=st.area_fraction^2 // 1 }
    for name, value in pairs(st.cost) do local x = name .. tostring(value) end
    st:field "pressure":picture("pressure.png", { title=table.concat({ "D", D, st.area }, " ") })
  end
  local law = lab.friction{ tau0="500 MPa", alpha=0.2, yield_pressure="1 GPa" }
  local st = c:press{ flatten=0.1 }
  local t = lab.tilt_stage{ contact=c, friction=law, mass="4.3 g" }:raise{ repeats=5 }
  book:write{ D=D, angle=t.angle / lab.units.deg, mu=law:on(st).mu, held=math.tan(t.held) }
end
local rows = {}
for _, row in ipairs(book:rows()) do rows[#rows + 1] = row.D end
for _, p in ipairs(S.read("specimen.x3p"):profiles{ along="y" }) do table.insert(rows, p:roughness().Ra) end
local x, y = S.grain_profile{ radius="1 mm", D=1.2, points=100 }:outline()
local total = #x + #y + rows[#rows]
book:chart{ x="D", y="mu", one_line_per="pressure" }
book:expect("mu", { where={ D=2.5 }, near=total, within=0.1 })
local file = assert(io.open("notes.txt", "w"))
file:write("from the script", 12)
file:close()
print("from the script", total)
io.write("from the script ", total):write("\n")

-- SPDX-License-Identifier: GPL-3.0-or-later
-- Makes tilt_angles.csv, the table that examples/angles.lua reads: tilt angles of five faces of rising roughness, five
-- trials each, as a German spreadsheet would write them. No stage was there.
--
--   asperity run examples/data/make_tilt_angles.lua --out /tmp/angles && cp /tmp/angles/tilt_angles.txt examples/data/tilt_angles.csv
local lab = require "asperity"
local steel = lab.material "steel"
local law = lab.friction{ tau0 = "500 MPa", alpha = 0.2 }

local function german(number, digits) return (("%." .. digits .. "f"):format(number):gsub("%.", ",")) end
local lines = { "SYNTHETISCH: berechnet von make_tilt_angles.lua, nicht gemessen", "Probe;Rauheit Ra [µm];Versuch;Winkel [°]" }
for k, ra in ipairs{ 0.2, 0.4, 0.8, 1.6, 3.2 } do
  local face = lab.surface.self_affine{ cells = 256, size = "400 um", hurst = 0.8, ra = ra * 1e-6, roll_off = "100 um",
                                        short_wave = "12.5 um", seed = 100 + k, material = steel }
  local stage = lab.tilt_stage{
    contact = lab.contact{ lower = face, upper = lab.rigid, boundary = "periodic", effects = { elasticity = "half_space" } },
    friction = law, mass = "50 g", specimen_area = "1 cm^2", scatter = 0.06 }
  for trial, t in ipairs(stage:raise{ repeats = 5, seed = k }.trials) do
    lines[#lines + 1] = ("S%d;%s;%d;%s"):format(k, german(ra, 1), trial, german(math.deg(t.held), 1))
  end
end
local file <close> = io.open("tilt_angles.txt", "w")
file:write(table.concat(lines, "\r\n"), "\r\n")

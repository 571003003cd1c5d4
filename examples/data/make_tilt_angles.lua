-- SPDX-License-Identifier: GPL-3.0-or-later
-- Makes tilt_angles.csv, the table of examples/angles.lua: synthetic tilt angles of five faces of
-- rising roughness, five trials each, in the format of a German spreadsheet.
--
--   asperity run --out RUN examples/data/make_tilt_angles.lua
--   cp RUN/tilt_angles.txt examples/data/tilt_angles.csv
local lab = require "asperity"
local steel = lab.material "steel"

local lines = { "SYNTHETISCH: berechnet von make_tilt_angles.lua, nicht gemessen",
  "Probe;Rauheit Ra [µm];Versuch;Winkel [°]" }
for k, ra in ipairs{ 0.2, 0.4, 0.8, 1.6, 3.2 } do
  local face = lab.surface.self_affine{ cells = 256, size = "400 um", hurst = 0.8, ra = ra * 1e-6,
    roll_off = "100 um", short_wave = "12.5 um", seed = 100 + k, material = steel }
  local stage = lab.tilt_stage{ mass = "50 g", specimen_area = "1 cm^2", scatter = 0.06,
    friction = lab.friction{ tau0 = "500 MPa", alpha = 0.2 },
    contact = lab.contact{ lower = face, upper = lab.rigid, boundary = "periodic",
      effects = { elasticity = "half_space" } } }
  for trial, t in ipairs(stage:raise{ seed = k }.trials) do
    lines[#lines + 1] = ("S%d;%.1f;%d;%.1f"):format(k, ra, trial, math.deg(t.held)):gsub("%.", ",")
  end
end
local file <close> = io.open("tilt_angles.txt", "w")
file:write(table.concat(lines, "\r\n"), "\r\n")

// SPDX-License-Identifier: GPL-3.0-or-later
// The script of a first visit.

export const newcomer = `local lab = require "asperity"

-- A rough face, pressed by a rigid flat:
-- how much of it touches?
-- Run it, then move the slider.
local pressure = lab.knob{ name="pressure",
  from="1 MPa", to="500 MPa",
  value="50 MPa", log=true }

local face = lab.surface.self_affine{
  cells=256, size="100 um", hurst=0.8,
  ra="0.2 um", short_wave="3 um",
  material=lab.material "Al-2011" }
local contact = lab.contact{
  lower=face, upper=lab.rigid,
  boundary="periodic",
  effects={ elasticity="half_space" } }

local st = contact:press{
  pressure=pressure }
local area = st.area_fraction
print(("%.2f %% touches"):format(100 * area))

local book = lab.notebook "area"
book:write{
  ["pressure [Pa]"]=pressure, area=area }
`;

-- SPDX-License-Identifier: GPL-3.0-or-later
-- What a scene needs is known to the dry run, though its bodies are not made.
--! command: check
--! exit: 1
--! error: check_scene.lua:17: lab.contact: 
--! error: of the lower body (effect `elasticity`), which has no material
--! error: check_scene.lua:18: lab.contact: a half-space needs `boundary`
--! error: check_scene.lua:20: lab.contact: the lower body has 64 x 64 cells
--! not error: check_scene.lua:19
--! not error: check_scene.lua:22
local lab = require "asperity"
local function rough(cells, material)
  return lab.surface.self_affine{ cells=cells, size="1 mm", hurst=0.8, ra="1 um", short_wave="100 um",
    material=material }
end
local al, half_space = lab.material "Al-2011", { elasticity="half_space" }
local c = lab.contact{ lower=rough(64), upper=lab.rigid, boundary="periodic", effects=half_space }
local d = lab.contact{ lower=rough(64, al), upper=lab.rigid, effects=half_space }
local e = lab.contact{ lower=rough(64, al):scaled{ ra="2 um" }, upper=lab.rigid, boundary="periodic", effects=half_space }
local f = lab.contact{ lower=rough(64, al), upper=rough(32), effects={ elasticity="box" } }
local st = e:press{ pressure="1 MPa" }
local g = lab.contact{ lower=rough(64):with{ material=al }, upper=al, boundary="free", effects=half_space }

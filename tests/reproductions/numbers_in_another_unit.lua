-- SPDX-License-Identifier: GPL-3.0-or-later
-- The error of a bare number names the unit in which the number would be in range.
--! error: `angle` is 45 rad
--! error: `angle` is 90 rad
--! error: `young` is 70 Pa
--! output: refused: 
--! output: above the angle of slip
local lab = require "asperity"
local s = lab.surface.sine{ cells=16, size="1 mm", amplitude="1 um", material=lab.material "Al-2011" }
local turned = s:rotated(45)
local c = lab.contact{ lower=s, upper=s, boundary="free", effects={ elasticity="half_space" } }
c:rotate(90)
local m = lab.material{ young=70, poisson=0.3 }
local stage = lab.tilt_stage{ contact=lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity="box" } },
  friction=lab.friction{ tau0=1, alpha=0.2 }, mass="4 g", step=1 }
local ok, message = pcall(stage.raise, stage, { repeats=1 })
print((ok and "accepted" or "refused: ") .. (ok and "" or message))

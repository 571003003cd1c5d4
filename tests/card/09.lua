-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local before = lab.surface.read "before.csv"
local after = lab.surface.read "after.csv"
local reg = after:registered_to(before)
print(reg)
local area = before.size[1] * before.size[2] * reg.overlap
local depth = (before - reg.surface):roughness().mean
lab.say("wear depth %.2f [nm] +- %.2f [nm]", depth, reg.u.lift)
lab.say("wear volume %.3f [um^3] +- %.6f [um^3]", depth * area, reg.u.lift * area)

-- SPDX-License-Identifier: GPL-3.0-or-later
local lab = require "asperity"
local um, nm = lab.units.um, lab.units.nm
local before = lab.surface.read "before.csv"
local after = lab.surface.read "after.csv"
local reg = after:registered_to(before)
print(reg)
local area = before.size[1] * before.size[2] * reg.overlap
local depth = (before - reg.surface):roughness().mean
print(("wear depth %.2f nm +- %.2f nm"):format(depth / nm, reg.u.lift / nm))
print(("wear volume %.3f um^3 +- %.6f um^3"):format(depth * area / um ^ 3, reg.u.lift * area / um ^ 3))

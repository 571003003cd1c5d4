-- SPDX-License-Identifier: GPL-3.0-or-later
-- Nothing where a value is needed: a mistake, or what a result would have set; the check says what it met.
--! command: check
--! output: checked to line 9, attempt to perform arithmetic on a nil value (local 'total'): a mistake, unless a result
local lab = require "asperity"
local plate = lab.surface.sine{ cells=64, size="1 mm", amplitude="1 um" }
print(plate:roughness().Ra)
local total
for k = 1, 3 do total = total + k end

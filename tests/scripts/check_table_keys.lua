-- SPDX-License-Identifier: GPL-3.0-or-later
-- A loop over keys without a fixed order is a note at its line, not a mistake.
--! command: check
--! error: asperity: note:
--! error: check_table_keys.lua:11: several keys of this table are tables, functions or userdata
--! not error: lua:13
--! not error: lua:14
--! output: no problem found
local lab = require "asperity"
local of, steel = {}, lab.material "steel"
for k, v in pairs{ [{}]=1, [{}]=2, a=3 } do local x = v end
-- A single such key has one order only, and a placeholder is unknown.
for k in pairs{ [steel]=1, b=2 } do local x = k end
for k in pairs{ [lab.surface.sine{ cells=8, size=1, amplitude=1 }:roughness().Ra]=1, b=2 } do local x = k end

-- SPDX-License-Identifier: GPL-3.0-or-later
-- A map registered to an earlier map from a script: results, signs and refusals.
--! output: all as it should be
local lab = require "asperity"
local S, um, deg = lab.surface, lab.units.um, lab.units.deg
local refused = dofile((arg[0]:match ".*/" or "") .. "../support/refused.lua").at_its_line
local function near(a, b, within) assert(math.abs(a - b) <= within, a .. " is not near " .. b) end

local before = S.self_affine{ cells=128, size="128 um", hurst=0.8, rms_height="1 um", roll_off="40 um", short_wave="6 um" }
local part = before:cropped{ cells={ 90, 80 }, x="10 um", y="24 um" }

-- A part of the map is found at its cut.
local r = part:registered_to(before, { angle="5 deg", at_most="60 um" })
near(r.shift.x, 10 * um, 1e-4 * um)
near(r.shift.y, 24 * um, 1e-4 * um)
near(r.angle, 0, 1e-4 * deg)
assert(r.scale == 1 and r.second_best < 0.9 and r.explained > 0.999)
near(r.overlap, 90 * 80 / 128 ^ 2, 1e-12)
assert(r.surface.cells[1] == 128 and r.surface.size[2] == before.size[2])
near(r.surface:height(50, 60), before:height(50, 60), 1e-6 * um)
assert(r.u.shift.x < 0.01 * um and r.u.angle < 0.01 * deg and r.u.tilt.y < 1e-3 and r.u.lift < 0.01 * um)

-- Turned counter-clockwise by a quarter, it has to be turned back.
near(part:rotated "90 deg":registered_to(before).angle, -90 * deg, 1e-4 * deg)

refused(function() S.flat{ cells=64, size="64 um" }:registered_to(before) end, "the after-map is flat")
refused(function() part:registered_to(before, { angle="5 um" }) end, "`angle`", "an angle")
refused(function() part:registered_to(before, { at_most=0 }) end, "`at_most` is 0")
refused(function() part:registered_to(before, { atmost="5 um" }) end, "(did you mean `at_most`?)")
refused(function() part:registered_to() end, "before")
refused(function() print(r.shfit) end, "(did you mean `shift`?)")
-- Heights of one map in millimetres and of the other in micrometres.
refused(function() before:scaled{ amplitude=1000 * before.peak_to_valley }:registered_to(before) end,
  "the heights of the after-map are 1e+03 times those of the before-map", "check the units of both")
print "all as it should be"

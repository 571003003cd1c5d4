-- SPDX-License-Identifier: GPL-3.0-or-later
-- The maps of the tasks: a tilted scan, and a face before and after wear.
local lab = require "asperity"
local face = lab.surface.self_affine{ cells=128, size="200 um", hurst=0.8, rms_height="1 um", short_wave="8 um", seed=3 }
local ramp = lab.surface.from_function{ cells=128, size="200 um", height=function(x) return 0.01 * x end }
face:plus(ramp):write "scan.csv"
face:write "before.csv"
face:cut{ fraction=0.05 }:shifted{ x="6.25 um", y="3.125 um" }:write "after.csv"

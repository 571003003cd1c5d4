#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A pressure set to a length is a bad value, not a difference between two runs.
set -eu
. "$(dirname "$0")/beginning.sh"
cat > s.lua <<'LUA'
local lab = require "asperity"
local s = lab.surface.sine{ cells=16, size="1 mm", amplitude="1 um", material=lab.material "Al-2011" }
local c = lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
print(c:press{ pressure="1 MPa" }.area_fraction)
LUA
"$program" run s.lua --out R > /dev/null 2>&1
ends 1 '`--set` gives `contact:press` the value "3 um"' "$program" replay --set press.pressure="3 um" R
! grep "differ" output || fail "told as a difference"

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# `check` refuses a half-space of a body without a material, as `run` does.
set -eu
. "$(dirname "$0")/beginning.sh"
cat > s.lua <<'LUA'
local lab = require "asperity"
local s = lab.surface.self_affine{ cells=64, size="1 mm", hurst=0.8, ra="1 um", short_wave="100 um" }
local c = lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
LUA
for command in check run; do ends 1 "s.lua:3: " "$program" $command s.lua; done

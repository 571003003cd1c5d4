#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# `check` reports all mistakes of a file at once, without a traceback, and checks functions given to pcall.
set -eu
. "$(dirname "$0")/beginning.sh"
cat > s.lua <<'LUA'
local lab = require "asperity"
lab.surface.self_afine{}
lab.surface.sin{}
pcall(function() lab.surface.fla{} end)
LUA
ends 1 "s.lua:2: " "$program" check s.lua
says "s.lua:3: " output
says "s.lua:4: " output
! grep traceback output || fail "a traceback"

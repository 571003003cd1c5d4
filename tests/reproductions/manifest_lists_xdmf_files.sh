#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The manifest lists the .xdmf of a .h5, and replay reports an altered one.
set -eu
. "$(dirname "$0")/beginning.sh"
echo 'require "asperity".surface.sine{ cells=8, size=1e-3, amplitude=1e-6 }:write "a.h5"' > s.lua
"$program" run s.lua --out R 2> /dev/null
says '"a.xdmf"' R/manifest.json
ends 0 "the same again" "$program" replay R --out whole
echo x >> R/a.xdmf
ends 1 '`a.xdmf` was altered since the run' "$program" replay R --out altered

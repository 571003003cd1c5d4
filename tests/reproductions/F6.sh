#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# F6: the .xdmf beside a .h5 is listed in the manifest, and replay sees that it was altered.
set -eu
. "$(dirname "$0")/beginning.sh"
echo 'require "asperity".surface.sine{ cells=8, size=1e-3, amplitude=1e-6 }:write "a.h5"' > s.lua
"$program" run s.lua --out R6 2> /dev/null
says '"a.xdmf"' R6/manifest.json
ends 0 "the same again" "$program" replay R6 --out whole
echo x >> R6/a.xdmf
ends 1 '`a.xdmf` was altered since the run' "$program" replay R6 --out altered

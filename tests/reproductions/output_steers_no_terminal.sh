#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# No content of a script or file steers the terminal, and a formula in a table is a text.
set -eu
. "$(dirname "$0")/beginning.sh"
printf 'error("a\\27]0;pwn\\7\\27[31mred")' > x.lua
"$program" check x.lua > output 2>&1 || true
"$program" run x.lua >> output 2>&1 || true
says red output
! LC_ALL=C grep -n "$(printf '[\001-\010\013-\037\177]')" output || fail "control characters"
echo 'require "asperity".notebook "n":write{ ["=1+1"]="=cmd|'"' /C calc'"'!A0" }' > f.lua
"$program" run f.lua --out R 2> /dev/null
printf '"%s"\n"%s"\n' "'=1+1" "'=cmd|' /C calc'!A0" | cmp - R/n.csv

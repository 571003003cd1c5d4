#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# An error at the end of a script of five lines names line 5, not a line 6.
set -eu
. "$(dirname "$0")/beginning.sh"
printf 'local a = 1\nlocal b = 2\nlocal c = 3\nlocal d = 4\nif a then\n' > five.lua
"$program" check five.lua > output 2>&1 && fail "this was accepted"
says "near <eof>" output
says "five.lua:5:" output
printf 'local a = 1\nif a then\n\n\n  \r\n' > spaced.lua
"$program" run spaced.lua --out spaced > output 2>&1 && fail "this was accepted"
says "spaced.lua:2:" output

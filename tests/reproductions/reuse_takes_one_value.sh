#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# `--reuse` takes one value; the word after the value is the script.
set -eu
. "$(dirname "$0")/beginning.sh"
echo 'print "ran"' > script.lua
"$program" run script.lua --out x > /dev/null 2>&1
ends 0 "ran" "$program" run --reuse x script.lua
ends 0 "ran" "$program" run --reuse x --reuse x script.lua

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# B8: `--reuse` takes one value, and the script after it is the script.
set -eu
. "$(dirname "$0")/beginning.sh"
echo 'print "ran"' > script.lua
"$program" run script.lua --out x > /dev/null 2>&1
ends 0 "ran" "$program" run --reuse x script.lua
ends 0 "ran" "$program" run --reuse x --reuse x script.lua

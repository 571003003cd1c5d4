#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# F3: an output of a run that is done was emptied. `--resume` sees it and makes it again.
set -eu
. "$(dirname "$0")/beginning.sh"
echo 'require "asperity".notebook "n":write{ a=1 }' > f3.lua
"$program" run f3.lua --out R3 2> /dev/null
cp R3/n.csv as-written
truncate -s 0 R3/n.csv
ends 0 "n.csv" "$program" run --resume R3
cmp as-written R3/n.csv
ends 0 "there is nothing to resume" "$program" run --resume R3

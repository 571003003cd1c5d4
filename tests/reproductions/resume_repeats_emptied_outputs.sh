#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# `--resume` detects an emptied output of a finished run and writes it again.
set -eu
. "$(dirname "$0")/beginning.sh"
echo 'require "asperity".notebook "n":write{ a=1 }' > s.lua
"$program" run s.lua --out R 2> /dev/null
cp R/n.csv as-written
truncate -s 0 R/n.csv
ends 0 "n.csv" "$program" run --resume R
cmp as-written R/n.csv
ends 0 "there is nothing to resume" "$program" run --resume R

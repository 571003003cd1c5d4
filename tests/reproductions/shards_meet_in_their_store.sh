#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Shards meet in their store for every spelling of the script's path.
set -eu
. "$(dirname "$0")/beginning.sh"
cat > ens.lua <<'LUA'
local lab = require "asperity"
local rows = lab.ensemble{ over={ k={ 1, 2, 3, 4 } }, run=function(case) return { y=2 * case.k } end }
LUA
cp ens.lua copy.lua
ends 0 "2 of 4" "$program" run --store SH --shard 1/2 --out first ens.lua
n=0
for named in "$PWD/ens.lua" ./ens.lua copy.lua; do
  n=$((n + 1))
  cp -r SH SH$n
  "$program" run --store SH$n --shard 2/2 --out second$n "$named" > output 2>&1 || { cat output; fail "$named"; }
  ! grep "2 of 4" output || fail "$named does not meet ens.lua"
done

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# F10: what a killed writer leaves of a file is swept when its run is taken up.
set -eu
. "$(dirname "$0")/beginning.sh"
cat > s.lua <<'LUA'
local lab = require "asperity"
local b = lab.notebook "n"
for k = 1, 500 do
  b:write{ k=k }
  lab.surface.sine{ cells=128, size=1e-3, amplitude=k * 1e-9 }:write("s" .. k % 8 .. ".npy")
end
LUA
for kill in $(whole "1 2 3 4 5 6 7 8 9 10" "1 2"); do
  "$program" run s.lua --out R$kill > /dev/null 2>&1 &
  process=$!
  rows_there() { [ "$(wc -l < R$kill/n.csv)" -ge $((10 * kill)) ]; }
  until_true rows_there
  kill -KILL $process
  wait $process 2> /dev/null || true
  : > R$kill/.n.4242-0.part.csv
  ends 0 "results in" "$program" run --resume R$kill
  [ -z "$(find R$kill -name '*.part*')" ] || fail "parts remain"
done

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Resuming a run removes the partial files of a killed writer. The run waits near its end for the kill, so that a slow
# machine does not kill a finished one.
set -eu
. "$(dirname "$0")/beginning.sh"
cat > s.lua <<'LUA'
local lab = require "asperity"
local b = lab.notebook "n"
for k = 1, 500 do
  while k == 400 and not io.open("killed") do end
  b:write{ k=k }
  lab.surface.sine{ cells=128, size=1e-3, amplitude=k * 1e-9 }:write("s" .. k % 8 .. ".npy")
end
LUA
for kill in $(whole "1 2 3 4 5 6 7 8 9 10" "1 2"); do
  rm -f killed
  "$program" run s.lua --limit-time 100 --out R$kill > /dev/null 2>&1 &
  process=$!
  rows_there() { [ "$(wc -l < R$kill/n.csv)" -ge $((10 * kill)) ]; }
  until_true rows_there
  kill -KILL $process
  wait $process 2> /dev/null || true
  : > killed
  : > R$kill/.n.4242-0.part.csv
  ends 0 "results in" "$program" run --resume R$kill
  [ -z "$(find R$kill -name '*.part*')" ] || fail "parts remain"
done

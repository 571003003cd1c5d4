#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A run dies half-way, and two processes resume it at once. One works, the other is refused and names it; no row is lost or
# written twice, and replay succeeds. The run waits half-way for the kill, and then for the refusal.
set -eu
. "$(dirname "$0")/beginning.sh"
rows=$(whole 600 40) cells=$(whole 512 256)
cat > half.lua <<LUA
local lab = require "asperity"
local b = lab.notebook "n"
for k = 1, $rows do
  while k == 20 and not io.open "killed" or k == 30 and not io.open "refused" do end
  local s = lab.surface.self_affine{ cells=$cells, size="1 mm", hurst=0.8, ra="1 um", short_wave="8 um", seed=k }
  b:write{ k=k, ra=s:roughness().Ra }
end
LUA
"$program" run half.lua --out R1 > /dev/null 2>&1 &
first=$!
rows_there() { [ "$(wc -l < R1/n.csv)" -ge 8 ]; }
until_true rows_there
kill -KILL $first
wait $first 2> /dev/null || true
touch killed

"$program" run --resume R1 > one 2>&1 &
one=$!
"$program" run --resume R1 > other 2>&1 &
other=$!
one_refused() { grep -q "is being written by" one other; }
until_true one_refused
touch refused
first=0 second=0
wait $one || first=$?
wait $other || second=$?
case "$first $second" in
  "0 2") says "is being written by process $one on $(uname -n)" other ;;
  "2 0") says "is being written by process $other on $(uname -n)" one ;;
  *) cat one other; fail "they ended with $first and $second" ;;
esac
[ "$(wc -l < R1/n.csv)" = $((rows + 1)) ] || fail "$(wc -l < R1/n.csv) lines for $((rows + 1))"
ends 0 "the same again" "$program" replay R1 --out R1-again

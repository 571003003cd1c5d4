#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A budget and a calibration whose calls press, spread over threads: the numbers do not depend on how many; Ctrl-C keeps the
# calls that are finished, and a run that was killed or interrupted is taken up with the same numbers to the byte.
#
#   tests/scripts/runner/resumed_studies.sh PROGRAM FOLDER [CELLS]
set -eu
. "$(dirname "$0")/saying.sh"
cells=${3:-256}
begin "$@"

cat > studies.lua <<LUA
local n = $cells
LUA
cat >> studies.lua <<'LUA'
local lab = require "asperity"
local function roughness(x)
  local metal = lab.material{ young = "70 GPa", poisson = 0.33, hardness = x.hardness }
  local face = lab.surface.self_affine{ cells = x.cells or n, size = "400 um", hurst = 0.8, ra = x.ra or "1 um",
    roll_off = "200 um", short_wave = "25 um", seed = x.seed or 1, material = metal }
  local c <close> = lab.contact{ lower = face, upper = lab.rigid, boundary = "periodic",
    effects = { elasticity = "half_space", plasticity = {} } }
  c:press{ pressure = x.pressure or "200 MPa" }
  c:release()
  return c:lower():roughness().Ra
end
local budget = lab.budget{ ask = roughness, replicate = { seed = { 1, 2, 3, 4, 5, 6 } }, cells = { n // 2, n },
  inputs = { hardness = { value = "1.1 GPa", u = "10 %" } }, runs = 8 }
local rows = {}
for k = 1, 8 do rows[k] = { pressure = 4e7 * k, Ra = roughness{ hardness = 1.1e9, pressure = 4e7 * k } * (1 + 0.02 * (-1) ^ (k // 2)) } end
local found = lab.calibrate{ data = lab.table.from(rows), y = "Ra", scatter = "relative",
  parameters = { hardness = { start = "1.4 GPa", lower = "0.2 GPa" }, ra = { start = "1.1 um", lower = "0.1 um" } },
  model = function(q, row) return roughness{ hardness = q.hardness, ra = q.ra, pressure = row.pressure } end }
local book = lab.notebook "studies"
book:write{ of = "budget", value = budget.value, low = budget.low, high = budget.high, share = budget.parts[1].share }
for _, name in ipairs(found.names) do
  local of = found.parameters[name]
  book:write{ of = name, value = of.value, low = of.profile_low, high = of.profile_high, share = found.calls }
end
LUA

"$program" run studies.lua --out whole --threads 2 2> /dev/null
grep -q "budget" whole/studies.csv || fail "the studies wrote no rows"
sed 's/,"unhashed":{.*}//' whole/journal.jsonl > whole.journal

"$program" run studies.lua --out alone --threads 1 2> /dev/null
cmp whole/studies.csv alone/studies.csv || fail "one thread finds other numbers than two"

results() { find "$1/store" -name '*.result' 2> /dev/null | wc -l; }
some_or_ended() { [ "$(results cut)" -ge $some ] || ! kill -0 $process; }
for stop in "1 INT" "2 KILL" "3 INT"; do
  signal=${stop#* }
  some=$(($(results whole) * ${stop% *} / 4))
  status=0
  while [ $status = 0 ]; do # after fewer results, where the run came to its end before the signal
    rm -rf cut
    "$program" run studies.lua --resume cut --threads 2 > output 2>&1 &
    process=$!
    until_true some_or_ended
    kill -"$signal" $process 2> /dev/null || true
    wait $process || status=$?
    # A stop that comes after the end was recorded, while the process ends, stops nothing.
    [ $status = 0 ] || ! grep -q '"status": *"done"' cut/manifest.json 2> /dev/null || status=0
    [ $status != 0 ] || some=$((some * 3 / 4))
  done
  [ "$status" != 1 ] || { cat output; fail "a stop after $some results was taken for a failure"; }
  ends 0 "results in" "$program" run studies.lua --resume cut --threads 2
  cmp whole/studies.csv cut/studies.csv || fail "other numbers after $signal at $some results"
  sed 's/,"unhashed":{.*}//' cut/journal.jsonl | diff whole.journal - || fail "journal after $signal at $some results"
done
grep -q "taken from the store" output || { cat output; fail "a run that was interrupted late kept nothing"; }
echo "studies are resumed"

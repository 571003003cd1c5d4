#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# mpirun -n K asperity run: for one, two and three ranks the journal, notebooks and output of a plain run; a case
# that fails, a script that ends in an error or by os.exit, an interrupt and a rank that is killed end all
# ranks; and a plain run touches nothing of MPI. Exit status 77: this machine has no MPI, or not the part.
#
#   tests/scripts/runner/ranks.sh PROGRAM FOLDER
#
# Three ranks alone; with ASPERITY_WHOLE=1 in the environment, one and two ranks as well.
set -eu
. "$(dirname "$0")/saying.sh"
here=$(cd "$(dirname "$0")" && pwd)
begin "$@"
. "$here/mpi_ranks.sh"

cat > study.lua <<'LUA'
local lab = require "asperity"
local ending = ...
local al = lab.material{ young = "70 GPa", poisson = 0.33 }
local s = lab.surface.self_affine{ cells = 32, size = "100 um", hurst = 0.8, rms_height = "1 um",
  short_wave = "10 um", seed = 4, material = al }
local outside = lab.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
  effects = { elasticity = "half_space" } }
local before = outside:press{ pressure = "30 MPa" }
local rows = lab.ensemble{ over = { p = { "1 MPa", "20 MPa", "50 MPa" }, n = { 1, 2, 3 } }, on_failure = "report",
  run = function(case)
    local c <close> = lab.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
      effects = { elasticity = "half_space" } }
    local st = c:press{ pressure = case.p }
    print("case", case.p, case.n)
    if case.p == "20 MPa" and case.n == 3 then error "this one does not" end
    return { area = st.area_fraction, chance = math.random(), zero = -0.0, more = { 1, 2.5, "a\0b", math.huge } }
  end }
local book = lab.notebook "rows"
for _, r in ipairs(rows) do
  book:write{ p = r.p, n = r.n, area = r.area, chance = r.chance }
  print(math.type(r.n), r.zero, r.more[2], #r.more[3], r.more[4])
end
print(#rows.failed, rows.failed[1].message)
local sums = lab.ensemble{ over = { k = { 1, 2, 3, 4 } }, run = function(case)
  return { total = case.k + rows[case.k].area + before.area_fraction }
end }
for _, r in ipairs(sums) do book:write{ k = r.k, total = r.total } end
print(outside:press{ pressure = "40 MPa" }.area_fraction)
if ending == "error" then error "no more" end
if ending == "exit" then os.exit(3) end
if ending == "cannot" then outside:press{ pressure = -1 } end
LUA

"$program" run study.lua --out plain > plain.txt 2> plain.err
for k in ${ASPERITY_WHOLE:+1 2} 3; do
  ranks $k "$program" run study.lua --threads 1 --out with-$k > with-$k.txt 2> with-$k.err ||
    { cat with-$k.err; fail "$k ranks failed"; }
  cmp plain.txt with-$k.txt || fail "$k ranks: other output"
  cmp plain/rows.csv with-$k/rows.csv || fail "$k ranks: other rows"
  for run in plain with-$k; do
    sed 's/,"unhashed":.*//' $run/journal.jsonl > $run.journal
  done
  cmp plain.journal with-$k.journal || fail "$k ranks: another journal"
  "$program" replay with-$k > replayed 2>&1 || { cat replayed; fail "$k ranks: not what a plain run gives"; }
  [ "$(grep -c '^results in' with-$k.err)" = 1 ] || { cat with-$k.err; fail "$k ranks: not one run"; }
done

# Ends of all kinds.
status=0
ranks 2 "$program" run study.lua --threads 1 --out failed -- error > failed.txt 2>&1 || status=$?
[ $status = 1 ] || { cat failed.txt; fail "an error ended with $status"; }
says "no more" failed.txt
grep -q '"status": *"failed"' failed/manifest.json || fail "the manifest of a failed run does not say so"
status=0
ranks 2 "$program" run study.lua --threads 1 --out left -- exit > left.txt 2>&1 || status=$?
[ $status = 3 ] || { cat left.txt; fail "os.exit(3) ended with $status"; }
status=0
ranks 2 "$program" run study.lua --threads 1 --out refused -- cannot > refused.txt 2>&1 || status=$?
[ $status = 1 ] || { cat refused.txt; fail "a press that cannot be ended with $status"; }
status=0
ranks 2 "$program" run study.lua --threads 1 --out plain > there.txt 2>&1 || status=$?
[ $status = 2 ] || [ $status = 1 ] || { cat there.txt; fail "a directory that is not empty: $status"; }

# One that goes another way is left behind, and the run says so.
cat > another.lua <<'LUA'
local lab = require "asperity"
local n = math.tointeger(os.getenv "OMPI_COMM_WORLD_RANK") + 2
for _, r in ipairs(lab.ensemble{ over = { k = n == 2 and { 1, 2 } or { 1, 2, 3 } },
  run = function(case) return { twice = 2 * case.k } end }) do print(r.twice) end
LUA
status=0
ranks 2 "$program" run another.lua --threads 1 --out another > another.txt 2>&1 || status=$?
[ $status != 0 ] || { cat another.txt; fail "ranks that do not do the same end well"; }
says "must do the same in every process" another.txt

cat > long.lua <<'LUA'
local lab = require "asperity"
lab.ensemble{ over = { k = { 1, 2, 3, 4 } }, run = function(case)
  if case.k > 1 then for _ = 1, 1e12 do end end
  return { k = case.k }
end }
LUA
both_began() { [ -f $how/journal.jsonl ] && [ "$(ls -d .asperity-rank.*/run 2> /dev/null | wc -l)" -ge 1 ]; }
for how in interrupt kill; do
  ends_soon $how both_began
  rm -rf .asperity-rank.*
done
grep -q '"status": *"interrupted"' interrupt/manifest.json || { cat interrupt.txt; fail "interrupt: no record"; }

# A stop of one rank is no failure of its case: nothing of it is recorded, and the run goes on where it was. Rank 0
# waits until rank 1 has its case, and has done all others when rank 1 is stopped.
cat > stopped.lua <<'LUA'
local lab = require "asperity"
local rows = lab.ensemble{ over = { k = { 1, 2, 3, 4, 5, 6 } }, run = function(case)
  local file <close> = io.open "stopped.lua"
  local wait = os.getenv "OMPI_COMM_WORLD_RANK" == "1" and "stopped.go" or "stopped.begun"
  for _ = 1, math.maxinteger do
    local there = io.open(wait)
    if there then there:close() break end
  end
  return { twice = 2 * case.k }
end }
for _, r in ipairs(rows) do print(r.twice) end
LUA
mpirun --oversubscribe --bind-to none -n 2 "$program" run stopped.lua --threads 1 --out stopped > stopped.txt 2>&1 &
launcher=$!
in_case() {
  victim=$(processes_of 1 "stopped.lua.*--out stopped")
  [ -n "$victim" ] && ls -l /proc/$victim/fd | grep -q "/stopped.lua$"
}
until_true in_case
victim=$(processes_of 1 "stopped.lua.*--out stopped")
touch stopped.begun
kill -TERM $victim
wait $launcher && fail "a run of which one rank was stopped ended well" || true
if grep -q '"event":"warning"' stopped/journal.jsonl; then cat stopped/journal.jsonl; fail "a stop was recorded as a failure"; fi
ends 0 "results in" "$program" run --resume stopped
[ "$(grep -c '"failed"' stopped/journal.jsonl)" = 0 ] || fail "a case failed because a rank was stopped"

# Alone, nothing of MPI is touched; without the part, several ranks say so.
echo 'for line in io.lines "/proc/self/maps" do if line:find "mpi" then print(line) end end' > maps.lua
"$program" run maps.lua --out maps > maps.txt 2>&1
if grep -q 'mpi.*\.so' maps.txt; then cat maps.txt; fail "a plain run loads MPI"; fi
mkdir bare
cp "$program" bare/
status=0
(cd / && ranks 2 "$folder/bare/asperity" run "$folder/maps.lua" --out "$folder/bare-run") > bare.txt 2>&1 || status=$?
case $folder in
  "$(dirname "$program")"/*) ;;  # the part of the build is found there
  *) [ $status = 2 ] || { cat bare.txt; fail "without the part: $status"; } && says "asperity-mpi.so, a file that is missing" bare.txt ;;
esac
echo "ranks: all is well"

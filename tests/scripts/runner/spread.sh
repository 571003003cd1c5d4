#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# One contact over the ranks of mpirun: on one, two, three and five of them, slabs of unlike sizes and empty ones, the
# numbers and the fields of lab.contact; the same bits each time; memory a rank falls as there are more; and an
# error, an interrupt or a kill in one rank ends all. Exit status 77: this machine has no MPI, or not the part.
#
#   tests/scripts/runner/spread.sh PROGRAM FOLDER SCRIPT      SCRIPT: tests/scripts/spread.lua
#
# SCRIPT runs on three ranks; with ASPERITY_WHOLE=1 in the environment, on two and five ranks as well.
set -eu
. "$(dirname "$0")/saying.sh"
script=$3
here=$(cd "$(dirname "$0")" && pwd)
begin "$@"
. "$here/mpi_ranks.sh"
grep -q libfftw3_mpi "$(dirname "$program")/asperity-mpi.so" || skip "built without FFTW's MPI transforms"

for k in ${ASPERITY_WHOLE:+2 5} 3; do
  ranks $k "$program" run "$script" --threads 1 --out all-$k > all-$k.txt 2>&1 ||
    { cat all-$k.txt; fail "$k ranks: the script failed"; }
  says "over ranks as in one process" all-$k.txt
done

cat > fields.lua <<'LUA'
local lab = require "asperity"
local al = lab.material{ young = "70 GPa", poisson = 0.33 }
local keys = { cells = { 60, 47 }, size = { "100 um", "80 um" }, hurst = 0.7, rms_height = "1 um",
  short_wave = "12 um", seed = 3, material = al }
local s = lab.spread.self_affine(keys)
local st = lab.spread.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
  effects = { elasticity = "half_space", plasticity = { hardness = "3 GPa" } } }:press{ pressure = "300 MPa" }
s:write "heights.npy"
st:write("pressure", "pressure.npy")
st:write("gap", "gap.npy")
print(s.ranks, st.ranks, st.converged)
local big = lab.spread.self_affine{ cells = 256, size = 1e-4, hurst = 0.7, rms_height = 1e-6, short_wave = 2e-6,
  material = al }
local at = lab.spread.contact{ lower = big, upper = lab.rigid, boundary = "periodic",
  effects = { elasticity = "half_space" }, accuracy = { tolerance = 1e-3 } }:press{ pressure = "300 MPa" }
print(("bytes %d"):format(at.cost.bytes))
LUA
for k in 1 2 3; do
  for time in first second; do
    ranks $k "$program" run fields.lua --threads 1 --out $time-$k > $time-$k.txt 2>&1 ||
      { cat $time-$k.txt; fail "$k ranks: the fields failed"; }
    sed 's/,"unhashed":.*//' $time-$k/journal.jsonl > $time-$k.journal
  done
  cmp first-$k.journal second-$k.journal || fail "$k ranks: other bits the second time"
  for field in heights pressure gap; do
    cmp first-$k/$field.npy second-$k/$field.npy || fail "$k ranks: another $field the second time"
  done
  says "$k	$k	true" first-$k.txt
done
bytes() { sed -n 's/^bytes //p' first-$1.txt; }
[ $(($(bytes 2) * 100)) -le $(($(bytes 1) * 55)) ] || fail "two ranks hold $(bytes 2) bytes each, one $(bytes 1)"
[ $(($(bytes 3) * 100)) -le $(($(bytes 1) * 39)) ] || fail "three ranks hold $(bytes 3) bytes each, one $(bytes 1)"

cat > compare.lua <<'LUA'
local lab = require "asperity"
local al = lab.material{ young = "70 GPa", poisson = 0.33 }
local s = lab.surface.self_affine{ cells = { 60, 47 }, size = { "100 um", "80 um" }, hurst = 0.7, rms_height = "1 um",
  short_wave = "12 um", seed = 3, material = al }
local st = lab.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
  effects = { elasticity = "half_space", plasticity = { hardness = "3 GPa" } } }:press{ pressure = "300 MPa" }
local function compare(name, wanted, within)
  for _, k in ipairs{ 1, 2, 3 } do
    local found = lab.surface.read(("first-%d/%s.npy"):format(k, name), { size = 1e-4, unit = "1 m" }):heights()
    assert(#found == #wanted and #found[1] == #wanted[1])
    for j, row in ipairs(wanted) do
      for i, value in ipairs(row) do
        if math.abs(found[j][i] - value) > within then
          error(("%s on %d ranks at (%d, %d) is %.17g, not %.17g"):format(name, k, i - 1, j - 1, found[j][i], value))
        end
      end
    end
  end
end
compare("heights", s:heights(), 1e-12 * 1e-6)
compare("gap", st:field "gap":values(), 10 * 1e-6 * 1e-6)
compare("pressure", st:field "pressure":values(), 1e-4 * st.peak_pressure)
LUA
"$program" run compare.lua --out compare > compare.txt 2>&1 || { cat compare.txt; fail "the fields differ"; }

# One rank that fails or goes another way ends all.
cat > ends.lua <<'LUA'
local lab = require "asperity"
local how = ...
local rank = os.getenv "OMPI_COMM_WORLD_RANK"
local al = lab.material{ young = "70 GPa", poisson = 0.33 }
local s = lab.spread.from_function{ cells = 32, size = "100 um", material = al, height = function(x, y)
  if how == "height" and y > 90e-6 then error "no ground here" end
  if how == "exit" and y > 90e-6 then os.exit(0) end
  return 1e-6 * math.cos(x * 6.3e4)
end }
local c = lab.spread.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
  effects = { elasticity = "half_space" } }
if how == "rank-" .. rank then error "this one alone" end
if how == "ensemble" and rank == "1" then lab.ensemble{ over = { k = { 1, 2 } }, run = function() return {} end } end
local st = c:press{ pressure = how == "other" and rank == "1" and 2e8 or 1e8 }
if how == "memory" then
  lab.spread.self_affine{ cells = 65536, size = 1, hurst = 0.8, rms_height = 1, short_wave = 1e-4 }
end
LUA
ends() {
  how=$1
  text=$2
  shift 2
  status=0
  ranks 2 "$program" run ends.lua --threads 1 --out ends-$how "$@" -- $how > ends-$how.txt 2>&1 || status=$?
  [ $status != 0 ] && [ $status != 124 ] || { cat ends-$how.txt; fail "$how ended with $status"; }
  says "$text" ends-$how.txt
  grep -q '"status": *"done"' ends-$how/manifest.json && fail "$how: the manifest says that it is done" || true
}
ends height "no ground here (in rank 1 of 2)"
ends exit "this function cannot end the run"
ends rank-0 "this one alone"
ends rank-1 "is done by all ranks together, and rank 1 failed"
ends other "rank 1 reached spreadContact:press"
ends ensemble "reached an ensemble when rank 0 reached spreadContact:press"
ends memory "memory" --limit-memory 1G

# A run taken up again does not repeat a press; fields that a script then writes are solved for again.
cat > again.lua <<'LUA'
local lab = require "asperity"
local s = lab.spread.self_affine{ cells = 256, size = 1e-4, hurst = 0.7, rms_height = 1e-6, short_wave = 2e-6,
  material = lab.material{ young = "70 GPa", poisson = 0.33 } }
local st = lab.spread.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
  effects = { elasticity = "half_space" } }:press{ pressure = "300 MPa" }
st:write("pressure", "pressure.npy")
print(st.digest, st.solver, st.area_fraction)
LUA
ranks 2 "$program" run again.lua --threads 1 --out again > again-1.txt 2> again-1.err || { cat again-1.err; fail "again"; }
ranks 2 "$program" run again.lua --threads 1 --reuse again --out again-2 > again-2.txt 2> again-2.err ||
  { cat again-2.err; fail "taking it up again"; }
says "1 result was taken from the store" again-2.err
cmp again-1.txt again-2.txt || fail "what was taken from the store is not what was found"
cmp again/pressure.npy again-2/pressure.npy || fail "the fields are not those of the press that was taken up"

# So does one that was killed in the middle, and it ends as the run that nobody disturbed.
cat > thirty.lua <<'LUA'
local lab = require "asperity"
local s = lab.spread.self_affine{ cells = 256, size = 1e-4, hurst = 0.7, rms_height = 1e-6, short_wave = 2e-6,
  material = lab.material{ young = "70 GPa", poisson = 0.33 } }
local c = lab.spread.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
  effects = { elasticity = "half_space" } }
local book = lab.notebook "areas"
for k = 1, 30 do
  while k == 20 and not io.open "go" do end
  local st = c:press{ pressure = k * 3e7 }
  book:write{ k = k, area = st.area_fraction, digest = st.digest }
end
LUA
touch go
ranks 2 "$program" run thirty.lua --threads 1 --out whole > whole.txt 2>&1 || { cat whole.txt; fail "thirty presses"; }
rm go
mpirun --oversubscribe --bind-to none -n 2 "$program" run thirty.lua --threads 1 --out broken > broken.txt 2>&1 &
launcher=$!
began() {
  processes=$(processes_of "." "thirty.lua.*--out broken")
  [ "$(echo $processes | wc -w)" = 2 ] && [ "$(wc -l < broken/areas.csv)" -ge 3 ]
}
until_true began
kill -9 $launcher $processes
wait $launcher && fail "a killed run ended well" || true
ended() { [ -z "$(processes_of "." "thirty.lua.*--out broken")" ]; }
until_true ended
touch go
grep -q '"status": *"done"' broken/manifest.json && fail "the run ended before it was killed" || true
ranks 2 "$program" run --resume broken --threads 1 > resumed.txt 2>&1 || { cat resumed.txt; fail "taking up what was killed"; }
grep -qE "^([2-9]|[12][0-9]) results were taken from the store" resumed.txt || { cat resumed.txt; fail "the presses were repeated"; }
for run in whole broken; do sed 's/,"unhashed":.*//' $run/journal.jsonl > $run.journal; done
cmp whole.journal broken.journal || fail "the resumed run has another journal"
cmp whole/areas.csv broken/areas.csv || fail "the resumed run has other rows"

cat > long.lua <<'LUA'
local lab = require "asperity"
local al = lab.material{ young = "70 GPa", poisson = 0.33 }
local s = lab.spread.self_affine{ cells = 512, size = 1e-4, hurst = 0.7, rms_height = 1e-6, short_wave = 1e-6,
  material = al }
local c = lab.spread.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
  effects = { elasticity = "half_space" } }
while true do c:press{ pressure = "300 MPa" } end
LUA
presses() { [ -f $how/journal.jsonl ] && grep -q press $how/journal.jsonl; }
for how in interrupt kill; do ends_soon $how presses; done
grep -q '"status": *"interrupted"' interrupt/manifest.json || { cat interrupt.txt; fail "interrupt: no record"; }
echo "spread: all is well"

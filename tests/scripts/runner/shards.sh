#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# asperity run --shard and --store: shards one after the other and at the same time, one that is killed and run
# again, a job array of Slurm whose variables and sbatch are emulated, and what all of them put together,
# which is what a plain run gives.
#
#   tests/scripts/runner/shards.sh PROGRAM FOLDER SLURM_EXAMPLE
set -eu
. "$(dirname "$0")/saying.sh"
example=$3
begin "$@"

cat > study.lua <<'LUA'
local lab = require "asperity"
local al = lab.material{ young = "70 GPa", poisson = 0.33 }
local s = lab.surface.self_affine{ cells = 32, size = "100 um", hurst = 0.8, rms_height = "1 um",
  short_wave = "10 um", seed = 4, material = al }
local slow = ... == "slow"
local rows = lab.ensemble{ over = { p = { "1 MPa", "20 MPa", "50 MPa" }, n = { 1, 2, 3 } }, run = function(case)
  local c <close> = lab.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
    effects = { elasticity = "half_space" } }
  local st = c:press{ pressure = case.p }
  print("case", case.p, case.n)
  while slow and case.n > 1 and not io.open "killed.go" do end
  return { area = st.area_fraction, chance = case.n == 2 and math.random() or 0, whole = case.n, zero = -0.0,
    more = { 1, 2.5, "a\0b", math.huge } }
end }
local book = lab.notebook "rows"
for _, r in ipairs(rows) do
  book:write{ p = r.p, n = r.n, area = r.area, chance = r.chance }
  print(math.type(r.whole), r.zero, r.more[2], #r.more[3], r.more[4])
end
local sums = lab.ensemble{ over = { k = { 1, 2, 3, 4 } }, run = function(case)
  return { total = case.k + rows[case.k].area }
end }
for _, r in ipairs(sums) do book:write{ k = r.k, total = r.total } end
LUA

same() {  # run of shards, name
  cmp plain/rows.csv "$1/rows.csv" || fail "$2: other rows"
  cmp plain.txt "$1.txt" || fail "$2: other output"
  "$program" replay "$1" > replayed 2>&1 || { cat replayed; fail "$2: not what a plain run gives"; }
  [ "$(wc -l < plain/journal.jsonl)" = "$(wc -l < "$1/journal.jsonl")" ] || fail "$2: another journal"
  for run in plain "$1"; do grep -o '"result":"[0-9a-f]*"' $run/journal.jsonl > $run.digests; done
  cmp plain.digests "$1.digests" || fail "$2: other digests"
}

"$program" run study.lua --out plain > plain.txt 2> plain.err

# One after the other: two ensembles, two rounds.
for round in 1 2; do
  for i in 1 2 3; do
    "$program" run study.lua --store one --shard $i/3 --out one-$round-$i > out 2> one-$round-$i.err ||
      { cat one-$round-$i.err; fail "shard $i of round $round failed"; }
  done
done
says "shard 1 of 3: its 3 cases of the ensemble at study.lua:6 are done; 3 of 9 are in one" one-1-1.err
says "its 2 cases of the ensemble at study.lua:20 are done; 3 of 4 are in one" one-2-1.err
"$program" run study.lua --store one --out merged > merged.txt 2> merged.err
says "taken from the store" merged.err
same merged "one after the other"

# At the same time, and one of them is killed on the way and run again.
for round in 1 2; do
  for i in 1 2 3; do
    "$program" run study.lua --store two --shard $i/3 --threads 1 --out two-$round-$i > two-$round-$i.txt 2>&1 &
    eval "shard$i=\$!"
  done
  wait $shard1 && wait $shard2 && wait $shard3 || fail "a shard of those at the same time failed"
done
"$program" run study.lua --store two --out together > together.txt 2> together.err
same together "at the same time"

"$program" run study.lua --store three --shard 2/3 --threads 1 --out killed -- slow > killed.txt 2>&1 &
shard=$!
kept() { [ -n "$(find three -name '*.results' -size +0)" ]; }
until_true kept
kill -9 $shard
wait $shard 2> /dev/null || true
rm -rf killed
touch killed.go
"$program" run study.lua --store three --shard 2/3 --threads 1 --out killed -- slow > killed.txt 2>&1 ||
  { cat killed.txt; fail "a shard that was killed cannot be run again"; }
says "shard 2 of 3: its 3 cases" killed.txt
says "taken from the store" killed.txt

# The example for Slurm, with an sbatch that runs everything at once and loses the tasks named in the file `lost`.
mkdir bin
cat > bin/sbatch <<'SBATCH'
#!/bin/sh
set -eu
array= wrap= after=
while [ $# -gt 0 ]; do
  case $1 in
    --dependency=afterany:*) after=${1#--dependency=afterany:} ;;
    --array=1-*) array=${1#--array=1-} ;;
    --wrap) wrap=$2; shift ;;
    --*) ;;
    *) break ;;
  esac
  shift
done
[ -z "$after" ] || [ -f "job-$after.ended" ] || { echo "job $after did not end" >&2; exit 1; }
job=$(($(ls job-*.ended 2> /dev/null | wc -l) + 100))
if [ -n "$wrap" ]; then
  status=0
  sh -c "$wrap" > merge.log 2>&1 || status=$?
  echo $status > merge.status
else
  for task in $(seq 1 "$array"); do
    ! grep -q "^$task\$" lost 2> /dev/null || continue
    SLURM_ARRAY_JOB_ID=$job SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_COUNT=$array SLURM_ARRAY_TASK_MIN=1 \
      SLURM_CPUS_PER_TASK=1 "$@" > "job-$job-$task.log" 2>&1 &
  done
  wait
fi
touch "job-$job.ended"
echo "$job"
SBATCH
chmod +x bin/sbatch
array() { ASPERITY=$program PATH=$folder/bin:$PATH "$example" "$@" > array.log 2>&1 || { cat array.log; fail "$*"; }; }
array study.lua four array 3 2
grep -v '^results in\|taken from the store' merge.log > array.txt
same array "the job array"

# Tasks that are lost: the last job names them and computes nothing; the same command does the rest.
echo 2 > lost
array study.lua lossy lossy-run 3 2
[ "$(cat merge.status)" = 3 ] || { cat merge.log; fail "a merge that lacks cases ended with $(cat merge.status)"; }
says "3 of 9 cases of the ensemble at study.lua:6 are not in lossy: shard 2/3" merge.log
rm lost
array study.lua lossy lossy-run 3 2
[ "$(cat merge.status)" = 0 ] || { cat merge.log; fail "what was lost is not made up for"; }
cmp plain/rows.csv lossy-run/rows.csv || fail "tasks that were lost: other rows"

# A case that fails at first: a shard ends with the same status whether others are missing or not, the next round tries
# the case again, and its result counts from then on.
cat > fails.lua <<'LUA'
local lab = require "asperity"
local rows = lab.ensemble{ over = { k = { 1, 2, 3, 4 } }, run = function(case)
  if case.k == 3 and not io.open "mended" then error "not yet" end
  return { twice = 2 * case.k }
end }
for _, r in ipairs(rows) do print(r.twice) end
LUA
ends 1 "1 of its 2 cases of the ensemble at fails.lua:2 failed; 2 of 4 are in fails" \
  "$program" run fails.lua --store fails --shard 1/2 --out fails-1
says "case k = 3: " output
says "not yet" output
ends 1 "1 of 4 cases failed" "$program" run fails.lua --store fails --shard 2/2 --out fails-2
ends 1 "1 of 4 cases failed" "$program" run fails.lua --store fails --shard 1/2 --resume fails-1
ends 1 "fails.lua, ensemble 1, at fails.lua:2: 3 of 4 cases are stored, 1 failed, 0 are missing" \
  "$program" status fails
says "case k = 3: fails.lua:3: not yet" output
ends 1 "1 of 4 cases failed" "$program" run fails.lua --store fails --merge-only --out fails-merged
touch mended
ends 0 "results in" "$program" run fails.lua --store fails --shard 1/2 --resume fails-1
ends 0 "results in" "$program" run --resume fails-merged --merge-only --store fails
ends 0 "4 of 4 cases are stored" "$program" status fails

# A task that Slurm requeues has the same variables and meets its own folder. Two ensembles, two rounds.
cat > requeue.lua <<'LUA'
local lab = require "asperity"
local first = lab.ensemble{ over = { k = { 1, 2, 3, 4, 5, 6 } }, run = function(case)
  while case.k > 3 and not io.open "requeue.go" do end
  return { twice = 2 * case.k }
end }
local second = lab.ensemble{ over = { k = { 1, 2, 3, 4, 5, 6 } }, run = function(case)
  return { sum = first[case.k].twice + case.k }
end }
for _, r in ipairs(second) do print(r.k, r.sum) end
LUA
task() {  # number
  ASPERITY=$program SLURM_ARRAY_JOB_ID=77 SLURM_ARRAY_TASK_ID=$1 SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_MIN=1 \
    SLURM_ARRAY_TASK_MAX=3 SLURM_CPUS_PER_TASK=1 "$example" requeue.lua five 3
}
ASPERITY=$program SLURM_ARRAY_JOB_ID=77 SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_MIN=1 \
  SLURM_CPUS_PER_TASK=1 "$example" requeue.lua five 3 > killed.txt 2>&1 &
shard=$!
kept() { [ -n "$(find five -name '*.results' -size +0)" ]; }
until_true kept
kill -9 $shard
wait $shard 2> /dev/null || true
touch requeue.go
one=five/shards/77-1 two=five/shards/77-2
ends 2 "or --resume to go on with the run there" \
  "$program" run requeue.lua --store five --shard 2/3 --out $two
ends 0 "shard 2 of 3: its 2 cases of the ensemble at requeue.lua:2 are done; 2 of 6 are in five" task 2
ends 0 "shard 1 of 3: its 2 cases of the ensemble at requeue.lua:2 are done; 4 of 6 are in five" task 1
grep -q '"status": "shard"' $one/manifest.json || fail "a shard that ended at an ensemble does not say so"
ends 2 "the share (shard 1/3) of" "$program" run --resume $one --shard 2/3 --store five
ends 2 "the share (shard 1/3) of" "$program" run --resume $one --store five --merge-only
ends 0 "shard 1 of 3: its 2 cases" "$program" run --resume $one
ends 0 "$one is shard 1/3 of a run" "$program" replay $one
ends 0 "its 2 cases of the ensemble at requeue.lua:6 are done; 2 of 6 are in five" task 3
ends 0 "its 2 cases of the ensemble at requeue.lua:6 are done; 4 of 6 are in five" task 1
mkdir elsewhere
touch elsewhere/requeue.go
(cd elsewhere && ends 0 "results in" "$program" run --resume "$folder/$two")
grep -q '"status": "done"' $two/manifest.json || fail "the last shard of the last round is not done"
ends 0 "nothing to resume" task 2
ends 0 "the same again" "$program" replay $two
[ "$(find five -maxdepth 1 -name store)$(find five/shards -name store)" = "" ] || fail "a shard kept its cases elsewhere"
"$program" run requeue.lua --store five --merge-only --out requeued > requeued.txt 2> requeued.err
"$program" run requeue.lua --out undisturbed > undisturbed.txt 2> undisturbed.err
cmp undisturbed.txt requeued.txt || fail "requeued shards: other output"

# A merge says what it computes itself, and that cases are there of another build.
"$program" run requeue.lua --store six --shard 1/3 --out six-1 > output 2>&1
ends 3 "4 of 6 cases of the ensemble at requeue.lua:2 are not in six: shards 2/3 and 3/3" \
  "$program" run requeue.lua --store six --merge-only --out six-none
ends 3 "2 of 6 cases are stored, 0 failed, 4 are missing" "$program" status six
says "missing  shards 2/3 and 3/3" output
build=$(sed -n 's/^  build    //p' output)
"$program" run requeue.lua --store six --out six-merged > output 2>&1
says "are not in six: shards 2/3 and 3/3; computed here" output
python3 - "$program" "$build" other <<'PYTHON'
import sys
program, build, other = sys.argv[1:]
code = open(program, "rb").read()
identity = bytes.fromhex(build)
assert code.count(identity) == 1
open(other, "wb").write(code.replace(identity, bytes([identity[0] ^ 1]) + identity[1:]))
PYTHON
chmod +x other
./other run requeue.lua --store five --out other-run > output 2>&1
says "6 of 6 cases of the ensemble at requeue.lua:2 are not in five; computed here; 6 are stored by another build, $build" output
ends 0 "another one; this build does not use its results" "$program" status five

# One case a process, by number; it leaves its result in the store and nothing else.
"$program" cases requeue.lua --list > list.txt
[ "$(cut -f1 list.txt | tr '\n' ' ')" = "1 2 3 4 5 6 2.1 2.2 2.3 2.4 2.5 2.6 " ] || { cat list.txt; fail "other numbers"; }
says "2.3	case k = 3" list.txt
rm -rf runs
mkdir temporary
for case in $(cut -f1 list.txt); do
  [ $case != 6 ] || ends 3 "1 of 6 cases of the ensemble at requeue.lua:2 are not in seven: case 6" \
    "$program" run requeue.lua --store seven --case 2.1
  ends 0 "is stored in seven" env TMPDIR=temporary "$program" run requeue.lua --store seven --case $case
done
ends 0 "is stored in seven" env TMPDIR=temporary "$program" run requeue.lua --store seven --case 3
ends 2 "there is no case 7: the ensemble at requeue.lua:2 has 6 cases" "$program" run requeue.lua --store seven --case 7
ends 2 "has no case 3.1" env TMPDIR=temporary "$program" run requeue.lua --store seven --case 3.1
ends 2 "\`--case\` is \`2.\`" "$program" run requeue.lua --store seven --case 2.
rm mended
ends 1 "case k = 3: fails.lua:3: not yet" "$program" run fails.lua --store eight --case 3
[ -z "$(ls temporary)" ] && [ ! -d runs ] || fail "a run of one case left something behind"
"$program" run requeue.lua --store seven --merge-only --out seven-merged > seven.txt 2> seven.err
cmp undisturbed.txt seven.txt || fail "one case a process: other output"

# What cannot be.
refused() {
  text=$1
  shift
  status=0
  "$@" > output 2>&1 || status=$?
  [ $status = 2 ] || { cat output; fail "$* ended with $status"; }
  says "$text" output
}
refused "\`--shard\` is \`4/3\`; give i/n with i from 1 to n" "$program" run study.lua --store x --shard 4/3
refused "SLURM_ARRAY_TASK_ID, which is not set" env -u SLURM_ARRAY_TASK_ID "$program" run study.lua --store x --shard slurm
refused "--store" "$program" run study.lua --shard 1/2
refused "sbatch --array=1-2" env SLURM_ARRAY_TASK_ID=5 SLURM_ARRAY_TASK_COUNT=2 SLURM_ARRAY_TASK_MIN=1 \
  "$program" run study.lua --store x --shard slurm
refused "to 2 is none of its shards" env SLURM_ARRAY_TASK_ID=2 SLURM_ARRAY_TASK_COUNT=1 SLURM_ARRAY_TASK_MIN=2 \
  SLURM_ARRAY_TASK_MAX=2 "$program" run study.lua --store x --shard slurm
refused "to 5 is none of its shards" env SLURM_ARRAY_TASK_ID=1 SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_MIN=1 \
  SLURM_ARRAY_TASK_MAX=5 "$program" run study.lua --store x --shard slurm
refused "--store" "$program" run study.lua --case 2

# Tasks of srun: ranks where MPI joins them, else refused; a batch script has some of the variables and is alone.
refused "srun started 3 tasks without MPI" env SLURM_PROCID=1 SLURM_NTASKS=3 SLURM_STEP_NUM_TASKS=3 "$program" run study.lua
refused "srun started 3 tasks without MPI" env SLURM_PROCID=1 SLURM_NTASKS=3 PMIX_RANK=1 "$program" run study.lua
touch mended
ends 0 "results in" env SLURM_PROCID=0 SLURM_NTASKS=3 "$program" run fails.lua --store fails --out batch
ends 0 "results in" env SLURM_PROCID=1 SLURM_STEP_NUM_TASKS=2 \
  "$program" run fails.lua --store fails --shard 2/2 --out of-srun
echo "shards: all is well"

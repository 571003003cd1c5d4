#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# asperity run --shard and --store: shards one after the other and at the same time, one that is killed and run
# again, a job array of Slurm whose variables and sbatch are emulated, and what all of them put together,
# which is what a plain run gives.
#
#   tests/scripts/runner/shards.sh PROGRAM FOLDER SLURM_EXAMPLE
set -eu
. "$(dirname "$0")/saying.sh"
program=$1
folder=$2
example=$3
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"

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

# The example for Slurm, with an sbatch that runs everything at once.
mkdir bin
cat > bin/sbatch <<'SBATCH'
#!/bin/sh
set -eu
array= wrap= after=
while [ $# -gt 0 ]; do
  case $1 in
    --parsable | --job-name=* | --cpus-per-task=*) ;;
    --dependency=afterok:*) after=${1#--dependency=afterok:} ;;
    --array=1-*) array=${1#--array=1-} ;;
    --wrap) wrap=$2; shift ;;
    *) break ;;
  esac
  shift
done
[ -z "$after" ] || [ -f "job-$after.done" ] || { echo "job $after did not end well" >&2; exit 1; }
job=$(($(ls job-*.done 2> /dev/null | wc -l) + 100))
if [ -n "$wrap" ]; then
  sh -c "$wrap" > merge.log 2>&1
else
  for task in $(seq 1 "$array"); do
    SLURM_ARRAY_JOB_ID=$job SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_COUNT=$array SLURM_ARRAY_TASK_MIN=1 \
      SLURM_CPUS_PER_TASK=1 "$@" > "job-$job-$task.log" 2>&1 &
  done
  wait
  for task in $(seq 1 "$array"); do grep -q '^results in' "job-$job-$task.log" || exit 1; done
fi
touch "job-$job.done"
echo "$job"
SBATCH
chmod +x bin/sbatch
ASPERITY=$program PATH=$folder/bin:$PATH "$example" study.lua four array 3 2 > array.log 2>&1 ||
  { cat array.log; fail "the example for Slurm failed"; }
grep -v '^results in\|taken from the store' merge.log > array.txt
same array "the job array"

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
echo "shards: all is well"

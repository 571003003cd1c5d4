#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# asperity run --resume: a run is killed at moments spread over its length, taken up, killed again, and taken up
# to its end; journal, notebooks, chart and manifest are then those of the run that nobody disturbed, to the
# byte. And what else may befall it: Ctrl-C, torn or altered results, a full disk, an edited script.
#
#   tests/scripts/runner/resume.sh PROGRAM FOLDER [KILLS [CELLS]]
set -eu
. "$(dirname "$0")/saying.sh"
kills=${3:-5}
cells=${4:-512}
begin "$@"

# Plastic memory, random streams, two notebooks (one that gets a column late), an ensemble and a chart.
cat > events.lua <<LUA
local n = $cells
LUA
cat >> events.lua <<'LUA'
local lab, label = require "asperity", ...
local al = lab.material "Al-2011"
local function body(seed)
  return lab.surface.self_affine{ cells = n, size = "1 mm", hurst = 0.8, rms_slope = 0.1, short_wave = "40 um",
    seed = seed, material = al }
end
local c = lab.contact{ lower = body(1), upper = body(2), boundary = "periodic",
  effects = { elasticity = "half_space", plasticity = {} } }
local book = lab.notebook "events"
for event = 1, 8 do
  local st = c:press{ pressure = "50 MPa" }
  local row = { event = event, label = label, area = st.area_fraction, approach = st.approach,
    transforms = st.cost.transforms, chance = math.random() }
  if event > 5 then row.stiffness = st.stiffness end
  book:write(row)
  c:release()
  c:place{ seed = event }
end
local rows = lab.ensemble{ over = { pressure = { 1e6, 2e6, 4e6 }, seed = { 1, 2, 3 } }, run = function(case)
  local rough = lab.surface.self_affine{ cells = n, size = "1 mm", hurst = 0.8, rms_slope = 0.1,
    short_wave = "40 um", seed = case.seed, material = lab.material "Al-2011" }
  local st = lab.contact{ lower = rough, upper = lab.rigid, boundary = "periodic",
    effects = { elasticity = "half_space" } }:press{ pressure = case.pressure }
  return { area = st.area_fraction, chance = math.random() }
end }
local cases = lab.notebook "cases"
for _, row in ipairs(rows) do
  cases:write{ pressure = row.pressure, seed = row.seed, area = row.area, chance = row.chance }
end
cases:chart{ x = "pressure", y = "area", one_line_per = "seed", file = "areas.svg" }
LUA

moment() { date +%s%N; }
begun=$(moment)
"$program" run events.lua --out whole --seed 3 -- first 2> /dev/null
length=$((($(moment) - begun) / 1000000)) # ms
sed '/"unhashed"/,$d' whole/manifest.json > whole.manifest
sed 's/,"unhashed":{.*}//' whole/journal.jsonl > whole.journal

# Whether a run is the one that nobody disturbed.
same() {
  for file in script.lua events.csv cases.csv areas.svg; do
    cmp "whole/$file" "$1/$file" || fail "$file of $1"
  done
  sed '/"unhashed"/,$d' "$1/manifest.json" | diff whole.manifest - || fail "manifest of $1"
  sed 's/,"unhashed":{.*}//' "$1/journal.jsonl" | diff whole.journal - || fail "journal of $1"
}
# folder, ms: takes a run up, or begins it, and kills it after that long, if it still runs.
disturbed() {
  timeout --foreground -s KILL "$(printf '%d.%03d' $(($2 / 1000)) $(($2 % 1000)))" \
    "$program" run events.lua --resume "$1" --seed 3 -- first > /dev/null 2>&1 || true
}

kill=1
while [ "$kill" -le "$kills" ]; do
  rm -rf cut
  disturbed cut $((length * kill / (kills + 1)))
  disturbed cut $((length * (kills + 1 - kill) / (2 * kills + 2)))
  "$program" run events.lua --resume cut --seed 3 -- first > output 2>&1 || { cat output; fail "kill $kill"; }
  same cut
  kill=$((kill + 1))
done

# Ctrl-C; then nothing is named but the run.
rm -rf cut
"$program" run events.lua --resume cut --seed 3 -- first > /dev/null 2>&1 &
process=$!
until_true test -s cut/events.csv
kill -INT $process
wait $process || true
if ! grep -q '"status": "done"' cut/manifest.json; then
  ends 0 "results in" "$program" run --resume cut
fi
same cut
ends 0 "nothing to resume" "$program" run --resume cut
ends 2 "no run" "$program" run --resume nowhere
ends 2 "no script was named" "$program" run

# As it stands after a power cut: the last line torn, the last result torn, another one altered.
cp -r whole torn
sed -i 's/"status": "done"/"status": "running"/' torn/manifest.json
head -c -40 whole/journal.jsonl > torn/journal.jsonl
head -n 1 whole/events.csv > torn/events.csv
# Whole cases of the ensemble would be taken without a look at the presses inside them.
[ -n "$(ls torn/store/small)" ] || fail "no case was kept"
rm -rf torn/store/small
first=$(ls torn/store/*.result | head -n 1)
last=$(ls torn/store/*.result | tail -n 1)
head -c 1000 "whole/store/${first##*/}" > "$first.new" && mv "$first.new" "$first"
cp "$last" "$last.new"
printf 'x' | dd of="$last.new" bs=1 seek=$(($(wc -c < "$last") / 2)) conv=notrunc 2> /dev/null
mv "$last.new" "$last"
ends 0 "taken from the store" "$program" run --resume torn
[ "$(grep -c "computed again" output)" = 2 ] || { cat output; fail "damaged results were not told of"; }
same torn

# A disk that is full: the run fails, says so, and goes on once there is room.
rm -rf full
status=0
(ulimit -f 4; "$program" run events.lua --out full --seed 3 -- first) > output 2>&1 || status=$?
[ "$status" = 1 ] || { cat output; fail "a full disk ended with $status"; }
grep -q "cannot" output || { cat output; fail "a full disk was not told of"; }
ends 0 "results in" "$program" run --resume full
same full

# Times that a script writes down are other ones the next time: the record is written anew from there.
cat > timed.lua <<'LUA'
local lab = require "asperity"
local book = lab.notebook "times"
local flat = lab.surface.sine{ cells = 32, size = 1, amplitude = 0.01, material = lab.material "steel" }
for n = 1, 3 do
  local c = lab.contact{ lower = flat, upper = lab.rigid, boundary = "free", effects = { elasticity = "box" } }
  book:write{ n = n, seconds = c:press{ pressure = n * 1e3 }.cost.seconds + os.clock() }
end
if (...) then error "here it is cut off" end
LUA
"$program" run timed.lua --out timed -- cut > /dev/null 2>&1 && fail "the error was passed over"
ends 1 "is written again" "$program" run --resume timed
[ "$(wc -l < timed/times.csv)" = 4 ] || fail "rows of a journal written anew"
[ "$(grep -c '"event":"row"' timed/journal.jsonl)" = 3 ] || fail "journal written anew"

# A file that was read and has changed since is named, whether the run came to its end or not.
cat > reads.lua <<'LUA'
local lab = require "asperity"
local table_read = lab.table.read "read.csv"
lab.notebook "copies":write{ first = table_read:column "a"[1] }
if (...) then error "here it is cut off" end
LUA
printf 'a,b\n1,2\n' > read.csv
"$program" run reads.lua --out reads > /dev/null 2>&1 || fail "a table was not read"
ends 0 "nothing to resume" "$program" run --resume reads
grep -q "read.csv" output && { cat output; fail "a file that is as it was is named"; }
printf 'a,b\n3,4\n' > read.csv
ends 0 '"read.csv" has changed since the run read it' "$program" run --resume reads
ends 1 'read.csv' "$program" replay reads
mv read.csv elsewhere.csv
ends 0 '"read.csv", an input of the run, is not found here' "$program" run --resume reads
mv elsewhere.csv read.csv
"$program" run reads.lua --out reads_cut -- cut > /dev/null 2>&1 && fail "the error was passed over"
printf 'a,b\n5,6\n' > read.csv
ends 1 '"read.csv" has changed since the resumed run read it' "$program" run --resume reads_cut

# Another script, arguments or seed.
sed 's/event = 1, 8/event = 1, 9/' events.lua > edited.lua
ends 2 "the script of" "$program" run edited.lua --resume whole
ends 2 "its arguments of" "$program" run events.lua --resume whole -- second
ends 2 "the seed of" "$program" run events.lua --resume whole --seed 4
ends 2 "the seed of" "$program" run --resume whole --seed 1
# Trust is given on the command line, never by the directory of a run.
echo 'error "here it is cut off"' > trusted.lua
"$program" run trusted.lua --trust --out trusted > /dev/null 2>&1 && fail "the error was passed over"
ends 2 'add `--trust` to go on with it so' "$program" run --resume trusted
ends 1 "here it is cut off" "$program" run --resume trusted --trust
ends 2 'leave `--trust` out to go on' "$program" run --resume timed --trust
ends 0 "results were taken from the store" "$program" run edited.lua --reuse whole --out edited --seed 3 -- first
[ "$(wc -l < edited/events.csv)" = 10 ] || fail "the edited script did not run to its end"
head -n 9 edited/events.csv | cmp - whole/events.csv || fail "results that were reused are others"
ends 2 "no folder" "$program" run edited.lua --reuse nowhere
cp -r whole begun
ends 0 "taken from the store" "$program" run edited.lua --resume begun --reuse begun --seed 3 -- first
cmp begun/events.csv edited/events.csv || fail "begun anew"
cmp begun/before-1/events.csv whole/events.csv || fail "what was there is lost"

# No more results than asked for.
ends 0 "results in" "$program" run events.lua --out small --store-limit 700K --seed 3 -- first
[ "$(du -sk small/store | cut -f 1)" -le 720 ] || fail "the store is larger than its limit"
grep -q "results of this run exceed" output || { cat output; fail "a full store was not told of"; }
ends 0 "results in" "$program" run events.lua --out none --store-limit 0 --seed 3 -- first
[ ! -e none/store ] || fail "results were kept though none were asked for"

# A replay from an event on, and variations.
ends 0 "the same again" "$program" replay whole --from 14 --out from
grep -q "taken from the store" output || { cat output; fail "--from took nothing from the store"; }
ends 2 "lines 1 to" "$program" replay whole --from 1000
ends 0 "press.pressure = 60 MPa" "$program" replay whole --from 14 --set "press.pressure=60 MPa" --out varied
head -n 4 whole/events.csv > early && head -n 4 varied/events.csv | cmp - early || fail "events before --from changed"
cmp varied/events.csv whole/events.csv > /dev/null && fail "--set changed nothing"
ends 1 'did you mean `pressure`' "$program" replay whole --set presure=1
ends 2 "give a key and its value" "$program" replay whole --set presure
# A value of another kind is told as that, and not as so many differences.
ends 1 'gives `contact:press` the value "3 um": `pressure`: ' "$program" replay whole --set "press.pressure=3 um"

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# asperity replay: equal runs, one that failed, one that ended by os.exit, one that was cut off, records that
# were altered, a script whose numbers differ from run to run, and runs by another version.
#
#   tests/scripts/runner/replay.sh PROGRAM FOLDER
set -eu
. "$(dirname "$0")/saying.sh"
begin "$@"

cat > events.lua <<'LUA'
local lab = require "asperity"
local count, ending = tonumber((...)), select(2, ...)
local s = lab.surface.self_affine{ cells = 32, size = 1, hurst = 0.8, rms_height = 0.01, short_wave = 0.2, seed = 4,
  material = lab.material{ young = 1, poisson = 0.3, hardness = 0.1 } }
local c = lab.contact{ lower = s, upper = lab.rigid, boundary = "periodic",
  effects = { elasticity = "half_space", plasticity = {} } }
local book = lab.notebook "events"
for n = 1, count do
  local st = c:press{ pressure = 0.01 * n }
  book:write{ n = n, area = st.area_fraction, chance = math.random() }
  print("event", n)
end
c:lower():write "worn.npy"
if ending == "error" then error "no more" end
if ending == "exit" then os.exit(1) end
LUA

"$program" run events.lua --out run --seed 5 -- 3 none > printed 2> /dev/null
[ "$(wc -l < printed)" = 3 ] || fail "the run did not print"
ends 0 "run: the same again" "$program" replay run --out again
grep -q event output && fail "a replay printed what the script prints"
cmp run/events.csv again/events.csv
cmp run/worn.npy again/worn.npy
ends 0 "the same again" "$program" replay again --out third --threads 1
ends 2 "not empty" "$program" replay run --out again

# A run that failed fails the same way again.
"$program" run events.lua --out failed -- 1 error > printed 2>&1 && fail "the error was passed over"
ends 0 "the same again" "$program" replay failed --out failed-again
"$program" run events.lua --out exited -- 1 exit > printed 2>&1 && fail "os.exit was passed over"
ends 0 "the same again" "$program" replay exited --out exited-again

# One that was cut off is compared as far as it came; its last line may be torn.
cp -r run torn
sed -i 's/"status": "done"/"status": "running"/' torn/manifest.json
head -n 4 run/journal.jsonl > torn/journal.jsonl
printf '{"n":5,"ev' >> torn/journal.jsonl
ends 0 "as far as it had come" "$program" replay torn --out torn-again

# What was altered is found.
cp -r run result
sed -i '3s/"result":"[0-9a-f]*"/"result":"00000000000000000000000000000000"/' result/journal.jsonl
ends 1 "line 3, contact:press, result" "$program" replay result --out result-again
cp -r run field
printf x >> field/worn.npy
ends 1 '`worn.npy` was altered since the run' "$program" replay field --out field-again
cp -r run script
echo "-- more" >> script/script.lua
ends 2 "is not the script that ran" "$program" replay script --out script-again
[ -e script-again ] && fail "an altered script was run"
cp -r run line
sed -i 3d line/journal.jsonl
ends 2 "has a wrong number" "$program" replay line --out line-again
ends 2 "that can be read" "$program" replay nowhere --out nowhere-again

# A script that the clock decides differs, and the place is named.
cat > clock.lua <<'LUA'
local lab = require "asperity"
lab.notebook "times":write{ seconds = os.clock() + os.time() }
LUA
"$program" run clock.lua --out clock --trust > printed 2>&1
sleep 1
ends 1 "times, row.seconds" "$program" replay clock --out clock-again --trust
sed 's/{ /{ twice = 2 * os.time(), same = 1, /' clock.lua > columns.lua
"$program" run columns.lua --out columns --trust > printed 2>&1
sleep 1
ends 1 "recorded  row.seconds" "$program" replay columns --out columns-again --trust
says ", row.twice" output
if grep -q "row.same" output; then fail "a column that is the same is told"; fi

# Trust is given on the command line, never by the directory of a run.
ends 2 'add `--trust` to replay it so' "$program" replay clock --out untrusted
ends 2 'leave `--trust` out to replay' "$program" replay run --out trusted --trust

# Results of a run by another minor version are compared; its bytes are not. 0.1.0 wrote no digest of its journal.
version=$("$program" --version | sed 's/^asperity //')
of_version() { # VERSION RUN COPY
  cp -r "$2" "$3"
  sed -i -e "s/\"asperity\": \"$version\"/\"asperity\": \"$1\"/" -e '/^  "journal": {/,/}/d' "$3/manifest.json"
}
of_version "${version%.*}.99" run patched
ends 0 "patched: the same again, " "$program" replay patched --out patched-again
for other in 0.1.0 99.0.0; do
  of_version $other run "of-$other"
  sed -i -E -e '3s/"result":"[0-9a-f]*"/"result":"00000000000000000000000000000000"/' \
    -e '4s/("chance":0\.[0-9]{9})[0-9]*/\11/' "of-$other/journal.jsonl"
  ends 3 "of-$other: the same results" "$program" replay "of-$other" --out "of-$other-again"
  says "of-$other was recorded by version $other, and this is $version" output
  says "9 results compared to 1e-05 of their values" output
done
of_version 0.1.0 run numbers
sed -i '4s/"chance":[0-9.e-]*/"chance":1.5/' numbers/journal.jsonl
ends 3 "numbers: one difference" "$program" replay numbers --out numbers-again
says "events, row 1, chance" output
ends 0 "numbers with" "$program" replay numbers --out numbers-varied --set "press.pressure=0.02"
says "results compared to 1e-05 of their values" output

# Two versions never write one record.
of_version 0.1.0 run begun
sed -i 's/"status": "done"/"status": "running"/' begun/manifest.json
head -n 4 run/journal.jsonl > begun/journal.jsonl
cp begun/manifest.json manifest-before
ends 2 "was begun by version 0.1.0" "$program" run --resume begun
cmp begun/manifest.json manifest-before
cmp run/events.csv begun/events.csv
ends 0 "results in" "$program" run --resume begun --reuse begun
says "\"asperity\": \"$version\"" begun/manifest.json
says '"status": "done"' begun/manifest.json
cmp run/worn.npy begun/worn.npy
of_version 0.1.0 run damaged
rm damaged/worn.npy
ends 2 "which may give other bytes" "$program" run --resume damaged
ends 0 "nothing to resume" "$program" run --resume of-0.1.0
echo "replay: all as it should be"

# A picture drawn with another font: the record names both fonts.
cat > picture.lua <<'LUA'
local lab = require "asperity"
lab.surface.self_affine{ cells = 32, size = 1, hurst = 0.8, rms_height = 0.01, short_wave = 0.2, seed = 4 }:picture "p.png"
LUA
if command -v fc-match > /dev/null; then
  font=$(fc-match -f '%{file}' 'DejaVu Sans:bold')
  mkdir other_font
  cp "$font" other_font/
  printf '<?xml version="1.0"?><fontconfig><dir>%s/other_font</dir></fontconfig>\n' "$PWD" > fonts.conf
  "$program" run picture.lua --out drawn 2> /dev/null
  grep -q '"gnuplot": "gnuplot 5' drawn/manifest.json || fail "the manifest does not name gnuplot"
  ends 0 "the same again" "$program" replay drawn --out drawn-again
  ends 1 "recorded on another font in pictures: DejaVu Sans" env FONTCONFIG_FILE="$PWD/fonts.conf" "$program" replay drawn --out drawn-otherwise
fi

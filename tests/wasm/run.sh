#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The program of the wasm preset: under node, from a folder without the repository, it checks, runs, explains, and
# replays native runs of all lessons without a difference; with `page` then the page in Chromium. Prints times and memory.
#
#   tests/wasm/run.sh node|page NATIVE_PROGRAM WASM_FOLDER [LESSON..]
set -euo pipefail
scope=$1 native=$(readlink -f "$2") module=$(readlink -f "$3") here=$(dirname -- "$(readlink -f "$0")")
shift 3
lessons=${*:-1 2 3 4 5 6 7 8 9 10}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$module"/asperity.js "$module"/asperity.wasm "$folder"
cd "$folder"
fail() { echo "wasm: $*" >&2; exit 1; }
# Seconds and MiB of a command to `cost`; its output to the file `out`.
measured() {
  python3 - "$@" <<'PYTHON'
import resource, subprocess, sys, time
start = time.time()
with open("out", "w") as out:
    status = subprocess.run(sys.argv[1:], stdout=out, stderr=subprocess.STDOUT).returncode
usage = resource.getrusage(resource.RUSAGE_CHILDREN)
with open("cost", "w") as cost:
    print(f"{time.time() - start:.2f} s, {usage.ru_utime + usage.ru_stime:.2f} s of processor, "
          f"{usage.ru_maxrss / 1024:.0f} MiB", file=cost)
sys.exit(status)
PYTHON
}
wasm() { measured node --no-experimental-fetch asperity.js "$@" || { cat out >&2; fail "$*: exit status $?"; }; }

for size in asperity.wasm asperity.js; do echo "$size: $(gzip -9 <$size | wc -c) bytes after gzip -9"; done
cat >press.lua <<'LUA'
local lab = require "asperity"
local plate = lab.surface.self_affine{ cells=256, size="1 mm", hurst=0.8, rms_slope=0.1, short_wave="16 um",
                                       material=lab.material "steel" }
local c = lab.contact{ lower=plate, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
local book = lab.notebook "area"
for st in c:sweep{ pressure={ "100 MPa", "200 MPa", "400 MPa" } } do
  book:write{ ["pressure [Pa]"]=st.pressure, area=st.area_fraction }
end
local runs = lab.ensemble{ over={ seed={ 1, 2, 3 } }, run=function(case)
  local s = lab.surface.self_affine{ cells=64, size="1 mm", hurst=0.8, rms_slope=0.1, short_wave="64 um", seed=case.seed,
                                     material=lab.material "steel" }
  return { rms=s:roughness().Rq }
end }
book:chart{ x="pressure", y="area" }
LUA
wasm check press.lua
wasm explain press.lua
wasm run press.lua --out wasm-run
"$native" run press.lua --out native-run --threads 1 >native.out 2>&1 || { cat native.out; fail "native run"; }
cmp native-run/journal.jsonl wasm-run/journal.jsonl || fail "the journals differ"
cmp native-run/area.csv wasm-run/area.csv || fail "the notebooks differ"
"$native" replay wasm-run || fail "the native program does not replay a run of the wasm preset"
wasm replay native-run
grep -q "every file but charts and pictures" out || { cat out; fail "a replay does not say which files it leaves out"; }
echo "press.lua: $(cat cost)"
cat >large.lua <<'LUA'
local lab = require "asperity"
local plate = lab.surface.self_affine{ cells=2048, size="1 mm", hurst=0.8, rms_slope=0.1, short_wave="16 um",
                                       material=lab.material "steel" }
local c = lab.contact{ lower=plate, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
print(c:press{ pressure="100 MPa" })
LUA
wasm run large.lua --out large
echo "a press on 2048 x 2048 cells: $(cat cost)"
wasm lesson 8 --run
for lesson in $lessons; do
  measured "$native" lesson "$lesson" --run --threads 1 --out "native-$lesson" || { cat out; fail "lesson $lesson, native"; }
  before=$(cat cost)
  wasm replay "native-$lesson"
  grep -q "the same again" out || { cat out; fail "lesson $lesson"; }
  echo "lesson $lesson: native $before; wasm $(cat cost)"
done
echo 'require "asperity".spread.flat{ cells=16, size="1 mm" }' >spread.lua
for absent in "serve" "run press.lua --confined" "run press.lua --limit-time 5s" "run spread.lua"; do
  ! measured node --no-experimental-fetch asperity.js $absent || fail "$absent is not refused"
  grep -q WebAssembly out || { cat out; fail "$absent: the reason is missing"; }
done
[ "$scope" = page ] || exit 0

[ -d "$module/site" ] || fail "$module/site is missing: build the target asperity_site"
bytes=0
for file in "$module"/site/*.js "$module"/site/*.css "$module"/site/*.html "$module"/site/module.xz; do
  bytes=$((bytes + $(gzip -9 <"$file" | wc -c)))
done
echo "the page: $bytes bytes after gzip -9, without documents"
ASPERITY_ALONE=$module/site ASPERITY_PROGRAM=$native ASPERITY_PAGE_BUILD=$module ASPERITY_LESSONS=$lessons \
  CHROMIUM=${CHROMIUM:-$(command -v chromium-headless-shell || command -v chromium)} node --test "$here/page_test.mjs"

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# What a run directory withstands: a second process, damage to a run that is done, a death before the first manifest,
# files beside files, gnuplot that cannot draw as it should, files of killed writers, containers that share a store, scripts
# named in several ways, signals, a journal that disappears or has holes, and links in place of its own files.
#
#   tests/scripts/runner/run_directory.sh PROGRAM FOLDER
set -eu
. "$(dirname "$0")/saying.sh"
begin "$@"
# What still runs when this fails would keep its standard output, and whoever waits for its end.
trap 'kill -KILL $(jobs -p) 2> /dev/null || true' EXIT

lines() { [ "$(wc -l < "$1" 2> /dev/null || echo 0)" -ge "$2" ]; }
# status process: how a process in the background ends.
ends_with() {
  found=0
  wait "$2" || found=$?
  [ "$found" = "$1" ] || fail "process ended with $found instead of $1"
}
done_run() { grep -q '"status": "done"' "$1/manifest.json" || fail "$1 is not done"; }
# The files of a run, each with its content.
content() { find "$1" -type f ! -name .lock | LC_ALL=C sort | xargs sha1sum; }

# Waits in its middle for the file `go`.
cat > wait.lua <<'LUA'
local lab = require "asperity"
local b = lab.notebook "n"
for k = 1, 20 do b:write{ k = k } end
repeat local go = io.open "go" until go
for k = 21, 40 do b:write{ k = k } end
LUA
echo 'require "asperity".notebook "n":write{ a = 1 }' > short.lua

# While a process writes, every other one is refused, naming it, and changes nothing; readers are not.
"$program" run wait.lua --out R1 2> R1.err &
first=$!
until_true lines R1/n.csv 21
content R1 > before
ends 2 "is being written by process $first on $(uname -n)" "$program" run --resume R1
ends 2 "is being written by process $first on $(uname -n)" "$program" run wait.lua --resume R1
ends 2 "is being written by process $first on $(uname -n)" "$program" run wait.lua --out R1
ends 2 "is being written by process $first on $(uname -n)" "$program" run short.lua --resume R1 --reuse R1
ends 2 "is being written by process $first on $(uname -n)" "$program" replay R1 --out R1
ends 0 "results in" "$program" run short.lua --out reader --reuse R1
content R1 | cmp - before || fail "who was refused changed the run"
# It dies; of four that come at once one takes it up.
kill -KILL $first
ends_with 137 $first
for k in 1 2 3 4; do
  "$program" run --resume R1 2> R1-$k.err &
  eval "p$k=\$!"
done
three_refused() { [ "$(cat R1-?.err | grep -c 'is being written by')" = 3 ]; }
until_true three_refused
touch go
won=0 lost=0
for k in 1 2 3 4; do
  eval "p=\$p$k"
  found=0
  wait $p || found=$?
  case $found in 0) won=$((won + 1)) ;; 2) lost=$((lost + 1)) ;; *) fail "one of four ended with $found" ;; esac
done
[ "$won $lost" = "1 3" ] || fail "of four, $won went on and $lost were refused"
[ "$(wc -l < R1/n.csv)" = 41 ] || fail "rows twice"
done_run R1
ends 0 "the same again" "$program" replay R1 --out R1-again
rm go

# A run that is done is what its manifest says, or is made so again.
cat > outputs.lua <<'LUA'
local lab = require "asperity"
local b = lab.notebook "n"
for k = 1, 3 do b:write{ k = k, square = k * k } end
b:chart{ x = "k", y = "square", file = "n.svg" }
lab.surface.sine{ cells = 8, size = 1e-3, amplitude = 1e-6 }:write "maps/a.h5"
LUA
"$program" run outputs.lua --out whole 2> whole.err || { cat whole.err; fail "outputs.lua"; }
ends 0 "there is nothing to resume" "$program" run --resume whole
for damage in ": >" "head -c 20 whole/FILE >" "tr '\\0-\\176' '\\1-\\177' < whole/FILE >" "rm -f"; do
  rm -rf R3
  cp -r whole R3
  for file in n.csv n.svg maps/a.h5 maps/a.xdmf; do
    eval "$(printf '%s\n' "$damage" | sed "s|FILE|$file|") R3/$file"
  done
  ends 0 "every file is again as it was recorded" "$program" run --resume R3
  [ "$(grep -c "the run is repeated" output)" = 4 ] || { cat output; fail "damages are not named"; }
  for file in n.csv n.svg maps/a.h5 maps/a.xdmf; do cmp whole/$file R3/$file || fail "$file after: $damage"; done
  ends 0 "there is nothing to resume" "$program" run --resume R3
done
for file in journal.jsonl; do
  for damage in ": >" "rm -f" "sed -i 's/0x0/0/;2s/1/2/'"; do
    rm -rf R3
    cp -r whole R3
    eval "$damage R3/$file"
    ends 0 "every file is again as it was recorded" "$program" run --resume R3
    ends 0 "there is nothing to resume" "$program" run --resume R3
  done
done
echo 'require "asperity".notebook "n":write{ t = os.time() + os.clock() }' > clock.lua
"$program" run clock.lua --out clock 2> /dev/null
: > clock/n.csv
ends 1 'could not be restored as recorded' "$program" run --resume clock

# What died before its first manifest begins again.
mkdir R4
printf 'half' > R4/script.lua
printf '{"n":1,"event":"begin"}\n' > R4/journal.jsonl
cp -r R4 R4-out
ends 2 "to resume" "$program" run --resume R4
ends 0 "results in" "$program" run short.lua --resume R4
done_run R4
ends 0 "results in" "$program" run short.lua --out R4-out
cmp R4-out/script.lua short.lua
for handles in 3 4 5 6 7 8 10 14; do
  (ulimit -n $handles; "$program" run short.lua --threads 1 --out R4-$handles) > /dev/null 2>&1 || true
  "$program" run short.lua --resume R4-$handles > output 2>&1 || { cat output; fail "with $handles handles"; }
  cmp R4/n.csv R4-$handles/n.csv
done

# Killed at each of its first calls of the system that leave a trace.
if command -v strace > /dev/null 2>&1 && strace -f -o /dev/null true 2> /dev/null; then
  for call in fcntl:1 fcntl:2 ftruncate:1 pwrite64:1 write:1 write:2 write:3 fsync:1 fsync:2 fsync:3 fsync:4 \
    rename:1 rename:2; do
    rm -rf R4-killed
    strace -f -o /dev/null -e inject=${call%:*}:signal=KILL:when=${call#*:} \
      "$program" run short.lua --threads 1 --out R4-killed > /dev/null 2>&1 || true
    "$program" run short.lua --resume R4-killed > output 2>&1 || { cat output; fail "killed at $call"; }
    cmp R4/n.csv R4-killed/n.csv
    done_run R4-killed
  done
else
  echo "run_directory: no strace here: kills at each call are not tried"
fi

# A directory holds its own files and what the manifest lists.
listed() {
  {
    printf '%s\n' script.lua manifest.json journal.jsonl .lock
    sed -n '/"outputs"/,/\]/s/.*"file": "\(.*\)".*/\1/p' "$1/manifest.json"
  } | LC_ALL=C sort > listed.files
  (cd "$1" && find . -type f ! -path './store/*' | sed 's|^\./||' | LC_ALL=C sort) | diff - listed.files ||
    fail "the files of $1 are not those of its manifest"
}
listed whole
listed R3
echo x >> R3/maps/a.xdmf
ends 1 '`maps/a.xdmf` was altered since the run' "$program" replay R3 --out R3-again

# The same picture, or a word.
cat > relief.lua <<'LUA'
require "asperity".surface.sine{ cells = 16, size = 1e-3, amplitude = 1e-6 }:picture("r.png", { view = "relief" })
LUA
if command -v gnuplot > /dev/null 2>&1; then
  "$program" run relief.lua --out relief 2> /dev/null
  for handles in 5 6 7 8 9 10 12; do
    status=0
    (ulimit -n $handles; "$program" run relief.lua --threads 1 --out relief-$handles) > output 2>&1 || status=$?
    if [ $status = 0 ] && ! grep -q "gnuplot" output; then
      cmp relief/r.png relief-$handles/r.png || { cat output; fail "another picture with $handles handles and no word"; }
    fi
  done
fi

# What a killed writer left goes.
rm -rf R10
cp -r whole R10
sed -i 's/"status": "done"/"status": "running"/' R10/manifest.json
mkdir -p R10/store
: > R10/.n.1234-0.part.csv
: > R10/maps/.a.0123abcd-77-0123456789abcdef.part.h5
: > R10/store/.a.0123abcd-77-0123456789abcdef.part.h5
ends 0 "results in" "$program" run --resume R10
[ -z "$(find R10 -name '*.part*')" ] || fail "parts remain"

# Processes of one number in several containers, and one store.
cat > kept.lua <<'LUA'
local lab = require "asperity"
local rows = lab.ensemble{ over = { k = { 1, 2, 3, 4 } }, run = function(case)
  local s = lab.surface.self_affine{ cells = 64, size = 1e-3, hurst = 0.8, ra = 1e-6, short_wave = 1e-4, seed = case.k }
  local t = os.clock() repeat until os.clock() > t + 0.02
  return { ra = s:roughness().Ra }
end }
LUA
if unshare -p -f true 2> /dev/null; then
  for i in 1 2 3 4; do
    unshare -p -f "$program" run kept.lua --threads 1 --store S11 --out ns$i 2> ns$i.err &
    eval "p$i=\$!"
  done
  for i in 1 2 3 4; do eval "ends_with 0 \$p$i"; done
  cat ns?.err | grep "could not be stored" && fail "containers disturb each other"
  [ -z "$(find S11 -name '*.part*')" ] || fail "parts in the store"
else
  echo "run_directory: no name spaces of processes here: several containers at one store are not tried"
fi

# A case is known by what it does.
cat > ens.lua <<'LUA'
local lab = require "asperity"
local rows = lab.ensemble{ over = { k = { 1, 2, 3, 4 } }, run = function(case)
  return { y = require "twice" (case.k) }
end }
LUA
echo 'return function(k) return 2 * k end' > twice.lua
cp ens.lua copy.lua
mkdir there
ln -s "$folder" here
"$program" run ens.lua --store S12 --shard 1/2 --out e0 2> /dev/null
n=0
for named in ./ens.lua "$folder/ens.lua" here/ens.lua copy.lua there/../ens.lua; do
  n=$((n + 1))
  rm -rf S12-$n
  cp -r S12 S12-$n
  "$program" run "$named" --store S12-$n --shard 2/2 --out e$n > output 2>&1 || { cat output; fail "$named"; }
  ! grep -q "2 of 4" output || { cat output; fail "$named does not meet ens.lua"; }
done
(cd there && "$program" run ../ens.lua --store ../S12 --shard 2/2 --out ../e9) > output 2>&1
! grep -q "2 of 4" output || { cat output; fail "from another folder"; }
# Another module beside another script is another case.
mkdir other
cp ens.lua other/
echo 'return function(k) return 3 * k end' > other/twice.lua
sed -i 's/end }$/end } print(rows[1].y)/' ens.lua other/ens.lua
[ "$("$program" run "$folder/ens.lua" --store S12 --out f1 2> /dev/null)" = 2 ] || fail "twice"
[ "$("$program" run "$folder/other/ens.lua" --store S12 --out f2 2> /dev/null)" = 3 ] || fail "a case of another module"

# Signals; then the run goes on.
for signal in INT:130 TERM:143 HUP:129; do
  name=${signal%:*}
  rm -rf "R14-$name"
  env "$program" run wait.lua --out "R14-$name" 2> /dev/null &
  process=$!
  until_true lines "R14-$name/n.csv" 21
  kill -"$name" $process
  ends_with "${signal#*:}" $process
  grep -q '"status": "interrupted"' "R14-$name/manifest.json" || fail "$name: the manifest does not say so"
done
nohup "$program" run wait.lua --out R14-nohup > /dev/null 2>&1 &
process=$!
until_true lines R14-nohup/n.csv 21
kill -HUP $process
# A journal that is taken away under way.
"$program" run wait.lua --out R14-journal 2> journal.err &
other=$!
until_true lines R14-journal/n.csv 21
rm R14-journal/journal.jsonl
touch go
ends_with 0 $process
done_run R14-nohup
ends_with 1 $other
says "was removed while the run wrote it" journal.err
for run in R14-INT R14-TERM R14-HUP R14-journal; do
  ends 0 "results in" "$program" run --resume $run
  cmp R1/n.csv $run/n.csv
done
rm go
# One with zeros in its middle.
cp -r R1 R14-zeros
dd if=/dev/zero of=R14-zeros/journal.jsonl bs=1 seek=200 count=100 conv=notrunc 2> /dev/null
ends 2 "--reuse R14-zeros" "$program" replay R14-zeros --out R14-zeros-again
cp -r R14-zeros R14-cut
sed -i 's/"status": "done"/"status": "running"/' R14-cut/manifest.json
touch go
for run in R14-zeros R14-cut; do
  ends 0 "results in" "$program" run --resume $run
  done_run $run
  ends 0 "there is nothing to resume" "$program" run --resume $run
done

# Own files that are links are refused, and nothing is written where they lead.
cp -r R1 S3
sed -i 's/"status": "done"/"status": "interrupted"/' S3/manifest.json
mkdir victims
for own in script.lua manifest.json journal.jsonl; do
  mv S3/$own victims/$own
  cp victims/$own before
  ln -s "$folder/victims/$own" S3/$own
  ends 2 "is a link" "$program" run --resume S3
  cmp before victims/$own || fail "$own was written through a link"
  rm S3/$own
  mv victims/$own S3/$own
done
rm -rf S3/store
ln -s "$folder/victims" S3/store
ends 2 "is a link" "$program" run --resume S3
ends 2 "is a link" "$program" run short.lua --out S3-reuse --reuse S3
[ -z "$(ls victims)" ] || fail "results were written through a link"
echo "run_directory: all is well"

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A record is whole: read errors, loaded script files, files that others remove, a moved directory, a full output.
#
#   tests/scripts/runner/whole_record.sh PROGRAM FOLDER
set -eu
. "$(dirname "$0")/saying.sh"
begin "$@"

# A file that cannot be read is an error and not an empty script, manifest or journal.
if [ -r /proc/self/mem ]; then
  ends 2 "cannot be read to its end" "$program" run /proc/self/mem --out unread
  echo 'require "asperity".notebook "n":write{ x = 1 }' > n.lua
  ends 0 "results in" "$program" run n.lua --out n
  for file in manifest.json journal.jsonl script.lua; do
    rm -rf copy
    cp -r n copy
    ln -sf /proc/self/mem copy/$file
    ends 2 "cannot be read to its end" "$program" replay copy
  done
  ln -s /proc/self/mem broken.lua
  echo 'require "asperity" require "broken"' > loads_broken.lua
  ends 1 "cannot be read to its end" "$program" run loads_broken.lua --out broken
fi

# Script files are inputs with a copy, from which a replay elsewhere and a resumed run load them.
mkdir -p m/a m/data
echo 'return 3' > m/three.lua
printf '#!/usr/bin/lua\nreturn 4' > m/a/b.lua
echo 'return 5' > m/data/five.lua
printf '\357\273\277return { six = 6 }' > m/six.lua
: > m/empty.lua
cat > m/s.lua <<'LUA'
local lab = require "asperity"
local book = lab.notebook "n"
book:write{ x = require "three", y = require "a.b", z = dofile "data/five.lua" }
assert(require "empty" == true)
local own = io.open("made.lua", "w")
own:write "return 7"
own:close()
book:write{ x = assert(loadfile "six.lua")().six, y = dofile "made.lua", z = 0 }
local rows = lab.ensemble{ over = { k = { 1, 2 } }, run = function(case)
  return { v = require "three" + require "only" + require "a.b" + case.k } end }
book:write{ x = rows[1].v, y = rows[2].v, z = 1 }
if arg[1] then error "later" end
LUA
echo 'return 8' > m/only.lua
(cd m && "$program" run s.lua --out r > /dev/null 2>&1) || fail "the run failed"
for file in ./three.lua ./a/b.lua data/five.lua six.lua ./empty.lua ./only.lua; do
  grep -qF "\"file\": \"$file\"" m/r/manifest.json || fail "$file is no input"
done
[ "$(grep -c '"copy": "script_files/' m/r/manifest.json)" = 6 ] || fail "there are not six copies"
ends 0 "the same again" "$program" replay m/r --out elsewhere
ends 0 "the same again" "$program" replay elsewhere --out once-more
ends 0 "nothing to resume" "$program" run --resume m/r
cd m
cp -r r cut
sed -i 's/"status": "done"/"status": "running"/' cut/manifest.json
head -n 3 r/journal.jsonl > cut/journal.jsonl
echo 'return 30' > three.lua
echo 'return 80' > only.lua
ends 0 'three.lua" has changed since the run loaded it' "$program" replay r --out again
ends 0 "the same again" "$program" replay r --out again2
ends 0 'only.lua" has changed since the run loaded it' "$program" run --resume r
ends 0 'three.lua" has changed since the run loaded it' "$program" run --resume cut
cmp r/n.csv cut/n.csv
ends 0 "the same again" "$program" replay cut --out cut-again
rm three.lua only.lua
ends 0 "the same again" "$program" replay r --out without
cp -r r damaged
copy=$(ls damaged/script_files/three-*)
echo x >> "$copy"
ends 1 "was altered since the run" "$program" replay damaged --out damaged-again
rm "$copy"
echo 'return 3' > three.lua
ends 0 "every file is again as it was" "$program" run --resume damaged
cmp "$copy" three.lua
rm -rf damaged
cp -r r damaged
sed -i 's|"copy": "script_files/three|"copy": "../r/script_files/three|' damaged/manifest.json
ends 1 "is missing from the run" "$program" replay damaged --out damaged-again2
echo 'require("asperity").notebook "script_files/x":write{ a = 1 } io.open("script_files/y", "w")' > own.lua
ends 1 "belongs to the run itself" "$program" run own.lua --out own
cd ..

# What others remove or alter while the run goes on fails it, and --resume mends it.
cat > g.lua <<'LUA'
local lab = require "asperity"
lab.surface.sine{ cells = 16, size = "1 mm", amplitude = "1 um" }:write "map.h5"
lab.notebook "n":write{ x = 1 }
local kept = io.open("kept.txt", "w") kept:write "kept" kept:close()
io.open("gone.txt", "w"):close() os.remove "gone.txt"
io.open("old.txt", "w"):close() os.rename("old.txt", "new.txt")
print(pcall(function() lab.surface.sine{ cells = 16, size = 1, amplitude = 1 }:write "no.format" end))
print "ready" io.stdout:flush()
local go repeat go = io.open "go" until go
LUA
begin() {
  rm -f go out
  "$program" run g.lua --out "$1" > out 2> err &
  child=$!
  until_true grep -q ready out
}
end() {
  : > go
  status=0
  wait $child || status=$?
  [ $status = "$1" ] || { cat err; fail "status $status instead of $1"; }
}
begin plain; end 0
grep -q gone.txt plain/manifest.json && fail "a file that the script removed is listed"
begin d; rm d/map.h5 d/n.csv d/kept.txt; end 1
grep -q '`kept.txt`, `map.h5` and `n.csv` were removed' err || { cat err; fail "no names"; }
ends 0 "results in" "$program" run --resume d
cmp d/map.h5 plain/map.h5
ends 0 "nothing to resume" "$program" run --resume d
begin e; rm e/script.lua; end 1
grep -q 'script.lua` was altered or removed' err || { cat err; fail "no word of the script"; }
ends 0 "results in" "$program" run --resume e
begin f; echo '{"n":99}' >> f/journal.jsonl; end 1
grep -q 'journal.jsonl` was altered' err || { cat err; fail "no word of the journal"; }
ends 0 "results in" "$program" run --resume f
ends 0 "the same again" "$program" replay f --out f-again

# A directory that is moved under way is no reason for a second one.
begin moved; mv moved elsewhere-now; end 1
grep -q 'was moved or removed' err || { cat err; fail "no word of the move"; }
[ ! -e moved ] || fail "a second directory"
ends 0 "results in" "$program" run --resume elsewhere-now
cmp elsewhere-now/map.h5 plain/map.h5

# Standard output that takes no more; a reader that goes away is no failure.
if [ -w /dev/full ]; then
  echo 'print "lost"' > pr.lua
  status=0
  "$program" run pr.lua --out full > /dev/full 2> err || status=$?
  [ $status = 1 ] && grep -q "standard output could not be written" err || { cat err; fail "a full disk was passed over"; }
  echo 'print "lost" os.exit(0)' > ex.lua
  "$program" run ex.lua --out full-exit > /dev/full 2> err && fail "a full disk was passed over by os.exit"
fi
echo 'for k = 1, 1e5 do print(k) end' > many.lua
("$program" run many.lua --out many 2> err; echo $? > status) | head -n 1 > /dev/null
[ "$(cat status)" = 0 ] || { cat err; fail "a reader that went away failed the run"; }

# Few handles are told on standard error and are no line of the journal.
(ulimit -n 24; "$program" run n.lua --out few) > output 2>&1 || true
grep -q "only 24 files" output || { cat output; fail "no word of few handles"; }
cmp few/journal.jsonl n/journal.jsonl
mkdir -p locked/.lock
ends 2 "is a folder, and the lock" "$program" run --out locked n.lua
echo "passed"

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A journal replaced by a link to another user's file and a store replaced by a link to a folder are refused, and nothing is
# written there. A copy by hard links is a separate run and leaves the original unchanged. A pipe in place of a file never
# blocks the program.
set -eu
. "$(dirname "$0")/beginning.sh"
echo 'local b = require "asperity".notebook "n" b:write{ a=1 } error "half-way"' > n.lua
"$program" run n.lua --out h0 > /dev/null 2>&1 || true
cp -a h0 hx
cp hx/journal.jsonl vic
cp vic before
rm hx/journal.jsonl
ln -s "$PWD/vic" hx/journal.jsonl
ends 2 "is a link" "$program" run --resume hx
cmp before vic
mkdir elsewhere
cp -a h0 hs
rm -rf hs/store
ln -s "$PWD/elsewhere" hs/store
ends 2 "is a link" "$program" run --resume hs
[ -z "$(ls elsewhere)" ] || fail "results were written elsewhere"
for file in journal.jsonl manifest.json script.lua; do
  cp -a h0 hp
  rm "hp/$file"
  mkfifo "hp/$file"
  ends 2 "$file" timeout 600 "$program" run --resume hp
  ends 2 "$file" timeout 600 "$program" replay hp
  rm -rf hp
done
sed -i 's/b:write{ a=1 }/b:write{ a=1 } b:write{ a=os.getenv "ROW" }/' n.lua
ROW=2 "$program" run n.lua --out o > /dev/null 2>&1 || true
cp -a o kept
cp -al o copy
ROW=3 "$program" run --resume copy > output 2>&1 || true
grep -q '"a":"\?3' copy/journal.jsonl || { cat output copy/journal.jsonl; fail "the copy was not taken up"; }
diff -r --exclude=.lock o kept > output || { cat output; fail "the run that was copied changed along"; }

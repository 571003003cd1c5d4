#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# TERM and HUP end a run with their own status, which the manifest records. A small limit is printed in its own unit. A
# journal with zeros in its middle is refused with a way to recover its results.
set -eu
. "$(dirname "$0")/beginning.sh"
cat > wait.lua <<'LUA'
local b = require "asperity".notebook "n"
for k = 1, 20 do b:write{ k=k } end
repeat local go = io.open "go" until go
LUA
for signal in TERM:143 HUP:129; do
  name=${signal%:*}
  env "$program" run wait.lua --out R-$name > /dev/null 2>&1 &
  process=$!
  rows_there() { [ "$(wc -l < R-$name/n.csv)" = 21 ]; }
  until_true rows_there
  kill -$name $process
  status=0
  wait $process || status=$?
  [ $status = ${signal#*:} ] || fail "$name ends with $status"
  says '"status": "interrupted"' R-$name/manifest.json
done

echo 'local t = {} while true do t[#t + 1] = { #t } end' > much.lua
ends 1 "3 MiB" "$program" run --limit-memory 3M much.lua

touch go
"$program" run wait.lua --out R 2> /dev/null
dd if=/dev/zero of=R/journal.jsonl bs=1 seek=200 count=100 conv=notrunc 2> /dev/null
ends 2 "--reuse R" "$program" replay R --out again
ends 0 "results in" "$program" run --out R2 wait.lua --reuse R
cmp R/n.csv R2/n.csv

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A run that died before its first manifest, by a full disk or a kill, does not block its name.
set -eu
. "$(dirname "$0")/beginning.sh"
echo 'require "asperity".notebook "n":write{ a=1 }' > s.lua
mkdir R
cp s.lua R/script.lua
echo '{"n":1,"event":"begin"}' > R/journal.jsonl
cp -r R R-out
ends 0 "results in" "$program" run --resume R s.lua
says '"status": "done"' R/manifest.json
ends 0 "results in" "$program" run --out R-out s.lua
cmp R/n.csv R-out/n.csv

(ulimit -n 4; "$program" run --out U s.lua) > /dev/null 2>&1 || true
ends 0 "results in" "$program" run --resume U s.lua
cmp R/n.csv U/n.csv

mkdir t
if [ "$(id -u)" = 0 ] && mount -t tmpfs -o size=8k tmpfs t 2> /dev/null; then
  trap 'cd /; umount "$folder/t" 2> /dev/null || true' EXIT
  "$program" run --out t/run s.lua > /dev/null 2>&1 && fail "a disk of 8 KiB was enough"
  mount -o remount,size=64m t
  ends 0 "results in" "$program" run --resume t/run s.lua
  cmp R/n.csv t/run/n.csv
else
  echo "no file system can be mounted here: a full disk is not tried"
fi

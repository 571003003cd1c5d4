#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# S3: a journal that was made a link to somebody's file, and a store that was made a link to a folder, are refused; nothing
# is written there.
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

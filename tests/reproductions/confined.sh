#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A script of others behind barriers: it reads the folders that are named, follows no links, forks nothing, reaches
# no network and no home folder; resume and replay of it are confined too.
set -eu
. "$(dirname "$0")/beginning.sh"
mkdir theirs other
echo secret > other/secret.txt
ln -s ../other/secret.txt theirs/link.txt
echo data > theirs/own.txt
cat > theirs/s.lua <<'LUA'
local b = require "asperity".notebook "n"
local function reads(name) local file = io.open(name) return file and 1 or 0 end
b:write{ own=reads "theirs/own.txt", link=reads "theirs/link.txt", other=reads "other/secret.txt", users=reads "/etc/passwd" }
LUA
status=0
"$program" run --confined theirs/s.lua --out R > output 2>&1 || status=$?
! grep -q "lacks barriers" output || skip "this system lacks a barrier"
[ $status = 0 ] || { cat output; fail "it ended with $status"; }
printf 'link,other,own,users\n0,0,0,0\n' | cmp - R/n.csv
ends 0 "the same again" "$program" replay R --out R-again
"$program" run --confined --read theirs theirs/s.lua --out R1 2> /dev/null
printf 'link,other,own,users\n0,0,1,0\n' | cmp - R1/n.csv
"$program" run --confined --read theirs --read other theirs/s.lua --out R2 2> /dev/null
printf 'link,other,own,users\n1,1,1,0\n' | cmp - R2/n.csv

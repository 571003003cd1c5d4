#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Files that are no texts: a fifo is refused and not waited for, and a binary script is refused with its name.
set -eu
. "$(dirname "$0")/beginning.sh"
mkfifo pipe
echo 'local file, why = io.open "pipe" error(file and "opened" or why)' > fifo.lua
status=0
timeout 600 "$program" run fifo.lua > output 2>&1 || status=$?
[ $status = 1 ] || { cat output; fail "a fifo ends with $status"; }
says pipe output
printf '\033Lua binary' > binary.lua
ends 1 binary.lua "$program" run binary.lua

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A run that exceeds its limit of time or memory names the running line, with a traceback.
set -eu
. "$(dirname "$0")/beginning.sh"
printf 'local k = 0\nwhile true do end\n' > endless.lua
ends 1 "endless.lua:2: " "$program" run --trace --limit-time "$(whole 5s 300ms)" endless.lua
says "endless.lua:2: in main chunk" output
printf 'local t = {}\nfor i = 1, 1e9 do t[i] = i end\n' > much.lua
ends 1 "much.lua:2: " "$program" run --trace --limit-memory "$(whole 1G 48M)" much.lua
says "much.lua:2: in main chunk" output

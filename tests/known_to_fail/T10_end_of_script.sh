#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# T10: a mistake at the end of a script of five lines is marked in line 6. Wanted: in the last line there is. The work on the
# page that is alive owns it.
set -eu
. "$(dirname "$0")/../reproductions/beginning.sh"
printf 'local a = 1\nlocal b = 2\nlocal c = 3\nlocal d = 4\nif a then\n' > five.lua
"$program" check five.lua > output 2>&1 && fail "this was accepted"
says "near <eof>" output
if grep -q "five.lua:6:" output; then
  echo "does not hold: the end of a script is in it: $(cat output)"
else
  echo "holds: the end of a script is in it"
fi

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# docs/asperity.bash in a shell: what stands on the command line, and what is offered for it.
#
#   tests/scripts/runner/completion.sh ASPERITY.BASH FOLDER
set -eu
. "$(dirname "$0")/saying.sh"
. "$1"
rm -rf "$2"
mkdir -p "$2/runs"
cd "$2"
touch first.lua notes.txt

# wanted word...: what is offered for the last word.
offers() {
  wanted=$1
  shift
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  _asperity
  [ "${COMPREPLY[*]}" = "$wanted" ] || fail "$*: offered '${COMPREPLY[*]}', not '$wanted'"
}
offers "run replay repl" asperity r
offers "--resume --reuse --read" asperity run --re
offers "first.lua runs" asperity run ""
offers "runs" asperity run first.lua --out ""
offers "" asperity run --threads ""
offers "turning tilt" asperity lesson t
offers "--json" asperity explain first.lua --j

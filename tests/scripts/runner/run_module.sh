#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# run_module.sh LUA MODULE SCRIPT LIBRARIES: runs a script in Debian's own interpreter with the loadable
# module, the libraries in it first (a:b, or ""). Succeeds if the script does and nothing is said on standard error.
lua=$1 module=$2 script=$3 libraries=$4
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 2
if [ -n "$libraries" ]; then
  export LD_PRELOAD="$libraries"
fi
LUA_CPATH="$(dirname "$module")/?.so" "$lua" "$script" one two 2>"$folder/error"
status=$?
unset LD_PRELOAD
if [ -s "$folder/error" ]; then
  cat "$folder/error" >&2
  exit 1
fi
exit $status

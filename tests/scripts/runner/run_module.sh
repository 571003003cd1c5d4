#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# run_module.sh LUA MODULE SCRIPT SANITIZED: runs a script in Debian's own interpreter with the loadable
# module. Succeeds if the script does and nothing is said on standard error. A module built with
# sanitizers needs their library in the interpreter first.
lua=$1 module=$2 script=$3 sanitized=$4
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 2
if [ "$sanitized" = 1 ]; then
  LD_PRELOAD=$(${CXX:-c++} -print-file-name=libasan.so):$(${CXX:-c++} -print-file-name=libubsan.so)
  export LD_PRELOAD
fi
LUA_CPATH="$(dirname "$module")/?.so" "$lua" "$script" one two 2>"$folder/error"
status=$?
unset LD_PRELOAD
if [ -s "$folder/error" ]; then
  cat "$folder/error" >&2
  exit 1
fi
exit $status

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs one hard case and writes its page and its row of docs/stability.md into a folder. The error stream must hold what the
# head of the script says in lines `--! error: TEXT`.
# usage: run_case.sh PROGRAM SCRIPT FOLDER
set -eu
rm -rf "$3"
mkdir -p "$(dirname -- "$3")"
status=0
"$1" run --out "$3" "$2" 2>"$3.errors" || status=$?
cat "$3.errors" >&2
sed -n 's/^--! error: //p' "$2" | while IFS= read -r text; do
  grep -qF -- "$text" "$3.errors" || {
    echo "the error stream does not hold: $text" >&2
    exit 1
  }
done
exit "$status"

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The twenty scripts that were written from docs/card.md alone still run to their end: tasks.md.
#
#   tests/card/run.sh PROGRAM FOLDER
set -eu
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../scripts/runner/saying.sh"
begin "$1" "$2"
cp "$here"/*.lua "$here"/*.csv .
ends 0 "results in" "$program" run --out made data.lua
cp made/*.csv .
for task in [0-9][0-9].lua; do
  ends 0 "results in" "$program" run --out "${task%.lua}" "$task"
done

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The numbers of numbers.lua are those of numbers.csv.
#
#   numbers.sh PROGRAM FOLDER [--write]    the program; an empty place for its run; record the numbers anew
set -eu
program=$(realpath "$1") place=$(realpath -m "$2")
cd "$(dirname -- "$0")"
rm -rf "$place"
if [ "${3:-}" = --write ]; then
  "$program" run --out "$place" numbers.lua -- write > numbers.csv
else
  "$program" run --out "$place" numbers.lua -- numbers.csv
fi

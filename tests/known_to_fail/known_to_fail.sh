#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a file of claims, and fails, as CTest expects of it, only if the file ended well and each of its claims does not
# hold. A claim that holds, a file without one, and a file that does not come to its end, are all an exit status of 0,
# which CTest tells as a failure; 77 is a test that cannot be run here.
#
#   tests/known_to_fail/known_to_fail.sh PROGRAM FILE FOLDER
set -eu
program=$(readlink -f -- "$1")
file=$(readlink -f -- "$2")
folder=$3
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
status=0
case $file in
  *.lua) "$program" run "$file" --out run > output 2> errors || status=$? ;;
  *.sh) sh "$file" "$program" "$folder/there" > output 2> errors || status=$? ;;
  *.py) python3 -B "$file" "$program" "$folder/there" > output 2> errors || status=$? ;;
esac
cat output errors
[ $status != 77 ] || exit 77
if [ $status != 0 ]; then
  echo "known_to_fail: it ended with $status, so that nothing is known of its claims"
  exit 0
fi
if grep -q "^holds: " output; then
  echo "known_to_fail: a claim holds now: take it to tests/reproductions"
  exit 0
fi
if ! grep -q "^does not hold: " output; then
  echo "known_to_fail: no claim was made"
  exit 0
fi
exit 1

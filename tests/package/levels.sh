#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A program with numeric code for several levels of processor (ASPERITY_LEVELS). At each level that this processor
# supports, the loader takes the library of that level, and the results are the recorded ones, bit for bit. No library
# contains vfmaddsub or vfmsubadd: g++ 12 uses them in spite of -ffp-contract=off, and they round once instead of twice.
#
#   tests/package/levels.sh PROGRAM FOLDER
set -eu
. "$(dirname "$0")/../scripts/runner/saying.sh"
program=$(realpath "$1")
folder=$2
runner=$(cd "$(dirname "$0")/../scripts/runner" && pwd)
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"

# LEVEL BYTES GLIBC_TUNABLES: the loader ignores a level when an instruction set of the level is masked.
at_level() {
  GLIBC_TUNABLES=$3 "$program" version > version
  says "vectors   $2 bytes ($1)" version
  GLIBC_TUNABLES=$3 "$program" run "$runner/processors.lua" --out "run-$1" > "digests-$1"
  diff -u "$runner/processors.txt" "digests-$1" || fail "$1: the results differ from the recorded ones"
  echo "levels: $1: the recorded results, vectors of $2 bytes"
}
supports() { /lib64/ld-linux-x86-64.so.2 --help | grep -qF "$1 (supported" || { echo "levels: $1: not supported here"; false; }; }

at_level x86-64 16 glibc.cpu.hwcaps=-AVX2
if supports x86-64-v3; then at_level x86-64-v3 32 glibc.cpu.hwcaps=-AVX512F; fi
if supports x86-64-v4; then at_level x86-64-v4 64 ""; fi

library=$(ldd "$program" | sed -n 's/.*=> \(.*libasperity-numeric[^ ]*\).*/\1/p')
base=$(dirname "$library")
base=${base%/glibc-hwcaps/*}
for copy in "$base" "$base/glibc-hwcaps/x86-64-v3" "$base/glibc-hwcaps/x86-64-v4"; do
  objdump -d --no-show-raw-insn "$copy/$(basename "$library")" > code
  grep -E 'vfm(addsub|subadd)' code > found && { head -n 5 found; fail "$copy: a product and a sum are rounded once"; }
done
rm code

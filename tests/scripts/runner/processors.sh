#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# One of each kind of result is the same bits on a processor without wide vectors and fused operations (as the
# C library sees it), in any build of any compiler, for any number of threads: the digests are those in
# tests/scripts/runner/processors.txt. And where a result does hang on the C library, because the script itself takes
# a sine of it, replay names that beside the differences.
#
#   tests/scripts/runner/processors.sh PROGRAM FOLDER            compares
#   tests/scripts/runner/processors.sh PROGRAM FOLDER --write    writes the digests anew
set -eu
. "$(dirname "$0")/saying.sh"
scripts=$(cd "$(dirname "$0")/.." && pwd)
begin "$@"

# What the C library takes for a processor of 2010. Of another library or processor it is ignored.
masked() {
  GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F,-AVX512VL,-AVX2_Usable,-FMA_Usable,-FMA4_Usable "$@"
}

"$program" run "$scripts/runner/processors.lua" --out run --threads 1 > digests
if [ "${3:-}" = --write ]; then
  cp digests "$scripts/runner/processors.txt"
  exit 0
fi
alike() { diff -u "$1" "$2" > difference || { cat difference; fail "$3"; }; }
alike "$scripts/runner/processors.txt" digests "these results are others than recorded"
masked "$program" run "$scripts/runner/processors.lua" --out masked --threads 2 > digests.masked
alike digests digests.masked "these results hang on the processor"
masked "$program" replay run --out again > printed || { cat printed; fail "the replay differs"; }

# A run of elementary functions and transforms.
cat > det.lua <<'LUA'
local lab = require "asperity"
print(lab.surface.self_affine{ cells=64, size="1 mm", hurst=0.8, ra="1 um", short_wave="50 um", seed=1 }.digest)
LUA
"$program" run det.lua --out RD > /dev/null
ends 0 "the same again" masked "$program" replay RD --out RD-again

# A script whose own numbers hang on the C library: its replay says what is another here.
cat > own.lua <<'LUA'
local lab = require "asperity"
local book = lab.notebook "own"
for k = 1, 3000 do
  book:write{ sine = math.sin(k * 0.37), power = (1 + k / 1000) ^ 1.7, exponential = math.exp(k / 300) }
end
LUA
"$program" run own.lua --out own > /dev/null
masked "$program" run own.lua --out own-masked > /dev/null
if cmp -s own/own.csv own-masked/own.csv; then
  echo "the C library rounds alike on both: nothing to name"
else
  ends 1 "recorded on another rounding of the C library's functions" masked "$program" replay own --out own-again
fi

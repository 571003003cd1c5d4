#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds the fuzzing targets and runs each for a while from its corpus, one per processor. Stops at the first crash,
# failed requirement, leak, time-out or excess of memory, stores the input and prints the command to repeat it. The
# build folder stores grown corpora for the next run.
# usage: run.sh [--seconds N] [--build FOLDER] [--jobs N] [--floors "core statistics surface recording bindings"] [TARGET...]
set -eu
cd "$(dirname -- "$0")/../.."

seconds=10 build=build/sanitize jobs=$(nproc) targets= floors="core statistics surface recording bindings" one=
while [ $# -gt 0 ]; do
  case $1 in
    --seconds) seconds=$2; shift 2 ;;
    --build) build=$2; shift 2 ;;
    --jobs) jobs=$2; shift 2 ;;
    --floors) floors=$2; shift 2 ;;
    --one) one=$2; shift 2 ;; # what this script calls itself with
    -*) sed -n 's/^# usage: //p' "$0"; exit 2 ;;
    *) targets="$targets $1"; shift ;;
  esac
done

program_of() { sed -n "s/^$1 //p" "$build/tests/fuzz/programs.txt"; }
if [ -z "$one" ]; then
  [ -f "$build/CMakeCache.txt" ] || cmake --preset sanitize -B "$build" >/dev/null
  cmake "$build" >/dev/null
  if [ -z "$targets" ]; then
    for floor in $floors; do targets="$targets $(sed -n "s/ fuzz_$floor\$//p" "$build/tests/fuzz/programs.txt")"; done
  fi
  programs=
  for target in $targets; do programs="$programs $(program_of "$target")"; done
  cmake --build "$build" --parallel "$jobs" --target $(printf '%s\n' $programs | sort -u) >/dev/null
  printf '%s\n' $targets | xargs -P "$jobs" -I {} "$0" --seconds "$seconds" --build "$build" --one {}
  exit
fi

# The words of the language, from its reference page.
words() {
  sed -n -e 's/^### `\(.*\)`$/"\1"/p' -e 's/^| `\([a-z_A-Z.]*\)` .*/"\1"/p' docs/reference.md
  grep -o '"[a-z_-]*"|' docs/asperity.d.lua | sed 's/|$//'
}

run() {
  target=$1
  program=$build/tests/fuzz/$(program_of "$target")
  place=$build/fuzz/$target
  mkdir -p "$place/corpus"
  set -- "$place/corpus" "tests/fuzz/corpus/$target"
  dictionary=tests/fuzz/dictionaries/$target.txt
  case $target in
    options | script)
      dictionary=$place/dictionary.txt
      words | sort -u >"$dictionary"
      ;;
  esac
  if [ -f "$dictionary" ]; then set -- "-dict=$dictionary" "$@"; fi
  if ASAN_OPTIONS=quarantine_size_mb=32 "$program" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 \
    -malloc_limit_mb=512 -artifact_prefix="$place/" -close_fd_mask=1 -print_final_stats=1 "--target=$target" "$@" \
    </dev/null >/dev/null 2>"$place/log.txt"; then
    awk -v target="$target" '
      / cov: / {
        for (k = 1; k < NF; ++k) {
          if ($k == "cov:") now = $(k + 1)
          if ($k == "corp:") inputs = $(k + 1) + 0
        }
        if (/INITED/) first = now
      }
      /number_of_executed_units/ { runs = $2 }
      /peak_rss_mb/ { memory = $2 }
      END { printf "%-12s %9d runs, coverage %5d -> %5d, %5d inputs, %4d MiB\n", target, runs, first, now, inputs, memory }
    ' "$place/log.txt"
    return
  fi
  found=$(sed -n 's/.*Test unit written to //p' "$place/log.txt" | tail -n 1)
  grep -av '^#[0-9]*[[:space:]]' "$place/log.txt" | tail -n 60
  echo "fuzz_$target found something: ${found:-see above}"
  echo "again: $program --target=$target $found"
  return 1
}
run "$one"

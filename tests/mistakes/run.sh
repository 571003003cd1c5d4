#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Plants mistakes, one at a time, in sources whose errors would pass for results, and counts those that a test finds.
#
#   tests/mistakes/run.sh [--near] [NAME..]     ten mistakes in each of the sources, or in those named; a table
#
# Works in a copy of the tree, build/mistakes, with a build of its own. The tests of the source itself run first, with the
# address sanitizer and the assertions of the standard library, as in .ci/run; if they find nothing, the whole test
# program of the room runs (not with --near). A mistake that does not compile does not count. survivors.txt gives a reason
# for each mistake that no test finds. Fails if fewer than 55 of 60 are found, or a survivor has no reason.
set -euo pipefail
cd "$(dirname -- "$0")/../.."
seed=1 each=10 least=55
export LC_ALL=C.UTF-8 PYTHONDONTWRITEBYTECODE=1

# NAME SOURCE TESTS-OF-THE-SOURCE TEST-PROGRAM-OF-THE-ROOM
rooms="junction_law engine/friction/junction_law.cpp tests/friction/junction_law_test.cpp,tests/friction/interlocking_test.cpp friction
load_projection engine/contact/elasticity/half_space/solver/load_projection.cpp tests/contact/half_space/load_projection_test.cpp contact
yield_law engine/contact/yield_law.hpp tests/contact/yield_law_test.cpp contact
refinement engine/metrology/registration/refinement.cpp tests/metrology/refinement_test.cpp metrology
table_reader engine/statistics/table_reader.cpp tests/statistics/table_reader_test.cpp statistics
result_log engine/core/files/result_log.cpp tests/run/result_log_test.cpp run"

git rev-parse --git-dir > /dev/null 2>&1 || { echo "skipped: no Git repository names the sources"; exit 77; }
near=
[ "${1:-}" != --near ] || { near=yes; shift; }
chosen=${*:-$(cut -d' ' -f1 <<< "$rooms" | xargs)}

root=$PWD tree=$PWD/build/mistakes/source build=$PWD/build/mistakes/source/build/release objects=$PWD/build/mistakes/near
survivors=$root/tests/mistakes/survivors.txt
export CCACHE_BASEDIR=$tree
mkdir -p "$tree" "$objects"

# -- The copy and its build: each source in an object of its own, which can take the place of the library's ---------------
unfinished=$(cat "$build/planted" 2> /dev/null || true)
find "$tree" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} +
{ git ls-files -z --cached --others --exclude-standard | xargs -0 ls -d 2> /dev/null || true; } |
  xargs cp -a --parents -t "$tree"
# An interrupted run has left objects of a mistake.
[ -z "$unfinished" ] || touch "$tree/$unfinished" "$tree/${unfinished%.cpp}".*
if [ ! -f "$build/build.ninja" ]; then
  # shellcheck disable=SC2016  # CMake's variable
  echo 'cmake_language(DEFER CALL set_source_files_properties ${ASPERITY_ALONE} DIRECTORY engine
    PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)' > "$objects/alone.cmake"
  (cd "$tree" && cmake -G Ninja --preset release -DASPERITY_WARNINGS_AS_ERRORS=ON -DCMAKE_UNITY_BUILD=ON \
    -DCMAKE_UNITY_BUILD_BATCH_SIZE=24 -DASPERITY_TEST_SHARDS=4 -DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld \
    -DCMAKE_PROJECT_asperity_INCLUDE="$objects/alone.cmake" \
    -DASPERITY_ALONE="$(cut -d' ' -f2 <<< "$rooms" | paste -sd';')" > /dev/null)
fi
# ninja_ TARGETS..: quietly
ninja_() { ninja -C "$build" -j "${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" "$@" > "$build/mistakes.log" 2>&1 < /dev/null; }
# libraries ROOM: the libraries of its test program.
libraries() { sed -n "/^build tests\/test_$1: /,/^$/s/^ *LINK_LIBRARIES = //p" "$build/build.ninja"; }
# shellcheck disable=SC2046  # a list of words
ninja_ $(cut -d' ' -f4 <<< "$rooms" | while read -r room; do libraries "$room"; done | grep -o 'engine/[^ ]*' | sort -u) ||
  { tail -n 20 "$build/mistakes.log"; exit 2; }

flags="-std=c++20 -O1 -fPIC -march=native -ffp-contract=off -Wall -Wextra -Wconversion -Wno-sign-conversion -Wno-restrict
  -Werror -D_GLIBCXX_ASSERTIONS -fsanitize=address -DEIGEN_DONT_PARALLELIZE -I$tree -isystem /usr/include/eigen3"
launcher=$(command -v ccache || true)
# object SOURCE: compiles one source.
object() {
  # shellcheck disable=SC2086  # lists of words
  $launcher c++ $flags "-DASPERITY_TEST_DATA=\"$tree/tests/reference\"" -c "$tree/$1" -o "$objects/$(basename "$1").o"
}
# near SOURCE TESTS ROOM: runs the tests of a source alone, and prints the case that failed, `-`, or `none` without a build.
near() {
  local own= file
  if [[ $1 != *.hpp ]]; then  # a header is compiled with its test
    own=$objects/$(basename "$1").o
    object "$1" 2> "$objects/log" || { echo "none"; return; }
  fi
  for file in ${2//,/ }; do
    own+=" $objects/$(basename "$file").o"
    object "$file" 2> "$objects/log" || { echo "none"; return; }
  done
  object tests/support/open_files.cpp
  # shellcheck disable=SC2046,SC2086  # lists of words
  (cd "$build" && c++ -fuse-ld=lld -fsanitize=address $own \
    "$objects/open_files.cpp.o" $(libraries "$3") -lpthread -o tests/test_near) 2> "$objects/log" ||
    { echo "none"; return; }
  tried "its own" 60 "$build/tests/test_near"
}
# tried WHOSE SECONDS PROGRAM..: runs tests until one fails; a mistake that takes all memory or never ends is found.
tried() {
  local whose=$1 seconds=$2
  shift 2
  local bound='ulimit -v 16000000'
  [ "$whose" != "its own" ] || bound='export ASAN_OPTIONS=hard_rss_limit_mb=8000:detect_leaks=0'
  if ($bound; timeout "$seconds" "$@" --gtest_brief=1 --gtest_fail_fast) > "$objects/tests.log" 2>&1 < /dev/null; then
    echo "-"
  else
    echo "$whose: $(grep -m 1 -o 'FAILED  \] [^ ,]*' "$objects/tests.log" | cut -c11- | grep . || echo "a crash, or no end")"
  fi
}

# -- The mistakes ----------------------------------------------------------------------------------------------------------
planted=0 found=0 unknown=0
printf '%-16s %-8s %-26s %s\n' source kind line "found by"
while read -r name source test room; do
  [[ " $chosen " == *" $name "* ]] || continue
  [ "$(near "$source" "$test" "$room")" = - ] ||
    { echo "$name: its tests fail without a mistake"; cat "$objects/log" "$objects/tests.log"; exit 2; }
  count=0
  for ((n = 0; count < each; ++n)); do
    IFS=$'\t' read -r kind line old new < <(cd "$tree" && python3 "$root/tests/mistakes/plant.py" "$seed" "$source" "$n" --apply)
    result=$(near "$source" "$test" "$room")
    if [ "$result" = - ] && [ -z "$near" ]; then
      echo "$source" > "$build/planted"
      ninja_ "test_$room" && result=$(tried "the room" 1200 "$build/tests/test_$room") || result=none
    fi
    # Restores the source and, if it was built, the library; ninja compares times, so the copy gets a new one.
    for file in "$source" "${source%.cpp}.hpp"; do [ ! -f "$file" ] || cp "$file" "$tree/$file"; done
    [ ! -f "$build/planted" ] || { ninja_ "test_$room"; rm "$build/planted"; }
    [ "$result" != none ] || continue
    count=$((count + 1)) planted=$((planted + 1))
    printf '%-16s %-8s %-26s %s\n' "$name" "$kind" "$line" "$result"
    [ "$result" = - ] || { found=$((found + 1)); continue; }
    printf '    %s\n    %s\n' "$old" "$new"
    reason=$(grep -F "$name: $old => $new -- " "$survivors" || true)
    [ -n "$reason" ] || { unknown=$((unknown + 1)); reason="-- no reason in survivors.txt"; }
    printf '    %s\n' "${reason#*-- }"
  done
done <<< "$rooms"
printf '%d of %d found; %d survivors without a reason\n' "$found" "$planted" "$unknown"
[ "$unknown" = 0 ] && [ $((planted - found)) -le $((6 * each - least)) ]

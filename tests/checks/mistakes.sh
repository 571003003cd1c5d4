#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Eleven deliberate mistakes, each in a clone of what is committed, and whether the short run of the room it is in finds it:
# .ci/run must fail at the step named, in words that name the mistake. By hand, not by CTest: each is a build and its tests.
# Prints for each what was selected, the step that failed, and the seconds it took.
#
#   mistakes.sh FOLDER [NAME..]
set -euo pipefail
cd "$(dirname -- "$0")/../.."
folder=$1
shift
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
clone=$folder/clone
[ -d "$clone" ] || git clone -q . "$clone"
ln -sfn "$PWD/../shared" "$folder/shared"
base=$(git -C "$clone" rev-parse HEAD)

# mistake NAME FILE SED-SCRIPT STEP TEXT: made in FILE; the run fails at STEP, and says TEXT.
missed=0 wanted=" $* "
mistake() {
  local name=$1 file=$2 change=$3 step=$4 text=$5 begun=$SECONDS log=$folder/$1.log
  [ "$wanted" = "  " ] || [[ $wanted == *" $name "* ]] || return 0
  git -C "$clone" reset -q --hard "$base"
  sed -i "$change" "$clone/$file"
  git -C "$clone" diff --quiet && { echo "$name: nothing was changed in $file"; missed=$((missed + 1)); return 0; }
  git -C "$clone" -c user.name=mistake -c user.email=mistake@localhost commit -q -a -m "$name"
  if (cd "$clone" && .ci/run --since "$base") > "$log" 2>&1 < /dev/null; then
    echo "$name: NOT FOUND"
    missed=$((missed + 1))
  elif grep -qxF "failed: $step" "$log" && grep -aqE -- "$text" "$log"; then
    printf '%-22s found in %4d s by: %s\n' "$name" $((SECONDS - begun)) "$step"
  else
    echo "$name: the run failed, and not at \`$step\` with \`$text\`: $log"
    missed=$((missed + 1))
  fi
  git -C "$clone" reset -q --hard "$base"
}

mistake format engine/metrology/roughness.cpp 's/^namespace asperity {$/namespace asperity   {/' \
  "layout and include direction" "roughness.cpp"
mistake upward engine/core/digest.cpp 's|^#include "engine/core/digest.hpp"$|&\n\n#include "engine/contact/plan.hpp"|' \
  "layout and include direction" "engine/core does not see engine/contact"
mistake knot engine/core/files/source_file.cpp \
  's|^#include "engine/core/files/text_encoding.hpp"$|&\n#include "engine/core/files/text_table.hpp"|' \
  "layout and include direction" "circle: engine/core/files/source_file -> engine/core/files/text_table"
mistake stale docs/reference.md '0,/^### `lab\.surface\.sine`/s/^### `lab\.surface\.sine`/&!/' \
  "its tests" "checks:generated.*Failed"
mistake race engine/run/ledger.cpp '/^void Ledger::add(std::string_view/,/^}/{/scoped_lock/d}' \
  "its tests, with the thread sanitizer" "data race"
mistake overread engine/surface/io/hdf5_reader/binary_cursor.cpp \
  '/^std::string_view BinaryCursor::take/a\  const volatile char beyond = bytes_.data()[bytes_.size() + 40];\n  static_cast<void>(beyond);' \
  "its tests, with sanitizers" "heap-buffer-overflow"
mistake example examples/stylus_and_tip.lua 's/short_wave = short_wave/short_waves = short_wave/' \
  "its tests" "examples: stylus_and_tip.*Failed"
mistake digest engine/core/digest.cpp "s/raw('i', 1,/raw('d', 1,/" \
  "its tests" "FAILED.*Digest"
mistake package lab 's/ libzip-dev / /' \
  "a newcomer's first chart in a clean root (beside the others)" "libzip"
mistake lesson scripts/lessons/01_roughness.lua 's/ra="0.5 um"/ra="0.5 mm"/' \
  "its tests" "lessons: 01_roughness.*Failed"
mistake descriptor engine/run/journal.cpp 's/^  if (descriptor_ >= 0) ::close(descriptor_);$//' \
  "its tests" "was left open"
[ $missed = 0 ] || exit 1
echo "every mistake was found"

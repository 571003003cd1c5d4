#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Every public name of the language: functions, fields and keys of asperity.d.lua. A name that is removed or added changes names.txt
# in the same commit.
#
#   names.sh [--write]
set -eu
cd "$(dirname -- "$0")/../.."
names() {
  awk '/^---@class/ { class = $2; sub(/:$/, "", class) }
    /^---@field/ { name = $2; sub(/\?$/, "", name); print class "." name }
    /^function / { name = $2; sub(/\(.*/, "", name); print name }' docs/asperity.d.lua | LC_ALL=C sort -u
}
if [ "${1:-}" = --write ]; then names > tests/guards/names.txt; fi
names | diff tests/guards/names.txt - || { echo "public names differ (< before, > now); names.sh --write records them"; exit 1; }
echo "$(wc -l < tests/guards/names.txt) public names are as they were"

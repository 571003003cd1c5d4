#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs one group of the page's tests, or a file; skipped (exit status 77) without npm, the packages or Chromium.
# usage: run.sh types|mock|teaching|saved|served|FILE BUILD_FOLDER PROGRAM
set -eu
group=$1
ASPERITY_PAGE_BUILD=$2
ASPERITY_PROGRAM=$3
here=$(cd -- "$(dirname -- "$0")" && pwd)

skip() {
  echo "skipped: $*"
  exit 77
}
node=$(command -v node || command -v nodejs) || skip "Node.js is not installed (Debian's packages nodejs and npm)"
[ -f "$ASPERITY_PAGE_BUILD/page-build/built" ] || skip "the page was not built: it needs npm and, the first time, a network"
if [ "$group" = types ]; then
  cd "$ASPERITY_PAGE_BUILD/page-build"
  exec "$node" node_modules/typescript/bin/tsc --noEmit
fi
# Chromium without its own interface opens a page in half the time.
CHROMIUM=${CHROMIUM:-$(command -v chromium-headless-shell || command -v chromium || command -v chromium-browser || true)}
[ -n "$CHROMIUM" ] || skip "Chromium is not installed (Debian's package chromium-headless-shell or chromium)"
export ASPERITY_PAGE_BUILD ASPERITY_PROGRAM CHROMIUM
case $group in
  */*) exec "$node" "$group" ;;
  *) exec "$node" --test "$here/${group}_test.mjs" ;;
esac

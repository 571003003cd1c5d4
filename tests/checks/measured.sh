#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Real measured files go through every experiment of examples/measured_specimen.lua. Skipped (77) unless
# ASPERITY_MEASURED names their folder.
# usage: measured.sh PROGRAM [the project's folder]
set -eu
program=$(readlink -f -- "$1")
cd "${2:-$(dirname -- "$0")/../..}"
if [ -z "${ASPERITY_MEASURED:-}" ]; then
  echo "skipped: ASPERITY_MEASURED does not name a folder of measured files"
  exit 77
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
specimen() {
  name=$1
  shift
  echo "== $name"
  "$program" run --out "$work/$name" examples/measured_specimen.lua -- "$ASPERITY_MEASURED/$name" "$@"
}
specimen x3p-2.x3p
specimen sdf-1.sdf
specimen sur-2.sur fill=interpolate
specimen matrix-4.txt
specimen dektak-1.csv
specimen xyz-1.txt unit=um unit_xy=um
specimen example-2d.npy unit=um size=1mm

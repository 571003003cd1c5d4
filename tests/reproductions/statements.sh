#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Wrong sentences about the paper and the program are gone; the true ones replace them, with their conditions.
set -eu
. "$(dirname "$0")/beginning.sh"
cd "$root"
gone() { ! grep -n -F -- "$1" "$2" || fail "$2 says it still"; }
stands() { tr -s '\n ' '  ' < "$2" | sed 's/ -- / /g' | grep -qF -- "$1" || fail "$2 does not say: $1"; }
stands "IF SUMMITS STAY ELASTIC ON QUARTZ" examples/paper/fig7_tilt.lua
stands "if the summits stay elastic on quartz" docs/paper.md
stands "1.06" examples/paper/fig7_tilt.lua
gone ".85 to 1.25 of eight pairs" examples/paper/fig7_tilt.lua
stands "24 pairs | elastic | 1.19 ± 0.04 | 1.16 ± 0.03" docs/paper.md
stands "property of boxes" examples/paper/fig8a_stiffness.lua
stands "this holds for boxes only" examples/paper/fig8b_friction.lua
stands "whole maps than on stylus scans (the paper's method)" examples/paper/fig6_correlation.lua
stands "Not found: the \"similar proportional decrease\"" examples/paper/fig9_flattening.lua
gone "reproduces it figure by figure" README.md
stands "We do not compare with the paper's measured values" README.md
stands "by the ratio r of the hardnesses at each node" docs/experimenter.md
"$program" help lab.exact.persson | tr -s '\n ' '  ' | grep -q "25 % below simulations" || fail "persson"
"$program" help lab.contact | tr -s '\n ' '  ' | grep -q "0.5 to 1.5 ranges" || fail "adhesion"
"$program" help surface:rotated | tr -s '\n ' '  ' | grep -q "there and back" || fail "rotated"
gone "3.1 % at most" docs/performance.md
! grep -rn "of which a protocol makes nothing" engine bindings || fail "English"
! grep -rnE "a line a call|pairs a pair|of flats none" bindings README.md docs || fail "English"
gone "by \`--shard\` or mpirun, and so does one contact" README.md

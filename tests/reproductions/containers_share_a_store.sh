#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Processes of one number in four containers share a store without losing results.
set -eu
. "$(dirname "$0")/beginning.sh"
unshare -p -f true 2> /dev/null || skip "no name spaces of processes here"
cat > s.lua <<'LUA'
local lab = require "asperity"
lab.ensemble{ over={ k={ 1, 2, 3, 4 } }, run=function(case)
  return { ra=lab.surface.self_affine{ cells=128, size=1e-3, hurst=0.8, ra=1e-6, short_wave=1e-4, seed=case.k }:roughness().Ra }
end }
LUA
for i in 1 2 3 4; do unshare -p -f "$program" run --threads 1 --store S --out ns$i s.lua 2> ns$i.err & done
wait
for i in 1 2 3 4; do says '"status": "done"' ns$i/manifest.json; done
! grep -h "not kept\|could not be stored" ns?.err || fail "they disturb each other"
[ -z "$(find S -name '*.part*')" ] || fail "parts in the store"

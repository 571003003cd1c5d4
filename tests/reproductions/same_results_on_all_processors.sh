#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# A run gives the same bits on a processor without wide vectors and FMA, which the C library emulates on request. `module`
# tests try a rounding mode set by a host program.
set -eu
. "$(dirname "$0")/beginning.sh"
cat > det.lua <<'LUA'
local lab = require "asperity"
local s = lab.surface.self_affine{ cells=64, size="1 mm", hurst=0.8, ra="1 um", short_wave="50 um", seed=1, material=lab.material "Al-2011" }
local b = lab.notebook "n"
b:write{ surface=s.digest, ra=s:roughness().Ra }
b:write{ surface=lab.surface.weierstrass_mandelbrot{ cells=32, D=2.3, span=1, seed=1 }.digest, ra=0 }
b:write{ surface=s:rotated "30 deg".digest, ra=s:filtered{ short_wave="80 um" }:roughness().Ra }
local c = lab.contact{ lower=s, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
local st = c:press{ pressure="50 MPa" }
b:write{ surface=st.digest, ra=st.approach }
LUA
"$program" run det.lua --out RD 2> /dev/null
for features in -AVX2,-FMA,-AVX512F,-AVX2_Usable,-FMA_Usable -AVX512F -FMA; do
  GLIBC_TUNABLES=glibc.cpu.hwcaps=$features "$program" replay RD --out "R$features" > output 2>&1 || { cat output; fail "without $features"; }
  says "the same again" output
done

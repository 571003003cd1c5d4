#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Results do not hang on the C library's sine, exponential, logarithm or power, which choose by the processor:
# no file of engine/ calls one but the file that tells C libraries apart, nor a function of the standard library
# built on one, nor a random distribution (the names of unfinished files alone are drawn by the system); they are in
# engine/core/arithmetic/elementary_functions.hpp. Three files use Eigen: one for products, which fixes Eigen's choices,
# and two for decompositions and sparse systems, without vectors and with blocks of one size. Boost serves where it calls
# none of these functions (Sobol's points, minima, numbers of many digits), and for reported intervals and probabilities.
# usage: elementary.sh [the project's folder]
set -eu
cd "${1:-$(dirname -- "$0")/../..}"

names='sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|exp|exp2|expm1|log|log2|log10|log1p|pow'
names="$names|hypot|cbrt|erf|erfc|tgamma|lgamma|polar|arg|sincos|cyl_bessel_[a-z]+|cyl_neumann|sph_bessel|expint"
names="$names|(comp_)?ellint_[123]|riemann_zeta|beta|legendre|laguerre|hermite"
found=0
if grep -rnE "(std|__builtin)(::|_)($names)[fl]?\b *\(" engine bindings/lua --include='*.cpp' --include='*.hpp' |
  grep -v '^engine/core/program_identity\.cpp:'; then
  echo "use elementary:: of engine/core/arithmetic/elementary_functions.hpp: the C library rounds by the processor"
  found=1
fi
if grep -rnE "<random>|std::(normal|lognormal|exponential|gamma|weibull)_distribution" engine \
  --include='*.cpp' --include='*.hpp' | grep -v '^engine/core/files/disk\.cpp:'; then
  echo "use engine/core/arithmetic/random.hpp: distributions of the standard library are each compiler's own"
  found=1
fi
if grep -rn '<Eigen/' engine --include='*.cpp' --include='*.hpp' |
  grep -v -e '^engine/surface/generators/table_product\.cpp:' -e '^engine/statistics/least_squares\.cpp:' \
    -e '^engine/surface/operations/holes\.cpp:'; then
  echo "Eigen chooses its operations by the processor: see engine/surface/generators/table_product.hpp"
  found=1
fi
if grep -rn '<boost/' engine --include='*.cpp' --include='*.hpp' |
  grep -v -e '^engine/statistics/distributions\.cpp:' -e '^engine/statistics/uncertain_input\.cpp:' \
    -e '^engine/metrology/parameters/autocorrelation\.cpp:' -e '^engine/study/exact/closed_forms\.cpp:'; then
  echo "Boost calls functions of the C library, which rounds by the processor"
  found=1
fi
for file in statistics/least_squares surface/operations/holes; do
  for line in '#define EIGEN_DONT_VECTORIZE' '#define EIGEN_MAX_ALIGN_BYTES 0' \
    "#define Eigen asperity_${file##*/}_eigen"; do
    sed '/<Eigen\//q' "engine/$file.cpp" | grep -qFx "$line" || {
      echo "engine/$file.cpp lacks $line before it includes Eigen"
      found=1
    }
  done
done
grep -q 'elementary::sincos(' engine/core/fourier/fourier_lanes.cpp || { echo "the check reads no sources"; found=1; }
exit $found

// SPDX-License-Identifier: GPL-3.0-or-later
// Correctly rounded elementary functions (nearest, ties to even): the same bits with every processor,
// compiler and C library. Method: Ziv (1991); MPFR decides about one argument in several thousand. Omitted:
// sqrt, fma, fmod, ldexp and floor, exact by IEEE 754.
//
// Thread-safe in the default rounding mode (rounding_mode.hpp). Special values follow C's Annex F;
// floating-point exceptions are not guaranteed. "Fast": up to twice the time of the C library; "slow": some
// microseconds.
#pragma once

namespace asperity::elementary {

struct SineCosine {
  double sine, cosine;
};

// Fast for |x| < 65536, x in rad.
double sin(double x);
double cos(double x);
SineCosine sincos(double x);

// Fast unless the result is subnormal.
double exp(double x);
double exp2(double x);
double expm1(double x);
double pow(double x, double y);

// Fast.
double log(double x);
double log2(double x);
double log10(double x);
double log1p(double x);
double hypot(double x, double y);
double asinh(double x);

// Slow.
double tan(double x);
double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);
double cbrt(double x);
double erf(double x);

}  // namespace asperity::elementary

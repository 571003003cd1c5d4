// SPDX-License-Identifier: GPL-3.0-or-later
// Elementary functions, correctly rounded: each returns the double nearest to the exact value (ties to even),
// so that a result is the same bits on every processor, with every compiler and C library. The C library's
// own are not: they choose by the processor whether to fuse multiply and add, and differ in the last bit.
// Method: Ziv's (1991), tables and short polynomials in pairs of doubles that carry 66 bits or more, and MPFR
// for the one argument in some thousands whose rounding these do not decide. What IEEE 754 rounds exactly
// (sqrt, fma, fmod, remainder, ldexp, floor) is not here.
//
// All: thread-safe; the default rounding mode is expected (rounding_mode.hpp); special values, infinities and
// signed zeros as in C's Annex F; no floating-point exceptions are promised. "Fast": about as fast as the C
// library's, up to twice its time; "slow": some microseconds.
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

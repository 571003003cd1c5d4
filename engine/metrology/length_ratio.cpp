// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/length_ratio.hpp"

#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"

namespace asperity {

namespace {

// √(2x/π) eˣ times K0(x), K1(x): of order one where the functions vanish.
struct ScaledBessel {
  double k0, k1;
};

// Σ Π (4ν² - (2m-1)²)/(8x m), to the least term.
double hankel_series(double four_nu_squared, double x) {
  double sum = 1, term = 1;
  for (int m = 1; m < 60; ++m) {
    const double odd = 2 * m - 1;
    const double next = term * (four_nu_squared - odd * odd) / (8 * x * m);
    if (std::abs(next) >= std::abs(term) || std::abs(next) < 1e-18) break;
    sum += term = next;
  }
  return sum;
}

// Trapezoidal rule for K_ν(x) eˣ = ∫ exp(−x(cosh t − 1)) cosh νt dt, t > 0; error exp(−π²/step).
ScaledBessel scaled_bessel(double x) {
  if (x > 25) return {hankel_series(0, x), hankel_series(4, x)};
  constexpr double step = 0.125, vanished = 60;
  double k0 = 0.5, k1 = 0.5;  // in steps
  for (int n = 1;; ++n) {
    const double half = elementary::exp(0.5 * step * n);
    const double sinh_half = 0.5 * (half - 1 / half);
    const double rise = 2 * sinh_half * sinh_half;  // cosh t − 1
    const double share = elementary::exp(-x * rise);
    k0 += share;
    k1 += share * (1 + rise);
    if (x * rise > vanished + step * n) break;
  }
  const double scale = std::sqrt(2 * x / std::numbers::pi) * step;
  return {scale * k0, scale * k1};
}

// Above, E√(1 + s²g²) = s E|g| to the last digit.
constexpr double very_steep = 1e9;
// Below, 1/s² overflows.
constexpr double very_flat = 1e-150;

}  // namespace

double expected_length_ratio(double rms_slope) {
  const double s = std::abs(rms_slope);
  if (s < very_flat) return 1;
  if (s > very_steep) return s * std::sqrt(2 / std::numbers::pi);
  const ScaledBessel k = scaled_bessel(1 / (4 * s * s));
  return (k.k0 + k.k1) / 2;
}

double length_sensitivity(double rms_slope) {
  const double s = std::abs(rms_slope);
  if (s < 1e-3) return s * s * (1 - 2 * s * s);
  if (s > very_steep) return 1;
  const ScaledBessel k = scaled_bessel(1 / (4 * s * s));
  return (k.k1 - k.k0) / (k.k1 + k.k0);
}

}  // namespace asperity

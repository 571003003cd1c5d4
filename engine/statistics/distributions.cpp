// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/distributions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

namespace {

constexpr double beyond = std::numeric_limits<double>::infinity();
// From here on, Student's t equals the normal distribution to the last digit: they differ by about t^3/(4
// degrees).
constexpr double normal_from = 1e17;

// Error of Stirling's formula: log Γ(a+1) - [(a + 1/2) log a - a + log(2π)/2].
double stirling_error(double a) {
  double sum = 0;
  for (; a < 16; ++a) sum += (a + 0.5) * elementary::log1p(1 / a) - 1;
  const double s = 1 / (a * a);
  return sum + (1.0 / 12 - s * (1.0 / 360 -
                                s * (1.0 / 1260 -
                                     s * (1.0 / 1680 - s * (1.0 / 1188 - s * (691.0 / 360360 - s / 156)))))) /
                   a;
}

// a log(a/m) + m - a, free of cancellation.
double deviance(double a, double m) {
  const double difference = a - m;
  if (std::abs(difference) < 0.1 * (a + m)) {
    const double v = difference / (a + m);
    double sum = difference * v, term = 2 * a * v;
    for (int k = 1; k < 100; ++k) {
      term *= v * v;
      const double next = sum + term / (2 * k + 1);
      if (next == sum) break;
      sum = next;
    }
    return sum;
  }
  return a * elementary::log(a / m) + m - a;
}

struct Shares {
  double x, y;  // y = 1 - x to full precision
};

Shares shares_of(double log_odds) {
  const double small = elementary::exp(-std::abs(log_odds));
  const double one = 1 / (1 + small), other = small / (1 + small);
  return log_odds > 0 ? Shares{one, other} : Shares{other, one};
}

// x^a y^b / B(a, b): derivative of I_x by the log odds.
double beta_slope(double a, double b, const Shares& at) {
  if (at.x == 0 || at.y == 0) return 0;
  const double n = a + b;
  const double exponent = stirling_error(n) - stirling_error(a) - stirling_error(b) - deviance(a, n * at.x) -
                          deviance(b, n * at.y);
  return elementary::exp(exponent) * std::sqrt(a * b / (2 * std::numbers::pi * n));
}

// I_x(a, b) by every second convergent (BFRAC of DiDonato & Morris), without cancellation in a - (a+b)x.
// Needs x < (a+1)/(a+b+2).
double beta_fraction(double a, double b, const Shares& at) {
  const double c = 1 + (a > b ? (a + b) * at.y - b : a - (a + b) * at.x);
  const double c0 = b / a, c1 = 1 + 1 / a;
  double p = 1, s = a + 1, before = 0, below_before = 1, above = 1, below = c / c1, value = c1 / c;
  for (int n = 1; n < 1'000'000; ++n) {
    const double w = n * (b - n) * at.x, e = a / s;
    const double alpha = p * (p + c0) * e * e * (w * at.x);
    const double share = (n / a + 1) / (c1 + 2 * n / a);
    const double beta = n + w / s + share * (c + n * (1 + at.y));
    p = n / a + 1;
    s += 2;
    const double next = alpha * before + beta * above, next_below = alpha * below_before + beta * below;
    const double last = value;
    value = next / next_below;
    if (std::abs(value - last) <= 1e-16 * std::abs(value)) break;
    before = above / next_below;
    below_before = below / next_below;
    above = value;
    below = 1;
  }
  return value;
}

struct BetaTails {
  double lower, upper;
};
BetaTails tails(double a, double b, const Shares& at, double slope) {
  if (at.x < (a + 1) / (a + b + 2)) {
    const double lower = slope * beta_fraction(a, b, at);
    return {lower, 1 - lower};
  }
  const double upper = slope * beta_fraction(b, a, {at.y, at.x});
  return {1 - upper, upper};
}

// Log odds of a quantile: Newton with bisection on the logarithm of the smaller tail, a concave function.
double beta_quantile(double a, double b, double lower, double upper) {
  constexpr double farthest = 700;  // exp(-u) is still normal
  if (lower <= 0) return -beyond;
  if (upper <= 0) return beyond;
  const bool from_below = lower <= upper;
  const double wanted = elementary::log(from_below ? lower : upper);
  double low = -farthest, high = farthest, u = elementary::log(a / b);
  for (int step = 0; step < 200; ++step) {
    const Shares at = shares_of(u);
    const double slope = beta_slope(a, b, at);
    const BetaTails found = tails(a, b, at, slope);
    const double share = from_below ? found.lower : found.upper;
    const double excess = share > 0 ? elementary::log(share) - wanted : -beyond;
    const bool too_high = (excess > 0) == from_below;
    (too_high ? high : low) = u;
    double next = u - (from_below ? 1 : -1) * excess * share / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next) > farthest - 1) return next > 0 ? beyond : -beyond;
    if (std::abs(next - u) <= 1e-16 * std::max(1.0, std::abs(u))) return next;
    u = next;
  }
  return u;
}

double normal_tails(double z) {
  if (z < 2) return 1 - elementary::erf(z / std::numbers::sqrt2);
  if (z > 40) return 0;
  double fraction = z;
  for (int k = 400; k > 0; --k) fraction = z + k / fraction;  // Laplace
  return 2 * elementary::exp(-z * z / 2) / (std::sqrt(2 * std::numbers::pi) * fraction);
}

// The z with P(|Z| < z) = `within` = 1 - `outside`.
double normal_factor(double within, double outside) {
  if (within <= 0) return 0;
  if (outside <= 0) return beyond;
  const bool near = within < 0.5;
  double low = 0, high = 40, z = near ? within * 1.25 : 1.5;
  for (int step = 0; step < 200; ++step) {
    const double density = std::sqrt(2 / std::numbers::pi) * elementary::exp(-z * z / 2);
    double next = 0;
    if (near) {
      const double excess = elementary::erf(z / std::numbers::sqrt2) - within;
      (excess > 0 ? high : low) = z;
      next = z - excess / density;
    } else {
      const double share = normal_tails(z);
      const double excess = elementary::log(share / outside);
      (excess < 0 ? high : low) = z;
      next = z + excess * share / density;
    }
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (std::abs(next - z) <= 1e-16 * z) return next;
    z = next;
  }
  return z;
}

void require_share(double p, const char* what) {
  if (!(p >= 0 && p <= 1))
    throw Error(ErrorCode::bad_value, std::string(what) + " is " + format_short(p), "give one from 0 to 1");
}
void require_degrees(double degrees) {
  if (!(degrees > 0))
    throw Error(ErrorCode::bad_value, "the degrees of freedom are " + format_short(degrees),
                "there must be more than 0");
}

}  // namespace

double student_t_factor(double confidence, double degrees) {
  require_share(confidence, "the confidence");
  require_degrees(degrees);
  if (degrees >= normal_from) return normal_factor(confidence, 1 - confidence);
  return std::sqrt(degrees) *
         elementary::exp(0.5 * beta_quantile(0.5, 0.5 * degrees, confidence, 1 - confidence));
}

double f_cdf(double f, double between, double within) {
  require_degrees(between);
  require_degrees(within);
  if (!(f > 0)) return std::isnan(f) ? f : 0;
  const Shares at = shares_of(elementary::log(f) + elementary::log(between) - elementary::log(within));
  const double a = 0.5 * between, b = 0.5 * within;
  return tails(a, b, at, beta_slope(a, b, at)).lower;
}

double normal_quantile(double p) {
  require_share(p, "the share below a quantile");
  const double z = normal_factor(std::abs(2 * p - 1), 2 * std::min(p, 1 - p));
  return p < 0.5 ? -z : z;
}

}  // namespace asperity

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/statistics/distributions.hpp"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

// Boost's default of long double inside: in double, F loses eight digits for a billion degrees. Its root
// finder reports slow progress as an error and returns its last value.
using boost::math::policies::ignore_error;
using Policy = boost::math::policies::policy<boost::math::policies::overflow_error<ignore_error>,
                                             boost::math::policies::evaluation_error<ignore_error>>;
using FisherF = boost::math::fisher_f_distribution<double, Policy>;

constexpr double beyond = std::numeric_limits<double>::infinity();
// Beyond, Student's t equals the normal distribution to the last digit: they differ by about t^3/(4 degrees).
constexpr double normal_from = 1e17;

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
  if (!(p >= 0 && p <= 1)) refuse(std::string(what) + " is " + format_short(p), "give one from 0 to 1");
}
void require_degrees(double degrees) {
  if (!(degrees > 0))
    refuse("the degrees of freedom are " + format_short(degrees), "there must be more than 0");
}

}  // namespace

// T² follows F with 1 and `degrees`; the t quantile of Boost 1.74 is wrong near the middle.
double student_t_factor(double confidence, double degrees) {
  require_share(confidence, "the confidence");
  require_degrees(degrees);
  if (degrees >= normal_from) return normal_factor(confidence, 1 - confidence);
  if (confidence == 1) return beyond;
  // The density is constant near 0.
  if (confidence < 1e-6)
    return 0.5 * confidence * std::sqrt(degrees) * boost::math::beta(0.5, 0.5 * degrees, Policy());
  const FisherF squared(1, degrees);
  return std::sqrt(confidence < 0.5 ? quantile(squared, confidence)
                                    : quantile(complement(squared, 1 - confidence)));
}

double f_cdf(double f, double between, double within) {
  require_degrees(between);
  require_degrees(within);
  if (!(f > 0)) return std::isnan(f) ? f : 0;
  return std::isfinite(f) ? cdf(FisherF(between, within), f) : 1;
}

double normal_quantile(double p) {
  require_share(p, "the share below a quantile");
  const double z = normal_factor(std::abs(2 * p - 1), 2 * std::min(p, 1 - p));
  return p < 0.5 ? -z : z;
}

}  // namespace asperity

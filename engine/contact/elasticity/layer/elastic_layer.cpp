// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/layer/elastic_layer.hpp"

#include "engine/core/arithmetic/elementary_functions.hpp"

namespace asperity {

namespace {

// From here on the share is 1 to the last bit: what it lacks is y² exp(−y).
constexpr double deep = 60;

// sinh y − y, of y up to 1: its power series, whose next term is below 1e-17 of the first.
double sinh_less_argument(double y) {
  const double z = y * y;
  double sum = 1;
  for (int k = 8; k >= 1; --k) sum = 1 + z / ((2 * k + 2) * (2 * k + 3)) * sum;
  return y * z / 6 * sum;
}

// Numerator and denominator times 2 exp(−y), y = 2x: no term overflows. Terms of unlike sign meet in the
// numerator alone, where a long wave on a nearly incompressible layer leaves little of them; (a − 1) sinh y +
// (sinh y − y) has none.
double bonded_share(double y, double poisson) {
  const double more = 2 * (1 - 2 * poisson), a = 1 + more;
  const double fall = elementary::exp(-y), missing = -elementary::expm1(-2 * y);  // 1 − exp(−2y)
  const double denominator = a * (1 + fall * fall) + (y * y + 1 + a * a) * fall;
  const double numerator =
      y < 1 ? more * missing + 2 * fall * sinh_less_argument(y) : a * missing - 2 * y * fall;
  return numerator / denominator;
}

// 2 sinh² x/(sinh 2x + 2x), times 2 exp(−2x) above and below: all terms are positive.
double frictionless_share(double x) {
  const double missing = -elementary::expm1(-2 * x);
  return missing * (missing / (-elementary::expm1(-4 * x) + 4 * x * elementary::exp(-2 * x)));
}

}  // namespace

double layer_share(double x, double poisson, LayerBase base) {
  if (!(x > 0)) return 0;
  if (2 * x > deep) return 1;
  return base == LayerBase::bonded ? bonded_share(2 * x, poisson) : frictionless_share(x);
}

double uniform_share(double poisson) { return (1 - 2 * poisson) / ((1 - poisson) * (1 - poisson)); }

WaveShare wave_share(const ElasticLayer& layer) {
  return {[poisson = layer.poisson, base = layer.base](double x) { return layer_share(x, poisson, base); },
          layer.thickness,
          uniform_share(layer.poisson),
          {layer.poisson, static_cast<double>(layer.base)}};
}

}  // namespace asperity

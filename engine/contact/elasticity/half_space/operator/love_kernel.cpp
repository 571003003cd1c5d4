// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/operator/love_kernel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"

namespace asperity {

namespace {

// Half of the abscissae and weights of Gauss's rules of 4, 8 and 16 points on [−1, 1].
struct Node {
  double at, weight;
};
constexpr std::array<Node, 2> rule_4{
    {{0.33998104358485626, 0.65214515486254614}, {0.86113631159405258, 0.34785484513745386}}};
constexpr std::array<Node, 4> rule_8{{{0.18343464249564980, 0.36268378337836198},
                                      {0.52553240991632899, 0.31370664587788729},
                                      {0.79666647741362674, 0.22238103445337447},
                                      {0.96028985649753623, 0.10122853629037626}}};
constexpr std::array<Node, 8> rule_16{{{0.095012509837637440, 0.18945061045506850},
                                       {0.28160355077925891, 0.18260341504492359},
                                       {0.45801677765722739, 0.16915651939500254},
                                       {0.61787624440264375, 0.14959598881657673},
                                       {0.75540440835500303, 0.12462897125553387},
                                       {0.86563120238783174, 0.095158511682492785},
                                       {0.94457502307323258, 0.062253523938647893},
                                       {0.98940093499164993, 0.027152459411754095}}};

// ∫ dη / √(x² + (y−η)²) over |η| < half = asinh((y+half)/x) − asinh((y−half)/x), for x, y > 0,
// as one area sine, whose argument has no cancellation.
double line(double x, double y, double half) {
  const double near = y - half, beyond = y + half;
  if (near <= 0) return elementary::asinh(beyond / x) - elementary::asinh(near / x);
  const double r_near = std::sqrt(x * x + near * near), r_beyond = std::sqrt(x * x + beyond * beyond);
  return elementary::asinh(4 * y * half / (beyond * r_near + near * r_beyond));
}

// Mean over |ξ| < half of line(x − ξ, y, other).
template <std::size_t n>
double gauss(const std::array<Node, n>& rule, double x, double half, double y, double other) {
  double sum = 0;
  for (const Node& node : rule)
    sum += 0.5 * node.weight * (line(x - half * node.at, y, other) + line(x + half * node.at, y, other));
  return sum;
}

// The integrand is singular only on the line x = 0, which is distance/half-width away from the
// interval in its own units: Gauss's rule of n points errs as (2·distance/half)^(−2n).
double integrate(double x, double half, double y, double other) {
  const double distance = x / half;
  const double mean = distance < 10    ? gauss(rule_16, x, half, y, other)
                      : distance < 100 ? gauss(rule_8, x, half, y, other)
                                       : gauss(rule_4, x, half, y, other);
  return 2 * half * mean;
}

// A corner's share of the rectangle: F(x, y) = x asinh(y/|x|) + y asinh(x/|y|).
double corner(double x, double y) {
  const double first = x == 0 ? 0 : x * elementary::asinh(y / std::abs(x));
  const double second = y == 0 ? 0 : y * elementary::asinh(x / std::abs(y));
  return first + second;
}

}  // namespace

LoveKernel::LoveKernel(double aspect)
    : aspect_(aspect), far_(elementary::pow(100 * std::max(1.0, aspect), 2)) {}

double LoveKernel::operator()(double i, double j) const {
  i = std::abs(i);
  j = std::abs(j);
  const double x = i, y = j * aspect_;
  if (x * x + y * y > far_) return far(x, y);
  const double a = 0.5, b = 0.5 * aspect_;
  double integral = 0;
  if (i >= 1 && i >= j)
    integral = integrate(x, a, y, b);
  else if (j >= 1)
    integral = integrate(y, b, x, a);
  else
    integral = corner(x + a, y + b) - corner(x - a, y + b) - corner(x + a, y - b) + corner(x - a, y - b);
  return integral * std::numbers::inv_pi;
}

// The mean of x'^2m y'^2n over the rectangle is a^2m b^2n / ((2m+1)(2n+1)): Taylor's series of 1/R about
// its centre to the fourth order, the next being (half side / R)^6 < 2e-14.
double LoveKernel::far(double x, double y) const {
  const double xx = x * x, yy = y * y, rr = xx + yy;
  const double s = 1 / rr;
  const double u = 0.25 * s, v = 0.25 * aspect_ * aspect_ * s;  // (half side)² / R²
  const double cc = xx * s, ss = yy * s;                        // cos², sin² of the direction
  const double second = u * (3 * cc - 1) / 6 + v * (3 * ss - 1) / 6;
  const double xxxx = (105 * cc * cc - 90 * cc + 9) / 120;
  const double yyyy = (105 * ss * ss - 90 * ss + 9) / 120;
  const double xxyy = (105 * cc * ss - 15 * (cc + ss) + 3) / 36;
  const double fourth = u * u * xxxx + v * v * yyyy + u * v * xxyy;
  return aspect_ * std::numbers::inv_pi * std::sqrt(s) * (1 + second + fourth);
}

}  // namespace asperity

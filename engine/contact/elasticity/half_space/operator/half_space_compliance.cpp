// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/operator/half_space_compliance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/fourier/fourier_batch.hpp"
#include "engine/core/fourier/fourier_filter.hpp"
#include "engine/core/fourier/fourier_lane_filter.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

double ComplianceMultiplier::greatest_from(double q) const {
  double greatest = 2 / q * share(q);
  if (!shares()) return greatest;
  // Smooth in log x below x = 4.
  for (double wave = q; wave * length < 4; wave *= 1.25)
    greatest = std::max(greatest, 2 / wave * share(wave));
  return greatest;
}

ComplianceMultiplier ComplianceMultiplier::on_coarser(double pitch) const {
  ComplianceMultiplier result = *this;
  result.length /= pitch;
  result.uniform /= pitch;
  return result;
}

ComplianceMultiplier in_cells(const WaveShare& share, double hx, bool with_mean) {
  const double length = share.length / hx;
  return {share.share, length, with_mean ? length * share.uniform : 0};
}

namespace {

// Positive nodes of Gauss's rules on [−1, 1].
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

// ∫ dη / √(x² + (y−η)²) over |η| < half = asinh((y+half)/x) − asinh((y−half)/x), without cancellation.
double line(double x, double y, double half) {
  const double near = y - half, beyond = y + half;
  if (near <= 0) return elementary::asinh(beyond / x) - elementary::asinh(near / x);
  const double r_near = std::sqrt(x * x + near * near), r_beyond = std::sqrt(x * x + beyond * beyond);
  return elementary::asinh(4 * y * half / (beyond * r_near + near * r_beyond));
}

// Mean of line(x − ξ, y, other) over |ξ| < half.
template <std::size_t n>
double gauss(const std::array<Node, n>& rule, double x, double half, double y, double other) {
  double sum = 0;
  for (const Node& node : rule)
    sum += 0.5 * node.weight * (line(x - half * node.at, y, other) + line(x + half * node.at, y, other));
  return sum;
}

// Singular only at x = 0. Relative error of Gauss's rule of n points: (2·distance/half)^(−2n).
double integrate(double x, double half, double y, double other) {
  const double distance = x / half;
  const double mean = distance < 10    ? gauss(rule_16, x, half, y, other)
                      : distance < 100 ? gauss(rule_8, x, half, y, other)
                                       : gauss(rule_4, x, half, y, other);
  return 2 * half * mean;
}

// F(x, y) = x asinh(y/|x|) + y asinh(x/|y|).
double corner(double x, double y) {
  const double first = x == 0 ? 0 : x * elementary::asinh(y / std::abs(x));
  const double second = y == 0 ? 0 : y * elementary::asinh(x / std::abs(y));
  return first + second;
}

// Convolution of n values without wrap.
int padded(int n) { return std::max(2, good_fourier_length(2 * n - 1)); }

int period(int n, Boundary boundary) { return boundary == Boundary::periodic ? n : padded(n); }

// The period, if FourierLaneFilter supports it.
int transform_period_x(int n, Boundary boundary) {
  return boundary == Boundary::periodic && n % 2 == 0 && LaneFourier<double>::possible(n) ? n : padded(n);
}
int transform_period_y(int n, Boundary boundary) {
  return boundary == Boundary::periodic && LaneFourier<double>::possible(n) ? n : padded(n);
}

// K of the waves (a, b), b = 0 … period/2.
void periodic_multiplier(const ComplianceMultiplier& multiplier, int nx, int ny, double aspect, int a,
                         std::span<double> factors) {
  const double qx = 2 * std::numbers::pi * static_cast<double>(a) / nx;
  const double per_wave = 2 * std::numbers::pi / (ny * aspect);
  for (std::size_t b = 0; b < factors.size(); ++b) {
    const double qy = per_wave * static_cast<int>(b);
    factors[b] = 2 / std::sqrt(qx * qx + qy * qy);
  }
  if (multiplier.shares())
    for (double& factor : factors) factor *= multiplier.share(2 / factor);
  if (a == 0) factors[0] = multiplier.uniform;
}

// Even sequences from 0 to period/2 become their real transforms.
constexpr int sequences_at_once = BatchFourier::rows;
void transform_even(const BatchFourier& fourier, std::span<double* const> halves) {
  const int period = fourier.length();
  const auto count = static_cast<int>(halves.size());
  const auto whole_length = static_cast<std::size_t>(period), bins = static_cast<std::size_t>(fourier.bins());
  BatchFourier::Work work(fourier);
  Array<double> wholes(whole_length * halves.size());
  Array<std::complex<double>> spectra(bins * halves.size());
  std::array<const double*, sequences_at_once> from;
  std::array<std::complex<double>*, sequences_at_once> to;
  for (std::size_t r = 0; r < halves.size(); ++r) {
    double* const whole = wholes.data() + r * whole_length;
    for (int k = 0; k < period; ++k) whole[k] = halves[r][std::min(k, period - k)];
    from[r] = whole;
    to[r] = spectra.data() + r * bins;
  }
  fourier.real_forward(work, from.data(), period, count, to.data());
  for (std::size_t r = 0; r < halves.size(); ++r)
    std::transform(to[r], to[r] + bins, halves[r], [](std::complex<double> bin) { return bin.real(); });
}

// coefficient(i, j): displacement at i and j cells, up to half a period. multiplier[a (period_y/2 + 1) + b]:
// factor of wave (a, b).
template <class Coefficient>
void transform_kernel(int period_x, int period_y, const Coefficient& coefficient,
                      std::span<double> multiplier) {
  const BatchFourier along(period_x), across(period_y);
  const int bins_x = period_x / 2 + 1, bins_y = period_y / 2 + 1;
  const auto batches = [](int count) { return (count + sequences_at_once - 1) / sequences_at_once; };
  parallel_for(batches(bins_y), [&](std::int64_t block) {
    const int first = static_cast<int>(block) * sequences_at_once;
    const int rows = std::min(sequences_at_once, bins_y - first);
    const auto row_length = static_cast<std::size_t>(bins_x);
    Array<double> values(row_length * sequences_at_once);
    std::vector<double*> halves;
    for (int j = 0; j < rows; ++j) {
      double* const row = values.data() + static_cast<std::size_t>(j) * row_length;
      for (int i = 0; i < bins_x; ++i) row[i] = coefficient(i, first + j);
      halves.push_back(row);
    }
    transform_even(along, halves);
    for (std::size_t a = 0; a < row_length; ++a)
      for (int j = 0; j < rows; ++j)
        multiplier[a * static_cast<std::size_t>(bins_y) + static_cast<std::size_t>(first + j)] =
            values[static_cast<std::size_t>(j) * row_length + a];
  });
  parallel_for(batches(bins_x), [&](std::int64_t block) {
    const int first = static_cast<int>(block) * sequences_at_once;
    std::vector<double*> halves;
    for (int a = first; a < std::min(first + sequences_at_once, bins_x); ++a)
      halves.push_back(multiplier.data() + static_cast<std::size_t>(a) * static_cast<std::size_t>(bins_y));
    transform_even(across, halves);
  });
}

// A periodic tile on a longer period, by its kernel within its sides.
void padded_tile_multiplier(const ComplianceMultiplier& of_wave, int nx, int ny, double aspect, int period_x,
                            int period_y, std::span<double> multiplier) {
  const auto half_y = static_cast<std::size_t>(ny / 2 + 1);
  Array<double> waves(static_cast<std::size_t>(nx / 2 + 1) * half_y);
  const std::span all(waves);
  parallel_for(nx / 2 + 1, [&](std::int64_t a) {
    periodic_multiplier(of_wave, nx, ny, aspect, static_cast<int>(a),
                        all.subspan(static_cast<std::size_t>(a) * half_y, half_y));
  });
  // The kernel is even: inverse transform = forward transform / nodes.
  Array<double> kernel(waves.size());
  transform_kernel(
      nx, ny,
      [&](int a, int b) { return waves[static_cast<std::size_t>(a) * half_y + static_cast<std::size_t>(b)]; },
      kernel);
  const double nodes = static_cast<double>(nx) * ny;
  const auto nearest = [](int distance, int side) {
    return static_cast<std::size_t>(std::min(distance % side, side - distance % side));
  };
  transform_kernel(
      period_x, period_y,
      [&](int i, int j) { return kernel[nearest(i, nx) * half_y + nearest(j, ny)] / nodes; }, multiplier);
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

// Taylor series of 1/R to fourth order, with the mean a^2m b^2n / ((2m+1)(2n+1)) of x'^2m y'^2n. Next term:
// (half side / R)^6 < 2e-14.
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

// The inactive filter keeps only its multiplier.
struct HalfSpaceCompliance::Parts {
  int nx, ny;
  int period_x, period_y;
  int transform_x, transform_y;
  double aspect;
  Boundary boundary;
  double weight;
  ComplianceMultiplier of_wave;
  std::optional<FourierLaneFilter<double>> lanes;
  std::optional<FourierLaneFilter<float>> singles;
  double scale = 1;     // of pressures, for `singles`
  Array<double> field;  // results, if the caller stores none

  Parts(int nx_, int ny_, double aspect_, Boundary boundary_, double weight_, bool single,
        const ComplianceMultiplier& of_wave_)
      : nx(nx_),
        ny(ny_),
        period_x(period(nx, boundary_)),
        period_y(period(ny, boundary_)),
        transform_x(transform_period_x(nx, boundary_)),
        transform_y(transform_period_y(ny, boundary_)),
        aspect(aspect_),
        boundary(boundary_),
        weight(weight_),
        of_wave(of_wave_) {
    Array<double> multiplier;
    const auto waves_y = static_cast<std::size_t>(transform_y / 2 + 1);
    if (!of_tile()) {
      multiplier.resize(static_cast<std::size_t>(transform_x / 2 + 1) * waves_y);
      if (boundary == Boundary::periodic)
        padded_tile_multiplier(of_wave, nx, ny, aspect, transform_x, transform_y, multiplier);
      else
        transform_kernel(transform_x, transform_y, LoveKernel(aspect), multiplier);
    }
    const auto factors = [&](int a, std::span<double> to) {
      if (of_tile())
        periodic_multiplier(of_wave, nx, ny, aspect, a, to);
      else
        std::copy_n(multiplier.data() + static_cast<std::size_t>(a) * waves_y, waves_y, to.data());
    };
    if (single)
      singles.emplace(nx, ny, transform_x, transform_y, factors);
    else
      lanes.emplace(nx, ny, transform_x, transform_y, factors);
  }

  bool of_tile() const { return boundary == Boundary::periodic && transform_x == nx && transform_y == ny; }
  FourierLaneFilter<double>& in_double() {
    if (singles) singles->rest();
    return *lanes;
  }
  FourierLaneFilter<float>& in_single() {
    lanes->rest();
    if (!singles)
      singles.emplace(nx, ny, transform_x, transform_y, [this](int a, std::span<double> to) {
        if (of_tile())
          periodic_multiplier(of_wave, nx, ny, aspect, a, to);
        else
          for (std::size_t b = 0; b < to.size(); ++b) to[b] = lanes->factor(a, static_cast<int>(b));
      });
    return *singles;
  }

  std::size_t bins_y() const { return static_cast<std::size_t>(period_y / 2 + 1); }
  // b = 0 … period_y/2.
  void factors_of(int a, std::span<double> factors) {
    const bool periodic = boundary == Boundary::periodic;
    if (lanes && (!periodic || of_tile()))
      for (std::size_t b = 0; b < factors.size(); ++b) factors[b] = lanes->factor(a, static_cast<int>(b));
    else if (periodic)
      periodic_multiplier(of_wave, nx, ny, aspect, a, factors);
    else
      for (std::size_t b = 0; b < factors.size(); ++b) factors[b] = singles->factor(a, static_cast<int>(b));
  }
};

HalfSpaceCompliance::HalfSpaceCompliance(int nx, int ny, double aspect, Boundary boundary, double weight,
                                         bool single, const ComplianceMultiplier& multiplier)
    : parts_(std::make_unique<Parts>(nx, ny, aspect, boundary, weight, single, multiplier)) {}

HalfSpaceCompliance::~HalfSpaceCompliance() = default;
HalfSpaceCompliance::HalfSpaceCompliance(HalfSpaceCompliance&&) noexcept = default;
HalfSpaceCompliance& HalfSpaceCompliance::operator=(HalfSpaceCompliance&&) noexcept = default;

void HalfSpaceCompliance::apply(std::span<const double> p, std::span<double> u) {
  if (single()) {
    cost::count_transforms(2 * parts_->weight);
    return parts_->singles->apply(p, u, parts_->scale);
  }
  const std::ptrdiff_t nx = parts_->nx;
  apply([&](int j, double*) { return p.data() + j * nx; }, {}, u);
}

void HalfSpaceCompliance::apply(const Source& source, const Sink& sink, std::span<double> u) {
  Parts& parts = *parts_;
  cost::count_transforms(2 * parts.weight);
  if (parts.lanes) return parts.in_double().apply(source, sink, u);
  parts.singles->apply(source, sink, u);
}

void HalfSpaceCompliance::apply_rounded(const Source& source, const Sink& sink, std::span<double> u) {
  if (!parts_->lanes) return apply(source, sink, u);
  cost::count_transforms(2 * parts_->weight);
  parts_->in_single().apply(source, sink, u);
}

bool HalfSpaceCompliance::single() const { return parts_->singles && !parts_->lanes; }

void HalfSpaceCompliance::count_pressures_in(double unit) {
  if (unit > 0 && std::isfinite(unit))
    parts_->scale = std::ldexp(1.0, std::clamp(-std::ilogb(unit), -1000, 1000));
}

void HalfSpaceCompliance::apply_in_double(const Source& source, const Sink& sink, std::span<double> u) {
  Parts& parts = *parts_;
  if (!single()) return apply(source, sink, u);
  parts.singles->rest();
  if (parts.boundary == Boundary::free) {
    HalfSpaceCompliance exact(parts.nx, parts.ny, parts.aspect, parts.boundary, parts.weight);
    return exact.apply(source, sink, u);
  }
  cost::count_transforms(2 * parts.weight);
  const auto width = static_cast<std::size_t>(parts.nx);
  if (u.empty()) {
    parts.field.resize(width * static_cast<std::size_t>(parts.ny));
    u = parts.field;
  }
  const auto row = [&](std::int64_t j) { return u.data() + static_cast<std::size_t>(j) * width; };
  parallel_for(parts.ny, [&](std::int64_t j) {
    const double* const from = source(static_cast<int>(j), row(j));
    if (from != row(j)) std::copy_n(from, width, row(j));
  });
  FourierFilter filter(parts.nx, parts.ny, parts.period_x, parts.period_y);
  filter.apply(u, u, [&](int a, std::span<double> factors) {
    periodic_multiplier(parts.of_wave, parts.nx, parts.ny, parts.aspect, a, factors);
  });
  if (sink) parallel_for(parts.ny, [&](std::int64_t j) { sink(static_cast<int>(j), row(j)); });
}

void HalfSpaceCompliance::apply_inverse(std::span<const double> u, std::span<double> p, double softer) {
  Parts& parts = *parts_;
  FourierFilter filter(parts.nx, parts.ny, parts.period_x, parts.period_y);
  filter.apply(u, p, [&](int a, std::span<double> factors) {
    parts.factors_of(a, factors);
    for (double& factor : factors) factor = factor + softer > 0 ? 1 / (factor + softer) : 0;
  });
  cost::count_transforms(2 * parts.weight);
}

HalfSpaceCompliance::Spectrum HalfSpaceCompliance::spectrum() const {
  const int period_x = parts_->period_x, period_y = parts_->period_y;
  // Waves per bin of the quarter spectrum.
  const auto waves = [](int bin, int period) { return bin == 0 || 2 * bin == period ? 1.0 : 2.0; };
  Array<double> sums(static_cast<std::size_t>(period_x / 2 + 1)), inverse(sums.size());
  Array<double> column(parts_->bins_y());
  Spectrum found{std::numeric_limits<double>::infinity(), 0, 0, 0};
  const bool mean_is_free = parts_->boundary == Boundary::periodic && parts_->of_wave.uniform == 0;
  for (int a = 0; a <= period_x / 2; ++a) {
    parts_->factors_of(a, column);
    double sum = 0, inverse_sum = 0;
    for (int b = 0; b <= period_y / 2; ++b) {
      if (mean_is_free && a == 0 && b == 0) continue;
      const double factor = column[static_cast<std::size_t>(b)];
      found.least = std::min(found.least, factor);
      found.greatest = std::max(found.greatest, factor);
      sum += waves(b, period_y) * factor;
      inverse_sum += waves(b, period_y) / factor;
    }
    sums[static_cast<std::size_t>(a)] = waves(a, period_x) * sum;
    inverse[static_cast<std::size_t>(a)] = waves(a, period_x) * inverse_sum;
  }
  const double n = static_cast<double>(period_x) * period_y;
  found.node = block_sum(sums) / n;
  found.inverse_node = block_sum(inverse) / n;
  return found;
}

}  // namespace asperity

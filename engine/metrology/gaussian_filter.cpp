// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/gaussian_filter.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/fourier/fourier_batch.hpp"
#include "engine/core/fourier/fourier_lanes.hpp"
#include "engine/core/parallel.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/blocked_sums.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

constexpr double ln2 = std::numbers::ln2;
// Cut-offs until exp(-(π²/ln 2) r²) falls below 1e-16.
constexpr double kernel_reach = 1.62;

// Drops an infinite `long_wave`.
GaussianFilter checked(const GaussianFilter& filter) {
  if (!filter.short_wave && !filter.long_wave)
    refuse("a filter needs `short_wave` or `long_wave`, and neither is given",
           "give one or both, as in `short_wave=\"2.5 um\", long_wave=\"0.8 mm\"`");
  require_positive("short_wave", filter.short_wave, "m", "give a finite length above zero");
  if (filter.long_wave)
    require(*filter.long_wave > 0, "long_wave", *filter.long_wave, "m", "give a length above zero");
  if (filter.short_wave && filter.long_wave && !(*filter.short_wave < *filter.long_wave))
    refuse("`short_wave` " + metres(*filter.short_wave) + " is not below `long_wave` " +
               metres(*filter.long_wave),
           "give a smaller `short_wave` or a larger `long_wave`");
  GaussianFilter result = filter;
  if (result.long_wave && std::isinf(*result.long_wave)) result.long_wave.reset();
  if (result.robust && !result.long_wave)
    refuse("`robust` is given without a finite `long_wave`",
           "give `long_wave`, whose mean line is robust, or leave `robust` out");
  return result;
}

// Transmission at |q|² = q_squared, (rad/m)².
double kept(const GaussianFilter& filter, double q_squared) {
  const double unit = ln2 * q_squared / (4 * std::numbers::pi * std::numbers::pi);
  double share = 1;
  if (filter.short_wave) share *= elementary::exp(-unit * *filter.short_wave * *filter.short_wave);
  if (filter.long_wave) share *= -elementary::expm1(-unit * *filter.long_wave * *filter.long_wave);
  return share;
}

class LineFilter {
 public:
  LineFilter(int n, double spacing, double cut_off)
      : reach_(static_cast<int>(std::min<double>(n - 1, std::floor(kernel_reach * (cut_off / spacing))))),
        padded_(smooth_length(n + reach_)),
        batch_(padded_) {
    Array<double> kernel(static_cast<std::size_t>(padded_));
    Array<double> cumulative(static_cast<std::size_t>(reach_) + 1);
    double sum = 0;
    for (int k = 0; k <= reach_; ++k) {
      const double r = k * (spacing / cut_off);
      const double weight = elementary::exp(-(std::numbers::pi * std::numbers::pi / ln2) * r * r);
      kernel[static_cast<std::size_t>(k)] = weight;
      kernel[static_cast<std::size_t>(k == 0 ? 0 : padded_ - k)] = weight;
      cumulative[static_cast<std::size_t>(k)] = sum += weight;
    }
    // Real, as the kernel is even.
    for (const std::complex<double> bin : fourier_forward(kernel)) response_.push_back(bin.real() / padded_);
    weights_.resize(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i)
      weights_[static_cast<std::size_t>(i)] =
          cumulative[static_cast<std::size_t>(std::min(i, reach_))] +
          cumulative[static_cast<std::size_t>(std::min(n - 1 - i, reach_))] - 1;
  }

  // The kernel is one sample.
  bool idle() const { return reach_ == 0; }

  static constexpr int lines = BatchFourier::rows;
  BatchFourier::Work work() const { return BatchFourier::Work(batch_); }

  void apply(BatchFourier::Work& work, std::span<double* const> line, bool to_unit_weight) const {
    const auto count = static_cast<int>(line.size()), n = static_cast<int>(weights_.size());
    batch_.load_reals(work, line.data(), n, count);
    batch_.forward(work);
    batch_.multiply_even(work, response_.data());
    batch_.inverse(work);
    batch_.store_reals(work, count, n, 1, line.data());
    if (!to_unit_weight) return;
    for (double* const values : line)
      for (int i = 0; i < n; ++i) values[i] /= weights_[static_cast<std::size_t>(i)];
  }

 private:
  int reach_, padded_;
  BatchFourier batch_;
  Array<double> response_;
  Array<double> weights_;
};

void filter_rows(Field& z, const LineFilter& filter, bool to_unit_weight) {
  if (filter.idle()) return;
  for_each_block(static_cast<std::size_t>(z.ny()), LineFilter::lines,
                 [&](std::size_t first, std::size_t last) {
                   BatchFourier::Work work = filter.work();
                   std::vector<double*> lines;
                   for (std::size_t j = first; j < last; ++j)
                     lines.push_back(z.row(static_cast<int>(j)).data());
                   filter.apply(work, lines, to_unit_weight);
                 });
}

void filter_columns(Field& z, const LineFilter& filter, bool to_unit_weight) {
  if (filter.idle()) return;
  parallel_for((z.nx() + LineFilter::lines - 1) / LineFilter::lines, [&](std::int64_t turn) {
    BatchFourier::Work work = filter.work();
    const int first = static_cast<int>(turn) * LineFilter::lines;
    const int width = std::min(LineFilter::lines, z.nx() - first);
    Field columns(z.ny(), width);
    for (int j = 0; j < z.ny(); ++j)
      for (int c = 0; c < width; ++c) columns(j, c) = z(first + c, j);
    std::vector<double*> lines;
    for (int c = 0; c < width; ++c) lines.push_back(columns.row(c).data());
    filter.apply(work, lines, to_unit_weight);
    for (int j = 0; j < z.ny(); ++j)
      for (int c = 0; c < width; ++c) z(first + c, j) = columns(j, c);
  });
}

void keep_mean_surface(Field& z, const Grid& grid, double cut_off, bool to_unit_weight = true) {
  filter_rows(z, LineFilter(grid.nx, grid.hx(), cut_off), to_unit_weight);
  filter_columns(z, LineFilter(grid.ny, grid.hy(), cut_off), to_unit_weight);
}

void filter_with_rims(Field& z, const Grid& grid, const GaussianFilter& filter) {
  if (filter.short_wave) keep_mean_surface(z, grid, *filter.short_wave);
  if (!filter.long_wave) return;
  Field smooth = z;
  keep_mean_surface(smooth, grid, *filter.long_wave);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] -= smooth[k];
}

Field filter_periodic(Field z, const Grid& grid, const GaussianFilter& filter) {
  HalfSpectrum spectrum = fourier_forward(z);
  z = Field();
  const double unit_x = 2 * std::numbers::pi / grid.size_x, unit_y = 2 * std::numbers::pi / grid.size_y;
  parallel_for(spectrum.ny(), [&](std::int64_t row) {
    const int b = static_cast<int>(row);
    const double qy = unit_y * spectrum.wave_y(b);
    for (int a = 0; a < spectrum.bins_x(); ++a) {
      const double qx = unit_x * a;
      spectrum(a, b) *= kept(filter, qx * qx + qy * qy);
    }
  });
  return fourier_inverse(std::move(spectrum));
}

// Σ w z / Σ w over measured nodes, NaN elsewhere; `own`: additional weights.
Field mean_of_measured(const Field& z, const Grid& grid, bool periodic, double cut_off,
                       const Field* own = nullptr) {
  Field sum = z, weight = own ? *own : Field(z.nx(), z.ny(), 1);
  for (std::size_t k = 0; k < z.size(); ++k)
    if (std::isnan(z[k]))
      sum[k] = weight[k] = 0;
    else
      sum[k] *= weight[k];
  for (Field* const part : {&sum, &weight}) {
    if (periodic)
      *part = filter_periodic(std::move(*part), grid, {.short_wave = cut_off, .long_wave = {}});
    else
      keep_mean_surface(*part, grid, cut_off, false);
  }
  for (std::size_t k = 0; k < z.size(); ++k) sum[k] = std::isnan(z[k]) ? z[k] : sum[k] / weight[k];
  return sum;
}

double median_magnitude(const Field& residuals) {
  Array<double> magnitudes;
  magnitudes.reserve(residuals.size());
  for (const double r : residuals.values())
    if (!std::isnan(r)) magnitudes.push_back(std::abs(r));
  return upper_median(magnitudes);
}

Field robust_mean(const Field& z, const Grid& grid, bool periodic, double cut_off) {
  constexpr int most_iterations = 100;
  constexpr double settled = 1e-4;
  Field mean = mean_of_measured(z, grid, periodic, cut_off), weight(z.nx(), z.ny(), 1);
  double before = 0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    Field residuals = z;
    for (std::size_t k = 0; k < z.size(); ++k) residuals[k] -= mean[k];
    const double c = 4.4478 * median_magnitude(residuals);
    if (c == 0) {
      if (iteration == 0) return mean;  // flat
      throw Error(
          ErrorCode::not_converged,
          "more than half of the heights are exactly on their robust mean line, so their scatter is 0",
          "filter without `robust`, or mark outliers with `masked`");
    }
    if (iteration > 0 && std::abs(c - before) <= settled * c) return mean;
    before = c;
    for (std::size_t k = 0; k < z.size(); ++k) {
      const double r = residuals[k] / c;
      weight[k] = std::abs(r) < 1 ? (1 - r * r) * (1 - r * r) : 0;
    }
    const Field old = std::move(mean);
    mean = mean_of_measured(z, grid, periodic, cut_off, &weight);
    // No weight within reach.
    for (std::size_t k = 0; k < z.size(); ++k)
      if (!std::isfinite(mean[k]) && !std::isnan(z[k])) mean[k] = old[k];
  }
  throw Error(ErrorCode::not_converged,
              "the robust mean line still moves after " + std::to_string(most_iterations) + " iterations",
              "filter without `robust`, or take another `long_wave`");
}

void filter_measured(Field& z, const Grid& grid, bool periodic, const GaussianFilter& filter) {
  if (filter.short_wave) z = mean_of_measured(z, grid, periodic, *filter.short_wave);
  if (!filter.long_wave) return;
  const Field smooth = filter.robust ? robust_mean(z, grid, periodic, *filter.long_wave)
                                     : mean_of_measured(z, grid, periodic, *filter.long_wave);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] -= smooth[k];
}

// The mean bypasses the transforms, where it would cost digits.
Field filtered(Field z, const Grid& grid, bool periodic, bool holes, const GaussianFilter& filter) {
  const double mean = mean_of_known(z, holes);
  for (double& value : z.values()) value -= mean;
  if (holes || filter.robust)
    filter_measured(z, grid, periodic, filter);
  else if (periodic)
    z = filter_periodic(std::move(z), grid, filter);
  else
    filter_with_rims(z, grid, filter);
  if (!filter.long_wave)
    for (double& value : z.values()) value += mean;
  return z;
}

}  // namespace

Surface gaussian_filtered(const Surface& surface, const GaussianFilter& filter) {
  const GaussianFilter needed = checked(filter);
  if (!needed.short_wave && !needed.long_wave) return surface;
  SurfaceTraits traits = surface.traits();
  traits.aliased_share.reset();
  const bool holes = !surface.complete();
  return remade_with(holes, surface.grid(),
                     filtered(surface.measured_heights(), surface.grid(), traits.periodic, holes, needed),
                     traits);
}

Profile gaussian_filtered(const Profile& profile, const GaussianFilter& filter) {
  const GaussianFilter needed = checked(filter);
  if (!needed.short_wave && !needed.long_wave) return profile;
  const Grid grid{profile.size(), 1, profile.length(), profile.spacing()};
  const bool holes = !profile.complete();
  const Field z = filtered(line_of(profile), grid, profile.closed(), holes, needed);
  return remade_with(holes, profile.spacing(), samples_of(z), profile.closed_radius());
}

}  // namespace asperity

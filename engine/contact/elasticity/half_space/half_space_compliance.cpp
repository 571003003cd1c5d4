// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/half_space_compliance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/contact/elasticity/half_space/love_kernel.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/fourier.hpp"
#include "engine/core/fourier_filter.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

namespace {

int period(int n, Boundary boundary) {
  return boundary == Boundary::periodic ? n : good_fourier_length(2 * n - 1);
}

// 2/|q| for waves 0 … period/2, the y wave running fastest; 0 for the mean.
void periodic_multiplier(int nx, int ny, double aspect, std::span<double> multiplier) {
  const int bins_x = nx / 2 + 1, bins_y = ny / 2 + 1;
  parallel_for(bins_x, [&](std::int64_t a) {
    const double qx = 2 * std::numbers::pi * static_cast<double>(a) / nx;
    double* const column = multiplier.data() + a * bins_y;
    for (int b = 0; b < bins_y; ++b) {
      const double qy = 2 * std::numbers::pi * b / (ny * aspect);
      column[b] = a == 0 && b == 0 ? 0 : 2 / std::hypot(qx, qy);
    }
  });
}

// The transform of an even sequence, given from 0 to period/2, is real; it replaces it.
void transform_even(std::span<double> half, int period) {
  Array<double> whole(static_cast<std::size_t>(period));
  for (int k = 0; k < period; ++k)
    whole[static_cast<std::size_t>(k)] = half[static_cast<std::size_t>(std::min(k, period - k))];
  const auto bins = fourier_forward(whole);
  std::transform(bins.begin(), bins.end(), half.begin(), [](std::complex<double> bin) { return bin.real(); });
}

// Love's coefficients at all distances up to half the padded period, evenly continued, transformed. The
// distances that no pair of nodes has are multiplied with zeros only.
void free_multiplier(int period_x, int period_y, double aspect, std::span<double> multiplier) {
  const LoveKernel love(aspect);
  const int bins_x = period_x / 2 + 1, bins_y = period_y / 2 + 1;
  constexpr int rows_per_block = 8;
  parallel_for((bins_y + rows_per_block - 1) / rows_per_block, [&](std::int64_t block) {
    const int first = static_cast<int>(block) * rows_per_block;
    const int rows = std::min(rows_per_block, bins_y - first);
    const auto row_length = static_cast<std::size_t>(bins_x);
    Array<double> values(row_length * rows_per_block);
    for (int j = 0; j < rows; ++j) {
      const std::span row(values.data() + static_cast<std::size_t>(j) * row_length, row_length);
      for (int i = 0; i < bins_x; ++i) row[static_cast<std::size_t>(i)] = love(i, first + j);
      transform_even(row, period_x);
    }
    for (std::size_t a = 0; a < row_length; ++a)
      for (int j = 0; j < rows; ++j)
        multiplier[a * static_cast<std::size_t>(bins_y) + static_cast<std::size_t>(first + j)] =
            values[static_cast<std::size_t>(j) * row_length + a];
  });
  parallel_for(bins_x, [&](std::int64_t a) {
    transform_even(multiplier.subspan(static_cast<std::size_t>(a) * static_cast<std::size_t>(bins_y),
                                      static_cast<std::size_t>(bins_y)),
                   period_y);
  });
}

}  // namespace

struct HalfSpaceCompliance::Parts {
  int period_x, period_y;
  Boundary boundary;
  double weight;
  FourierFilter filter;
  Array<double> multiplier;  // the y wave runs fastest

  Parts(int nx, int ny, double aspect, Boundary boundary_, double weight_)
      : period_x(period(nx, boundary_)),
        period_y(period(ny, boundary_)),
        boundary(boundary_),
        weight(weight_),
        filter(nx, ny, period_x, period_y),
        multiplier(static_cast<std::size_t>(period_x / 2 + 1) * static_cast<std::size_t>(period_y / 2 + 1)) {
    if (boundary == Boundary::periodic)
      periodic_multiplier(nx, ny, aspect, multiplier);
    else
      free_multiplier(period_x, period_y, aspect, multiplier);
  }

  std::span<const double> column(int a) const {
    const auto length = static_cast<std::size_t>(period_y / 2 + 1);
    return std::span(multiplier).subspan(static_cast<std::size_t>(a) * length, length);
  }
};

HalfSpaceCompliance::HalfSpaceCompliance(int nx, int ny, double aspect, Boundary boundary, double weight)
    : parts_(std::make_unique<Parts>(nx, ny, aspect, boundary, weight)) {}

HalfSpaceCompliance::~HalfSpaceCompliance() = default;
HalfSpaceCompliance::HalfSpaceCompliance(HalfSpaceCompliance&&) noexcept = default;
HalfSpaceCompliance& HalfSpaceCompliance::operator=(HalfSpaceCompliance&&) noexcept = default;

void HalfSpaceCompliance::apply(std::span<const double> p, std::span<double> u) {
  parts_->filter.apply(p, u, [this](int a, std::span<double> factors) {
    const auto column = parts_->column(a);
    std::copy(column.begin(), column.end(), factors.begin());
  });
  cost::count_transforms(2 * parts_->weight);
}

void HalfSpaceCompliance::apply_inverse(std::span<const double> u, std::span<double> p) {
  if (parts_->boundary == Boundary::free)
    throw Error(ErrorCode::internal, "a free half-space has no inverse filter");
  parts_->filter.apply(u, p, [this](int a, std::span<double> factors) {
    const auto column = parts_->column(a);
    std::transform(column.begin(), column.end(), factors.begin(),
                   [](double compliance) { return compliance > 0 ? 1 / compliance : 0; });
  });
  cost::count_transforms(2 * parts_->weight);
}

double HalfSpaceCompliance::transform_work() const {
  const double n = static_cast<double>(parts_->period_x) * parts_->period_y;
  return n * std::log2(std::max(n, 2.0));
}

std::int64_t HalfSpaceCompliance::bytes(int nx, int ny, Boundary boundary) {
  const int period_x = period(nx, boundary), period_y = period(ny, boundary);
  return FourierFilter::bytes(nx, ny, period_x, period_y) +
         static_cast<std::int64_t>(sizeof(double)) * (period_x / 2 + 1) * (period_y / 2 + 1);
}

}  // namespace asperity

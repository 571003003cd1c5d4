// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/preconditioner/smooth_extension.hpp"

#include <algorithm>

namespace asperity {

namespace {
// Nodes from point to point, and the share of a hat's own mass that free nodes compete with: measured, and
// twice as much or half of either changes little.
constexpr int spacing = 32;
constexpr double reluctance = 0.03;

struct Pair {
  double left, right;
};

// Sums of values·(1 − share) and of values·share.
template <class Real>
Pair weighed(const Real* __restrict values, const Real* __restrict share, int n) {
  constexpr int lanes = 8;
  Real left[lanes] = {}, right[lanes] = {};
  int k = 0;
  for (; k + lanes <= n; k += lanes)
    for (int l = 0; l < lanes; ++l) {
      left[l] += values[k + l] * (1 - share[k + l]);
      right[l] += values[k + l] * share[k + l];
    }
  Pair sums{};
  for (int l = 0; l < lanes; ++l) {
    sums.left += static_cast<double>(left[l]);
    sums.right += static_cast<double>(right[l]);
  }
  for (; k < n; ++k) {
    sums.left += static_cast<double>(values[k] * (1 - share[k]));
    sums.right += static_cast<double>(values[k] * share[k]);
  }
  return sums;
}
}  // namespace

HatAxis::HatAxis(int nodes, Boundary boundary) : wraps(boundary == Boundary::periodic) {
  const int steps = std::max(1, nodes / spacing);
  const auto count = static_cast<std::size_t>(nodes);
  hats = wraps ? steps : steps + 1;
  before.resize(count);
  share.resize(count);
  single_share.resize(count);
  end.resize(static_cast<std::size_t>(hats));
  mass.resize(static_cast<std::size_t>(hats));
  for (int k = 0; k < nodes; ++k) {
    // From rim to rim, the rim being half a cell beyond the last node.
    const double place = (wraps ? k : k + 0.5) * steps / nodes;
    const int hat = std::min(static_cast<int>(place), steps - 1);
    const auto node = static_cast<std::size_t>(k);
    before[node] = hat;
    share[node] = place - hat;
    single_share[node] = static_cast<float>(place - hat);
    end[static_cast<std::size_t>(hat)] = k + 1;
    mass[static_cast<std::size_t>(hat)] += 1 - (place - hat);
    mass[static_cast<std::size_t>(next(hat))] += place - hat;
  }
}

SmoothExtension::SmoothExtension(int nx, int ny, Boundary boundary) : x_(nx, boundary), y_(ny, boundary) {}

std::int64_t SmoothExtension::field_bytes(int nx, int ny) {
  return static_cast<std::int64_t>(sizeof(float) + sizeof(double)) * nx * (ny / spacing + 1);
}

double SmoothExtension::divisor(std::size_t hat, double free) const {
  const auto i = hat % static_cast<std::size_t>(x_.hats), j = hat / static_cast<std::size_t>(x_.hats);
  return free + reluctance * x_.mass[i] * y_.mass[j];
}

template <class Real>
SmoothExtension::Field<Real>::Field(const SmoothExtension& hats)
    : hats_(&hats), rows_(hats.x_.before.size() * static_cast<std::size_t>(hats.y_.hats)) {}

template <class Real>
void SmoothExtension::Field<Real>::set(std::span<const double> at_points) {
  const HatAxis& along = hats_->x_;
  const std::size_t nx = along.before.size();
  for (int j = 0; j < hats_->y_.hats; ++j) {
    Real* const to = rows_.data() + static_cast<std::size_t>(j) * nx;
    for (std::size_t k = 0; k < nx;) {
      const int hat = along.before[k];
      const double left = at_points[hats_->hat(hat, j)],
                   rise = at_points[hats_->hat(along.next(hat), j)] - left;
      const auto stop = static_cast<std::size_t>(along.end[static_cast<std::size_t>(hat)]);
      for (; k < stop; ++k) to[k] = static_cast<Real>(left + along.share[k] * rise);
    }
  }
}

SmoothExtension::Sums::Sums(const SmoothExtension& hats, int x, int y, int width, int height)
    : hats_(&hats), x_(x), y_(y), width_(width) {
  const auto count = [](const HatAxis& axis, int first, int n) {
    return axis.before[static_cast<std::size_t>(first + n - 1)] -
           axis.before[static_cast<std::size_t>(first)] + 2;
  };
  columns_ = count(hats.x_, x, width);
  rows_ = count(hats.y_, y, height);
  sums_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
}

void SmoothExtension::Sums::clear() {
  std::fill(sums_.begin(), sums_.end(), 0.0);
  band_ = -1;
}

template <class Work>
SmoothExtension::Sums::Row<Work> SmoothExtension::Sums::row(int y, std::span<Work> work) {
  const int band = hats_->y_.before[static_cast<std::size_t>(y)];
  if (band != band_) {
    finish(work);
    band_ = band;
    std::fill_n(work.data(), 2 * width_, Work{});
  }
  const Work up = hats_->y_.shares<Work>()[y];
  return {work.data(), work.data() + width_, 1 - up, up};
}

template <class Work>
void SmoothExtension::Sums::finish(std::span<Work> work) {
  if (band_ < 0) return;
  const HatAxis& along = hats_->x_;
  const Work* const share = along.shares<Work>() + x_;
  const int first = along.before[static_cast<std::size_t>(x_)];
  const int first_row = hats_->y_.before[static_cast<std::size_t>(y_)];
  for (int half = 0; half < 2; ++half) {
    const Work* const values = work.data() + half * width_;
    double* const to = sums_.data() + static_cast<std::ptrdiff_t>(band_ - first_row + half) * columns_;
    for (int k = 0, i = 0; k < width_; ++i) {
      const int stop = std::min(width_, along.end[static_cast<std::size_t>(first + i)] - x_);
      const Pair sums = weighed(values + k, share + k, stop - k);
      to[i] += sums.left;
      to[i + 1] += sums.right;
      k = stop;
    }
  }
  band_ = -1;
}

void SmoothExtension::Sums::add_to(Array<double>& total) const {
  const HatAxis &along = hats_->x_, &across = hats_->y_;
  const auto place = [](const HatAxis& axis, int first, int k) {
    return axis.wraps ? (first + k) % axis.hats : first + k;
  };
  const int first_column = along.before[static_cast<std::size_t>(x_)];
  const int first_row = across.before[static_cast<std::size_t>(y_)];
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i)
      total[hats_->hat(place(along, first_column, i), place(across, first_row, j))] +=
          sums_[static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) +
                static_cast<std::size_t>(i)];
}

template class SmoothExtension::Field<float>;
template class SmoothExtension::Field<double>;
template SmoothExtension::Sums::Row<float> SmoothExtension::Sums::row(int, std::span<float>);
template SmoothExtension::Sums::Row<double> SmoothExtension::Sums::row(int, std::span<double>);
template void SmoothExtension::Sums::finish(std::span<float>);
template void SmoothExtension::Sums::finish(std::span<double>);

}  // namespace asperity

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/smooth_extension.hpp"

#include <algorithm>

namespace asperity {

namespace {
// Nodes from point to point, and the share of a hat's own mass that free nodes compete with: measured, and
// twice as much or half of either changes little.
constexpr int spacing = 32;
constexpr double reluctance = 0.03;
}  // namespace

HatAxis::HatAxis(int nodes, Boundary boundary) : wraps(boundary == Boundary::periodic) {
  const int steps = std::max(1, nodes / spacing);
  hats = wraps ? steps : steps + 1;
  before.resize(static_cast<std::size_t>(nodes));
  share.resize(before.size());
  end.resize(static_cast<std::size_t>(hats));
  mass.resize(static_cast<std::size_t>(hats));
  for (int k = 0; k < nodes; ++k) {
    // From rim to rim, the rim being half a cell beyond the last node.
    const double place = (wraps ? k : k + 0.5) * steps / nodes;
    const int hat = std::min(static_cast<int>(place), steps - 1);
    const auto node = static_cast<std::size_t>(k);
    before[node] = hat;
    end[static_cast<std::size_t>(hat)] = k + 1;
    share[node] = static_cast<float>(place - hat);
    mass[static_cast<std::size_t>(hat)] += 1 - (place - hat);
    mass[static_cast<std::size_t>(next(hat))] += place - hat;
  }
}

SmoothExtension::SmoothExtension(int nx, int ny, Boundary boundary) : x_(nx, boundary), y_(ny, boundary) {}

double SmoothExtension::divisor(std::size_t hat, double free) const {
  const auto i = hat % static_cast<std::size_t>(x_.hats), j = hat / static_cast<std::size_t>(x_.hats);
  return free + reluctance * x_.mass[i] * y_.mass[j];
}

void SmoothExtension::row(std::span<const float> field, int y, int x, int n, float* __restrict to) const {
  const int j = y_.before[static_cast<std::size_t>(y)];
  const float up = y_.share[static_cast<std::size_t>(y)];
  const float* const low = field.data() + hat(0, j);
  const float* const high = field.data() + hat(0, y_.next(j));
  const auto point = [&](int i) { return low[i] + up * (high[i] - low[i]); };
  const float* const share = x_.share.data();
  float* const at = to - x;
  for (int k = x, i = x_.before[static_cast<std::size_t>(x)]; k < x + n; ++i) {
    const float left = point(i), rise = point(x_.next(i)) - left;
    const int end = std::min(x + n, x_.end[static_cast<std::size_t>(i)]);
    for (; k < end; ++k) at[k] = left + share[k] * rise;
  }
}

namespace {
struct Pair {
  double left, right;
};

// Sums of values·(1 − share) and of values·share.
Pair weighed(const float* __restrict values, const float* __restrict share, int n) {
  constexpr int lanes = 8;
  float all[lanes] = {}, right[lanes] = {};
  int k = 0;
  for (; k + lanes <= n; k += lanes)
    for (int l = 0; l < lanes; ++l) {
      all[l] += values[k + l];
      right[l] += values[k + l] * share[k + l];
    }
  double sum = 0, to_the_right = 0;
  for (int l = 0; l < lanes; ++l) {
    sum += static_cast<double>(all[l]);
    to_the_right += static_cast<double>(right[l]);
  }
  for (; k < n; ++k) {
    sum += static_cast<double>(values[k]);
    to_the_right += static_cast<double>(values[k] * share[k]);
  }
  return {sum - to_the_right, to_the_right};
}
}  // namespace

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

void SmoothExtension::Sums::add(int y, const float* __restrict values, std::span<float> work) {
  const int band = hats_->y_.before[static_cast<std::size_t>(y)];
  float* __restrict low = work.data(), * __restrict high = low + width_;
  if (band != band_) {
    flush(work);
    band_ = band;
    std::fill_n(low, 2 * width_, 0.0f);
  }
  const float up = hats_->y_.share[static_cast<std::size_t>(y)], down = 1 - up;
  for (int k = 0; k < width_; ++k) {
    low[k] += down * values[k];
    high[k] += up * values[k];
  }
}

void SmoothExtension::Sums::flush(std::span<float> work) {
  if (band_ < 0) return;
  const HatAxis& along = hats_->x_;
  const float* const share = along.share.data() + x_;
  const int first = along.before[static_cast<std::size_t>(x_)];
  const int first_row = hats_->y_.before[static_cast<std::size_t>(y_)];
  for (int half = 0; half < 2; ++half) {
    const float* const values = work.data() + half * width_;
    double* const to = sums_.data() + static_cast<std::ptrdiff_t>(band_ - first_row + half) * columns_;
    for (int k = 0, i = 0; k < width_; ++i) {
      const int end = std::min(width_, along.end[static_cast<std::size_t>(first + i)] - x_);
      const Pair sums = weighed(values + k, share + k, end - k);
      to[i] += sums.left;
      to[i + 1] += sums.right;
      k = end;
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

}  // namespace asperity

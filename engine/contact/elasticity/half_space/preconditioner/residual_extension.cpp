// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/preconditioner/residual_extension.hpp"

#include <algorithm>

#include "engine/core/parallel.hpp"

namespace asperity {

namespace {
// Nodes between points; share of a hat's mass. Factors of two change little.
constexpr int spacing = 32;
constexpr double reluctance = 0.03;

struct Pair {
  double left, right;
};

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

// Lines beat sweeps from here; measured on 96 × 96 cells, aspect 4 to 1000.
constexpr double long_cells = 25, long_cells_of_free_tile = 50;

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
    // The free rim: half a cell beyond the nodes.
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

bool LineExtension::serves(double aspect, Boundary boundary) {
  const double longest = boundary == Boundary::periodic ? long_cells : long_cells_of_free_tile;
  return aspect >= longest || aspect * longest <= 1;
}

LineExtension::LineExtension(int nx, int ny, Boundary boundary, bool along_x)
    : lines_(along_x ? ny : nx),
      length_(along_x ? nx : ny),
      line_step_(along_x ? static_cast<std::size_t>(nx) : 1),
      node_step_(along_x ? 1 : static_cast<std::size_t>(nx)),
      wraps_(boundary == Boundary::periodic),
      begin_(static_cast<std::size_t>(lines_) + 1),
      beside_(static_cast<std::size_t>(lines_)) {
  free_.reserve(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
}

void LineExtension::set_free(std::span<const std::uint8_t> free) {
  free_.clear();
  for (int line = 0; line < lines_; ++line) {
    begin_[static_cast<std::size_t>(line)] = free_.size();
    for (int k = 0; k < length_; ++k)
      if (free[place(line, k)] != 0) free_.push_back(k);
  }
  begin_[static_cast<std::size_t>(lines_)] = free_.size();

  std::vector<int> held;  // with free nodes
  for (int line = 0; line < lines_; ++line)
    if (!free_of(line).empty()) held.push_back(line);
  std::fill(beside_.begin(), beside_.end(), Beside{});
  if (held.empty()) return;
  std::size_t next = 0;
  for (int line = 0; line < lines_; ++line) {
    while (next < held.size() && held[next] < line) ++next;
    Beside& beside = beside_[static_cast<std::size_t>(line)];
    if (next < held.size() && held[next] == line) {
      beside = {line, line, 0};
      continue;
    }
    int low = next > 0 ? held[next - 1] : held.back() - lines_;
    int high = next < held.size() ? held[next] : held.front() + lines_;
    if (!wraps_) {
      low = std::max(low, 0) == low ? low : high;
      high = high < lines_ ? high : low;
    }
    const float share = high > low ? static_cast<float>(line - low) / static_cast<float>(high - low) : 0.0f;
    beside = {(low + lines_) % lines_, high % lines_, share};
  }
}

template <class Share>
void LineExtension::each_between(int line, const Share& share) const {
  const std::span<const int> free = free_of(line);
  const auto stretch = [&](int low, int high, int from, int to, int low_place, int high_place) {
    for (int k = from; k < to; ++k)
      share(k % length_, low_place, high_place,
            high > low ? static_cast<float>(k - low) / static_cast<float>(high - low) : 0.0f);
  };
  for (std::size_t i = 0; i + 1 < free.size(); ++i)
    stretch(free[i], free[i + 1], free[i] + 1, free[i + 1], free[i], free[i + 1]);
  const int first = free.front(), last = free.back();
  if (wraps_) {
    stretch(last, first + length_, last + 1, first + length_, last, first);
  } else {
    stretch(first, first, 0, first, first, first);
    stretch(last, last, last + 1, length_, last, last);
  }
}

void LineExtension::extend(std::span<float> field) const {
  parallel_for(lines_, [&](std::int64_t l) {
    const int line = static_cast<int>(l);
    if (free_of(line).empty()) return;
    each_between(line, [&](int k, int low, int high, float t) {
      field[place(line, k)] = (1 - t) * field[place(line, low)] + t * field[place(line, high)];
    });
  });
  parallel_for(lines_, [&](std::int64_t l) {
    const int line = static_cast<int>(l);
    if (!free_of(line).empty()) return;
    const Beside& beside = beside_[static_cast<std::size_t>(line)];
    for (int k = 0; k < length_; ++k)
      field[place(line, k)] = beside.low < 0 ? 0.0f
                                             : (1 - beside.share) * field[place(beside.low, k)] +
                                                   beside.share * field[place(beside.high, k)];
  });
}

void LineExtension::gather(std::span<float> field) const {
  // Serial: several lines add to one.
  for (int line = 0; line < lines_; ++line) {
    const Beside& beside = beside_[static_cast<std::size_t>(line)];
    if (beside.low == line) continue;
    for (int k = 0; k < length_; ++k) {
      const float value = field[place(line, k)];
      if (beside.low >= 0) {
        field[place(beside.low, k)] += (1 - beside.share) * value;
        field[place(beside.high, k)] += beside.share * value;
      }
      field[place(line, k)] = 0;
    }
  }
  parallel_for(lines_, [&](std::int64_t l) {
    const int line = static_cast<int>(l);
    if (free_of(line).empty()) return;
    each_between(line, [&](int k, int low, int high, float t) {
      const float value = field[place(line, k)];
      field[place(line, low)] += (1 - t) * value;
      field[place(line, high)] += t * value;
      field[place(line, k)] = 0;
    });
  });
}

}  // namespace asperity

// SPDX-License-Identifier: GPL-3.0-or-later
// Sweeps run tile by tile, with a margin as wide as the number of sweeps, so tiles are independent and stay
// in cache. The transpose distributes each node's value to its neighbours: v = D (y + N v), colours in
// reverse order, N the sum of the four neighbours, D = 1/4 off the free set, 0 on it (two and 1/2 on a line
// of nodes).
#include "engine/contact/elasticity/half_space/preconditioner/contact_preconditioner.hpp"

#include <cmath>

#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

namespace {

using namespace edge_rows;

// Cells. On 512²: at 10 cells up to three times the transforms with extension, at 100 up to twice without.
constexpr double thin_layer = 20;
bool carries_on(const ComplianceMultiplier& multiplier) { return multiplier.length >= thin_layer; }

void take(const ContactPreconditioner::Step& step, std::size_t k, std::size_t n) {
  if (step.length != 0) add_times(step.length, step.more + k, n, step.values + k);
}
}  // namespace

ContactPreconditioner::ContactPreconditioner(int nx, int ny, double aspect, Boundary boundary, double weight,
                                             int sweeps, const ComplianceMultiplier& multiplier)
    : nx_(nx),
      ny_(ny),
      share_(nx == 1 || ny == 1 ? 0.5f : 0.25f),
      pyramid_(nx, ny, aspect, boundary, weight, multiplier),
      smooth_(nx, ny, boundary),
      free_hats_(smooth_.size()),
      sums_(smooth_.size()),
      level_(smooth_),
      rest_(smooth_),
      tiles_(nx, ny, boundary, sweeps),
      tiled_(carries_on(multiplier) && !LineExtension::serves(aspect, boundary)) {
  if (!tiled_) {
    if (carries_on(multiplier)) lines_.emplace(nx, ny, boundary, aspect > 1);
    gathered_.resize(tiles_.nodes());
    no_smooth_field();
    return;
  }
  for (std::size_t k = 0; k < tiles_.count(); ++k) {
    const FreeTile& tile = tiles_[k];
    const SmoothExtension::Sums sums(smooth_, tile.x, tile.y, tile.width, tile.height);
    hats_.push_back({sums, sums});
  }
}

// Calls put(row start, column, node, length) for the parts of a patch on the grid; other places are 0. The
// next row must be 0 too: a taller tile may have written it. Sweeps reach no other old values.
template <class Put>
void ContactPreconditioner::load(Patch& patch, const FreeTile& tile, const Put& put) const {
  const int height = tiles_.patch_height(tile);
  for (int j = 0; j < height; ++j) {
    const std::size_t place = tiles_.patch_row(j);
    if (tiles_.bounded()) std::fill_n(patch.now.data() + place, tiles_.row_places(), 0.0f);
    tiles_.each_run(tile, j, [&](std::size_t column, std::size_t from, std::size_t length) {
      put(place, column, from, length);
    });
  }
  std::fill_n(patch.now.data() + tiles_.patch_row(height), tiles_.row_places(), 0.0f);
}

void ContactPreconditioner::set_free(std::span<const std::uint8_t> free) {
  if (!tiled_) {
    tiles_.set(free, [](std::size_t) {});
    if (lines_) lines_->set_free(free);
    return;
  }
  tiles_.set(free, [&](std::size_t number) {
    const FreeTile& tile = tiles_[number];
    SmoothExtension::Sums& hats = hats_[number].free;
    std::array<double, 2 * FreeTiles::width> sums;
    hats.clear();
    for (int j = tile.y; j < tile.y + tile.height && tile.holds_free; ++j)
      add_marks(tiles_.marks(node(tile.x, j)), static_cast<std::size_t>(tile.width),
                hats.row<double>(j, sums));
    hats.finish<double>(sums);
  });
  std::fill(free_hats_.begin(), free_hats_.end(), 0.0);
  for (const Hats& hats : hats_) hats.free.add_to(free_hats_);
}

template <class Add>
void ContactPreconditioner::add_up_hats(const Add& add, Array<double>& total) {
  parallel_for(static_cast<std::int64_t>(tiles_.count()), [&](std::int64_t k) {
    const auto number = static_cast<std::size_t>(k);
    SmoothExtension::Sums& hats = hats_[number].passed;
    const auto patch = borrow();
    hats.clear();
    add(number, *patch);
    hats.finish<float>(patch->sums);
  });
  std::fill(total.begin(), total.end(), 0.0);
  for (const Hats& hats : hats_) hats.passed.add_to(total);
}

void ContactPreconditioner::divide(Array<double>& sums) const {
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] /= smooth_.divisor(k, free_hats_[k]);
}

void ContactPreconditioner::extend(const FreeTile& tile, const Residual& r) {
  const auto width = static_cast<std::size_t>(tile.width);
  float* const extended = pyramid_.input().data();
  if (tile.reaches_free && !tile.swept) {  // all nodes are free
    for (int j = tile.y; j < tile.y + tile.height; ++j) {
      const std::size_t k = node(tile.x, j);
      convert(r.values + k, r.factor, r.offset, width, extended + k);
    }
    return;
  }
  if (!tile.reaches_free) {
    for (int j = tile.y; j < tile.y + tile.height; ++j)
      fill(level_.row(j, static_cast<std::size_t>(tile.x)), width, extended + node(tile.x, j));
    return;
  }
  const auto patch = borrow();
  const auto nx = static_cast<std::size_t>(nx_);
  load(*patch, tile, [&](std::size_t row, std::size_t column, std::size_t from, std::size_t length) {
    start_free(tiles_.marks(from), r.values + from, r.factor, r.offset,
               level_.row(static_cast<int>(from / nx), from % nx), length, column,
               static_cast<std::size_t>(tiles_.half()), patch->now.data() + row);
  });
  // Step s changes nodes up to s steps away.
  for (int s = 1; s <= tiles_.sweeps(); ++s)
    for (const int odd : {0, 1})
      sweep_groups(tile.groups[s % 2][odd].within(s), odd != 0, tiles_.half(), share_, patch->now.data());
  for (int j = 0; j < tile.height; ++j) {
    merge(patch->now.data() + tiles_.core_row(j), tiles_.half(),
          level_.row(tile.y + j, static_cast<std::size_t>(tile.x)), width,
          extended + node(tile.x, tile.y + j));
  }
}

// z = (y + N v) on the free set without the smooth field, whose source goes to the hats.
void ContactPreconditioner::gather_back(std::size_t number, Patch& patch, std::span<const float> y,
                                        const Keep& keep) {
  const FreeTile& tile = tiles_[number];
  SmoothExtension::Sums& hats = hats_[number].passed;
  const auto width = static_cast<std::size_t>(tile.width);
  if (!tile.holds_free) {
    for (int j = tile.y; j < tile.y + tile.height; ++j) {
      const std::size_t k = node(tile.x, j);
      add_values(y.data() + k, width, hats.row<float>(j, patch.sums));
      keep(number, k, width, nullptr, 0);
    }
    return;
  }
  if (tile.swept) {
    load(patch, tile, [&](std::size_t row, std::size_t column, std::size_t from, std::size_t length) {
      start_bound(y.data() + from, length, column, static_cast<std::size_t>(tiles_.half()),
                  patch.given.data() + row, patch.now.data() + row);
    });
    for (int s = tiles_.sweeps(); s >= 1; --s)
      for (const int odd : {0, 1})
        sweep_back_groups(tile.groups[s % 2][odd].within(s), odd != 0, tiles_.half(), share_,
                          patch.given.data(), patch.now.data());
  }
  float sum[FreeTiles::width];
  for (int j = 0; j < tile.height; ++j) {
    const std::size_t k = node(tile.x, tile.y + j);
    if (tile.swept) {
      add_neighbours(tiles_.marks(k), y.data() + k, patch.now.data() + tiles_.core_row(j), tiles_.half(),
                     width, sum);
    } else {
      std::copy_n(y.data() + k, width, sum);
    }
    add_difference(y.data() + k, sum, width, hats.row<float>(tile.y + j, patch.sums));
    keep(number, k, width, sum, grow_);
  }
}

void ContactPreconditioner::no_smooth_field() {
  std::fill(sums_.begin(), sums_.end(), 0.0);
  rest_.set(sums_);
  rest_sum_ = 0;
}

double ContactPreconditioner::spread_along_lines(const Residual& r, const Step& step) {
  parallel_for(ny_, [&](std::int64_t j) {
    const std::size_t begin = node(0, static_cast<int>(j));
    take(step, begin, static_cast<std::size_t>(nx_));
    const std::uint8_t* const free = tiles_.marks(begin);
    float* const to = pyramid_.input().data() + begin;
    for (std::size_t i = 0; i < static_cast<std::size_t>(nx_); ++i)
      to[i] = free[i] != 0 ? static_cast<float>(r.offset + r.factor * r.values[begin + i]) : 0.0f;
  });
  if (lines_) lines_->extend(pyramid_.input());
  spread_ = pyramid_.apply();
  return pyramid_.product() * grow_ * grow_;
}

void ContactPreconditioner::gather_along_lines(const Keep& keep) {
  if (lines_) {
    std::copy(spread_.begin(), spread_.end(), gathered_.begin());
    lines_->gather(gathered_);
  } else {
    parallel_for(ny_, [&](std::int64_t j) {
      const std::size_t begin = node(0, static_cast<int>(j)), end = begin + static_cast<std::size_t>(nx_);
      const std::uint8_t* const free = tiles_.marks(0);
      for (std::size_t k = begin; k < end; ++k) gathered_[k] = free[k] != 0 ? spread_[k] : 0.0f;
    });
  }
  for (int j = 0; j < ny_; ++j)
    keep(0, node(0, j), static_cast<std::size_t>(nx_), gathered_.data() + node(0, j), grow_);
}

// Estimated from a few rows, or all if these are 0.
double ContactPreconditioner::greatest(const Residual& r, const Step& step) const {
  constexpr int few = 32;
  const auto width = static_cast<std::size_t>(nx_);
  for (const int stride : {std::max(1, ny_ / few), 1}) {
    double most = 0;
    for (int j = 0; j < ny_; j += stride) {
      const std::uint8_t* const free = tiles_.marks(node(0, j));
      const double* const values = r.values + node(0, j);
      const double* const more = step.more ? step.more + node(0, j) : values;
      for (std::size_t i = 0; i < width; ++i) {
        const double stepped = values[i] + step.length * more[i];
        const double value = std::abs(r.offset + r.factor * stepped), counted = free[i] != 0 ? value : 0.0;
        most = counted > most ? counted : most;
      }
    }
    if (most > 0) return most;
  }
  return 0;
}

double ContactPreconditioner::spread(const Residual& r, const Step& step) {
  // Exact scaling to near 1: single precision has little range.
  const double most = greatest(r, step);
  spread_ = {};
  if (!(most > 0)) {
    parallel_for(ny_, [&](std::int64_t j) {
      take(step, node(0, static_cast<int>(j)), static_cast<std::size_t>(nx_));
    });
    return 0;
  }
  const int exponent = std::clamp(std::ilogb(most), -1000, 1000);
  const double shrink = std::ldexp(1.0, -exponent);
  grow_ = std::ldexp(1.0, exponent);
  const Residual near_one{r.values, r.factor * shrink, r.offset * shrink};
  if (!tiled_) return spread_along_lines(near_one, step);
  const auto pass_on_residual = [&](std::size_t number, Patch& patch) {
    const FreeTile& tile = tiles_[number];
    SmoothExtension::Sums& hats = hats_[number].passed;
    const auto width = static_cast<std::size_t>(tile.width);
    for (int j = tile.y; j < tile.y + tile.height; ++j) {
      const std::size_t k = node(tile.x, j);
      take(step, k, width);
      if (!tile.holds_free) continue;
      add_residual(tiles_.marks(k), near_one.values + k, near_one.factor, near_one.offset, width,
                   hats.row<float>(j, patch.sums));
    }
  };
  add_up_hats(pass_on_residual, sums_);
  divide(sums_);
  level_.set(sums_);
  parallel_for(static_cast<std::int64_t>(tiles_.count()),
               [&](std::int64_t k) { extend(tiles_[static_cast<std::size_t>(k)], near_one); });
  spread_ = pyramid_.apply();
  // Ext is the transpose of gather(): r·z = Ext r·B Ext r.
  return pyramid_.product() * grow_ * grow_;
}

void ContactPreconditioner::gather(const Keep& keep) {
  if (spread_.empty()) {
    for (int j = 0; j < ny_; ++j) keep(0, node(0, j), static_cast<std::size_t>(nx_), nullptr, 0);
    no_smooth_field();
    return;
  }
  if (!tiled_) {
    gather_along_lines(keep);
    return;
  }
  // Ext = L (1 − C) + C, sweeps L, smooth field C: Extᵀ y = Lᵀ y + Cᵀ (y − Lᵀ y).
  add_up_hats([&](std::size_t number, Patch& patch) { gather_back(number, patch, spread_, keep); }, sums_);
  divide(sums_);
  rest_.set(sums_);
  rest_sum_ = 0;
  for (std::size_t k = 0; k < sums_.size(); ++k) rest_sum_ += sums_[k] * free_hats_[k];
}

void ContactPreconditioner::add_smooth(std::span<double> z) const {
  parallel_for(ny_, [&](std::int64_t j) {
    const std::size_t begin = node(0, static_cast<int>(j));
    add_free(tiles_.marks(begin), smooth(static_cast<int>(j), 1), static_cast<std::size_t>(nx_),
             z.data() + begin);
  });
}

void ContactPreconditioner::apply(std::span<const double> r, std::span<double> z) {
  if (r.size() != tiles_.nodes() || z.size() != tiles_.nodes())
    throw Error(ErrorCode::internal, "a preconditioner of another grid's values");
  spread(Residual{r.data()}, {});
  gather([&](std::size_t, std::size_t first, std::size_t n, const float* values, double factor) {
    if (values)
      convert(values, factor, n, z.data() + first);
    else
      std::fill_n(z.data() + first, n, 0.0);
  });
  add_smooth(z);
}

}  // namespace asperity

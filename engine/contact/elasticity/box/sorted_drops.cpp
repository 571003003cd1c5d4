// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/box/sorted_drops.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

void sort_ascending(Array<double>& values) {
  constexpr std::size_t small = 2048;  // below, comparing is faster
  if (values.size() < small) {
    std::sort(values.begin(), values.end());
    return;
  }
  constexpr int passes = 6, bits = 11;
  constexpr std::size_t buckets = std::size_t{1} << bits;
  auto digit = [](double value, int pass) {
    return static_cast<std::size_t>(std::bit_cast<std::uint64_t>(value) >> (pass * bits)) & (buckets - 1);
  };

  std::vector<std::array<std::size_t, buckets>> counts(passes);
  for (auto& pass : counts) pass.fill(0);
  for (const double value : values)
    for (int pass = 0; pass < passes; ++pass) ++counts[static_cast<std::size_t>(pass)][digit(value, pass)];

  Array<double> other(values.size());
  for (int pass = 0; pass < passes; ++pass) {
    stop_flag().check();
    auto& next = counts[static_cast<std::size_t>(pass)];
    if (next[digit(values.front(), pass)] == values.size()) continue;
    std::size_t start = 0;
    for (std::size_t& bucket : next) {
      const std::size_t count = bucket;
      bucket = start;
      start += count;
    }
    for (const double value : values) other[next[digit(value, pass)]++] = value;
    values.swap(other);
  }
}

namespace {
constexpr std::size_t block = 256;

// Σ f(k) for k in [begin, end), in eight fixed lanes.
template <class Term>
double lane_sum(std::size_t begin, std::size_t end, Term term) {
  double lanes[8] = {};
  std::size_t k = begin;
  for (; k + 8 <= end; k += 8)
    for (std::size_t lane = 0; lane < 8; ++lane) lanes[lane] += term(k + lane);
  for (std::size_t lane = 0; k < end; ++k, ++lane) lanes[lane] += term(k);
  return ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]));
}
}  // namespace

SortedDrops::SortedDrops(std::span<const double> heights) {
  peak_ = range(heights).max;
  drops_.resize(heights.size());
  std::transform(heights.begin(), heights.end(), drops_.begin(), [&](double h) { return peak_ - h; });
  sort_ascending(drops_);
  build_checkpoints();
  find_rms();
}

void SortedDrops::build_checkpoints() {
  const double* g = drops_.data();
  const std::size_t n = drops_.size();
  checkpoints_.resize((n + block - 1) / block);

  Accumulator shortening, squared;
  for (std::size_t b = 1; b < checkpoints_.size(); ++b) {
    const std::size_t s = (b - 1) * block, next = b * block;
    const auto before = static_cast<double>(s);
    const double step = g[next] - g[s];
    // Σ (step + x)² = Σ x² + 2 step Σ x + before·step², x: shortenings at the plane g_s.
    squared.add_product(2 * step, shortening.value());
    squared.add_product(before * step, step);
    squared.add(lane_sum(s, next, [&](std::size_t k) { return (g[next] - g[k]) * (g[next] - g[k]); }));
    shortening.add_product(before, step);
    shortening.add(lane_sum(s, next, [&](std::size_t k) { return g[next] - g[k]; }));
    checkpoints_[b].shortening = shortening.value();
    checkpoints_[b].squared_shortening = squared.value();
  }

  Accumulator gap;
  for (std::size_t b = checkpoints_.size(); b-- > 0;) {
    const std::size_t s = b * block, next = std::min(s + block, n);
    if (next < n) gap.add_product(static_cast<double>(n - next), g[next] - g[s]);
    gap.add(lane_sum(s, next, [&](std::size_t k) { return g[k] - g[s]; }));
    checkpoints_[b].remaining_gap = gap.value();
  }
}

void SortedDrops::find_rms() {
  const std::size_t n = drops_.size();
  const double mean_drop = checkpoints_.front().remaining_gap / static_cast<double>(n);
  // Against over- and underflow of squares.
  const double scale = peak_to_valley();
  if (scale == 0) return;
  Accumulator squares;
  for (std::size_t s = 0; s < n; s += block)
    squares.add(lane_sum(s, std::min(s + block, n), [&](std::size_t k) {
      const double x = (drops_[k] - mean_drop) / scale;
      return x * x;
    }));
  rms_ = scale * std::sqrt(squares.value() / static_cast<double>(n));
}

std::size_t SortedDrops::touched(double d) const {
  return static_cast<std::size_t>(std::lower_bound(drops_.begin(), drops_.end(), d) - drops_.begin());
}

double SortedDrops::shortening(double d) const {
  const std::size_t n = touched(d);
  if (n == 0) return 0;
  const std::size_t b = (n - 1) / block, s = b * block;
  Accumulator sum(checkpoints_[b].shortening);
  sum.add_product(static_cast<double>(s), d - drops_[s]);
  sum.add(lane_sum(s, n, [&](std::size_t k) { return d - drops_[k]; }));
  return sum.value();
}

double SortedDrops::squared_shortening(double d) const {
  const std::size_t n = touched(d);
  if (n == 0) return 0;
  const std::size_t b = (n - 1) / block, s = b * block;
  const double step = d - drops_[s];
  Accumulator sum(checkpoints_[b].squared_shortening);
  sum.add_product(2 * step, checkpoints_[b].shortening);
  sum.add_product(static_cast<double>(s) * step, step);
  sum.add(lane_sum(s, n, [&](std::size_t k) { return (d - drops_[k]) * (d - drops_[k]); }));
  return sum.value();
}

double SortedDrops::remaining_gap(double d) const {
  const std::size_t n = touched(d);
  const std::size_t b = (n + block - 1) / block;
  const std::size_t next = std::min(b * block, drops_.size());
  Accumulator sum;
  if (next < drops_.size()) {
    sum.add(checkpoints_[b].remaining_gap);
    sum.add_product(static_cast<double>(drops_.size() - next), drops_[next] - d);
  }
  sum.add(lane_sum(n, next, [&](std::size_t k) { return drops_[k] - d; }));
  return sum.value();
}

double SortedDrops::depth(double total) const {
  if (total <= 0) return 0;
  // The last block whose first drop precedes `total`, or block 0.
  const auto above = std::lower_bound(checkpoints_.begin() + 1, checkpoints_.end(), total,
                                      [](const Checkpoint& c, double w) { return c.shortening < w; });
  const auto b = static_cast<std::size_t>(above - checkpoints_.begin()) - 1;
  std::size_t m = b * block;
  const std::size_t end = std::min(m + block, drops_.size());
  Accumulator level(checkpoints_[b].shortening);
  while (m + 1 < end) {
    Accumulator next = level;
    next.add_product(static_cast<double>(m + 1), drops_[m + 1] - drops_[m]);
    if (!(next.value() < total)) break;
    level = next;
    ++m;
  }
  level.add(-total);
  return drops_[m] - level.value() / static_cast<double>(m + 1);
}

std::int64_t SortedDrops::bytes(std::size_t heights) {
  return static_cast<std::int64_t>(heights * sizeof(double) +
                                   (heights + block - 1) / block * sizeof(Checkpoint));
}

std::int64_t SortedDrops::bytes_while_sorting(std::size_t heights) {
  return static_cast<std::int64_t>(2 * heights * sizeof(double));
}

}  // namespace asperity

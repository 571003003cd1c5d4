// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/box/ascending_sort.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "engine/core/monitor.hpp"

namespace asperity {

void sort_ascending(Array<double>& values) {
  constexpr std::size_t small = 2048;  // below this the passes cost more than comparing
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
    if (next[digit(values.front(), pass)] == values.size()) continue;  // one digit for all
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

}  // namespace asperity

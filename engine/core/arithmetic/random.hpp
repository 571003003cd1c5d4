// SPDX-License-Identifier: GPL-3.0-or-later
// Counter-based random numbers: draw k is SplitMix64 of the stream's seed and k (Steele, Lea & Flood 2014,
// "Fast splittable pseudorandom number generators").
#pragma once

#include <cstdint>
#include <string_view>

namespace asperity {

// From k = 0.
constexpr std::uint64_t splitmix64(std::uint64_t seed, std::uint64_t k) {
  std::uint64_t s = seed + (k + 1) * 0x9E3779B97F4A7C15ULL;
  s = (s ^ (s >> 30)) * 0xBF58476D1CE4E5B9ULL;
  s = (s ^ (s >> 27)) * 0x94D049BB133111EBULL;
  return s ^ (s >> 31);
}

// In [0, 1), 53 bits.
constexpr double unit_interval(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

// Streams of different names are independent.
class Stream {
 public:
  Stream(std::uint64_t seed, std::string_view name);
  std::uint64_t bits(std::uint64_t k) const { return splitmix64(key_, k); }
  // In [0, 1).
  double uniform(std::uint64_t k) const { return unit_interval(bits(k)); }
  double uniform(std::uint64_t k, double low, double high) const { return low + (high - low) * uniform(k); }
  // In [0, n); n > 0.
  std::uint64_t below(std::uint64_t k, std::uint64_t n) const;
  // Mean 0, variance 1 (Box–Muller on draws 2k and 2k+1).
  double normal(std::uint64_t k) const;

 private:
  std::uint64_t key_;
};

}  // namespace asperity

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/arithmetic/random.hpp"

#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"

namespace asperity {

Stream::Stream(std::uint64_t seed, std::string_view name) : key_(splitmix64(seed, 0)) {
  // FNV-1a hash of the name, then one SplitMix64 step.
  std::uint64_t hash = 0xCBF29CE484222325ULL;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
  key_ = splitmix64(key_ ^ hash, 0);
}

std::uint64_t Stream::below(std::uint64_t k, std::uint64_t n) const {
  __extension__ using Wide = unsigned __int128;
  // High half of the 128-bit product; the bias is below n/2⁶⁴.
  return static_cast<std::uint64_t>((static_cast<Wide>(bits(k)) * n) >> 64);
}

double Stream::normal(std::uint64_t k) const {
  const double u = 1.0 - uniform(2 * k);  // in (0, 1]
  const double v = uniform(2 * k + 1);
  return std::sqrt(-2.0 * elementary::log(u)) * elementary::cos(2.0 * std::numbers::pi * v);
}

}  // namespace asperity

// SPDX-License-Identifier: GPL-3.0-or-later
// Complex in-place Fourier transforms, one signal per vector lane. The forward transform (decimation in
// frequency) leaves bins in the order of place(), which the inverse (decimation in time) expects, so filters
// never sort. Lengths without a prime factor above 31. Unnormalised.
//
// A lane's operations do not depend on the vector width: same bits on every processor, unlike FFTW, which
// transforms contacts spread over ranks.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/arithmetic/register_vectors.hpp"

namespace asperity {

// Private to this folder.
constexpr std::int64_t fourier_block_count(int items, int block) {
  return (static_cast<std::int64_t>(items) + block - 1) / block;
}

// For fewer nodes, waking a helper does not pay.
inline constexpr std::int64_t nodes_worth_sharing = 64 * 64;

// One value of `count` signals; plain numbers for one lane.
template <class Real, int lanes = register_vectors::register_lanes<Real>>
struct Lanes {
  static constexpr int count = lanes;
  using Vector = typename register_vectors::Of<Real, lanes>::Vector;
  struct Complex {
    Vector re, im;
  };
};
template <class Real>
struct Lanes<Real, 1> {
  static constexpr int count = 1;
  using Vector = Real;
  struct Complex {
    Vector re, im;
  };
};

// Smallest length >= `least` with prime factors 2, 3, 5 and 7, the cheapest.
int smooth_length(int least);

// Cosine and sine of 2π k/n, 0 <= k < n, from the first octant: equal angles have equal bits.
struct UnitTurn {
  double cosine, sine;
};
UnitTurn unit_turn(std::int64_t k, std::int64_t n);

template <class Real, int lanes = Lanes<Real>::count>
class LaneFourier {
 public:
  using Complex = typename Lanes<Real, lanes>::Complex;

  // Throws Error{internal} unless possible(n): n >= 1 without a prime factor above 31.
  explicit LaneFourier(int n);
  static bool possible(int n);

  int length() const { return n_; }
  // Position of bin k between forward() and inverse().
  int place(int k) const { return places_[static_cast<std::size_t>(k)]; }

  // Thread-safe.
  void forward(Complex* values) const;
  void inverse(Complex* values) const;

 private:
  struct Stage {
    int radix, part;     // a block of radix·part values becomes `radix` blocks of `part`
    std::size_t factor;  // first of (radix − 1)·part complex factors
  };
  template <bool forwards>
  void run(std::size_t stage, Complex* values) const;
  template <bool forwards, int radix>
  void butterflies(const Stage& stage, Complex* values) const;

  int n_;
  std::vector<Stage> stages_;
  // Not counted: as large as a row.
  std::vector<Real> factors_;  // by stage: e^{−2πi kq/(radix·part)} as pairs, q = 1 … radix − 1 per k
  std::vector<int> places_;
};

extern template class LaneFourier<float>;
extern template class LaneFourier<double>;
extern template class LaneFourier<double, 1>;

}  // namespace asperity

// SPDX-License-Identifier: GPL-3.0-or-later
// Complex Fourier transforms of several signals side by side, one in each lane of a vector, in place:
// decimation in frequency leaves the bins in an order of its own, place(), and decimation in time takes them
// back from it, so that a filter never sorts. Lengths whose prime factors are 2, 3, 5 and 7. A lane
// meets the same operations whatever the width of the machine's vectors: the same bits. Unnormalised.
// It stands beside FFTW, which does every other transform, for the filters of the half-space alone: FFTW
// sorts each spectrum that a filter only multiplies, and chooses its operations, and so the last bits, by the
// machine.
#pragma once

#include <vector>

#include "engine/core/memory.hpp"

namespace asperity {

// `count` numbers that are worked on together: two cache lines are the real and imaginary parts of as many
// complex ones.
template <class Real>
struct Lanes {
  static constexpr int bytes = 64;
  static constexpr int count = bytes / static_cast<int>(sizeof(Real));
  typedef Real Vector __attribute__((vector_size(bytes), may_alias));
  struct Complex {
    Vector re, im;
  };
};

template <class Real>
class LaneFourier {
 public:
  using Complex = typename Lanes<Real>::Complex;

  // n >= 1 with no prime factor but 2, 3, 5 and 7.
  explicit LaneFourier(int n);
  static bool possible(int n);

  int length() const { return n_; }
  // Where forward() leaves bin k and inverse() takes it from.
  int place(int k) const { return places_[static_cast<std::size_t>(k)]; }

  // n values, in natural order outside and in that of place() between the two. Thread-safe.
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
  Array<Real> factors_;  // e^{−2πi kq/n} as pairs, q = 1 … radix − 1 for each k
  Array<int> places_;
};

extern template class LaneFourier<float>;
extern template class LaneFourier<double>;

}  // namespace asperity

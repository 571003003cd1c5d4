// SPDX-License-Identifier: GPL-3.0-or-later
// Complex Fourier transforms of several signals side by side, one in each lane of a vector, in place:
// decimation in frequency leaves the bins in an order of its own, place(), and decimation in time takes them
// back from it, so that a filter never sorts. Lengths whose prime factors are 2, 3, 5 and 7. A lane
// meets the same operations whatever the width of the machine's vectors: the same bits. Unnormalised.
// All transforms of one process are built of it (fourier_batch.hpp). FFTW, which does those of one contact
// over the ranks of mpirun, chooses its operations by the processor, and takes its factors from the C
// library, which does so too: the last bits differ.
#pragma once

#include <cstdint>
#include <vector>

namespace asperity {

// Of a register of the processor that is compiled for: a wider vector is kept in memory.
#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

// `count` numbers that are worked on together, in a register. One number is worked on by itself.
template <class Real, int lanes = register_bytes / static_cast<int>(sizeof(Real))>
struct Lanes {
  static constexpr int count = lanes;
  static constexpr int bytes = count * static_cast<int>(sizeof(Real));
  typedef Real Vector __attribute__((vector_size(bytes), may_alias));
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

// cos and sin of 2π k/n, 0 <= k < n, from the first octant, so that equal angles have equal bits.
struct UnitTurn {
  double cosine, sine;
};
UnitTurn unit_turn(std::int64_t k, std::int64_t n);

template <class Real, int lanes = Lanes<Real>::count>
class LaneFourier {
 public:
  using Complex = typename Lanes<Real, lanes>::Complex;

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
  // Of the size of a row: not counted.
  std::vector<Real> factors_;  // e^{−2πi kq/n} as pairs, q = 1 … radix − 1 for each k
  std::vector<int> places_;
};

extern template class LaneFourier<float>;
extern template class LaneFourier<double>;
extern template class LaneFourier<double, 1>;

}  // namespace asperity

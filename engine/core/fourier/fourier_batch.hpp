// SPDX-License-Identifier: GPL-3.0-or-later
// Fourier transforms of any length, of a batch of signals at once in lanes (fourier_lanes.hpp): the same bits
// on every processor. A length with a prime factor above 31 is computed as a convolution with a chirp
// (Bluestein 1970) at about twice the length, at about six times the cost. Two real signals are transformed
// as one complex signal. Unnormalised.
#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "engine/core/fourier/fourier_lanes.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

// Transforms of n values in each of `lanes` lanes, in place.
template <int lanes>
class AnyLengthFourier {
 public:
  using Complex = typename Lanes<double, lanes>::Complex;

  explicit AnyLengthFourier(int n);  // n >= 1

  int length() const { return n_; }
  // Where forward() leaves bin k and inverse() takes it from.
  int place(int k) const { return smooth_.length() == n_ ? smooth_.place(k) : k; }
  // Values that `work` takes beyond the n of the signal.
  std::size_t work_length() const {
    return smooth_.length() == n_ ? 0 : static_cast<std::size_t>(smooth_.length());
  }

  // Thread-safe, with a `work` for each thread.
  void forward(Complex* values, Complex* work) const;
  void inverse(Complex* values, Complex* work) const;

 private:
  template <bool forwards>
  void by_convolution(Complex* values, Complex* work) const;

  int n_;
  LaneFourier<double, lanes> smooth_;
  std::vector<double> chirp_;     // e^{−πi k²/n} as pairs
  std::vector<double> response_;  // transform of the chirp's conjugate, by places, divided by the length
};

extern template class AnyLengthFourier<1>;
extern template class AnyLengthFourier<Lanes<double>::count>;

// The batch of one length.
class BatchFourier {
 public:
  // Complex signals of a batch. Real signals r and r + columns are transformed as one, so that the number is
  // part of the bits; vectors take them in parts, as many as they hold.
  static constexpr int columns = 8;
  static constexpr int lanes = Lanes<double>::count, parts = columns / lanes;
  static constexpr int rows = 2 * columns;  // real signals of a batch
  using Lane = Lanes<double>::Complex;

  // Buffers of one thread.
  struct Work {
    UnsetArray<Lane> values, more;  // part after part, and of one part
    explicit Work(const BatchFourier& batch);
    Work(const Work&) = default;
  };

  explicit BatchFourier(int n) : fourier_(n) {}
  // Made once for each length and kept while the process lives. Thread-safe.
  static const BatchFourier& of_length(int n);

  // What a Work holds for a length, in lanes.
  static std::size_t work_values(int n);

  int length() const { return fourier_.length(); }
  int bins() const { return length() / 2 + 1; }
  int place(int k) const { return fourier_.place(k); }

  // Signals r < count: `given` values at in[r], zeros after them; n/2 + 1 bins to out[r]. in[r] and out[r]
  // may overlap if those of different r do not.
  void real_forward(Work& work, const double* const* in, int given, int count,
                    std::complex<double>* const* out) const;
  // The first `wanted` values, times `scale`, to out[r]. Imaginary parts of bins that must be real are
  // ignored.
  void real_inverse(Work& work, const std::complex<double>* const* in, int count, int wanted, double scale,
                    double* const* out) const;

  // The same in steps: signals to lanes, and from there after transforms.
  void load_reals(Work& work, const double* const* in, int given, int count) const;
  void store_reals(const Work& work, int count, int wanted, double scale, double* const* out) const;
  // Bins ±b of every signal times factors[b], b = 0 … n/2: real signals stay real.
  void multiply_even(Work& work, const double* factors) const;

  // Columns c < count of a spectrum, `stride` values from row to row: `given` rows, zeros after them.
  void load(Work& work, const std::complex<double>* from, std::ptrdiff_t stride, int given, int count) const;
  // Into bins in their natural order (forwards), or from them.
  void load_bins(Work& work, const std::complex<double>* from, std::ptrdiff_t stride, int count) const;
  void store(const Work& work, std::complex<double>* to, std::ptrdiff_t stride, int wanted, int count) const;
  void store_bins(const Work& work, std::complex<double>* to, std::ptrdiff_t stride, int count) const;
  void forward(Work& work) const {
    for (int p = 0; p < parts; ++p) fourier_.forward(part(work, p), work.more.data());
  }
  void inverse(Work& work) const {
    for (int p = 0; p < parts; ++p) fourier_.inverse(part(work, p), work.more.data());
  }
  // The values of columns p·lanes … (p + 1)·lanes − 1.
  Lane* part(Work& work, int p) const {
    return work.values.data() + static_cast<std::ptrdiff_t>(length()) * p;
  }
  const Lane* part(const Work& work, int p) const {
    return work.values.data() + static_cast<std::ptrdiff_t>(length()) * p;
  }

 private:
  template <class Place>
  void load_to(Work& work, const std::complex<double>* from, std::ptrdiff_t stride, int given, int count,
               Place place) const;
  template <class Place>
  void store_from(const Work& work, std::complex<double>* to, std::ptrdiff_t stride, int wanted, int count,
                  Place place) const;

  AnyLengthFourier<lanes> fourier_;
};

}  // namespace asperity

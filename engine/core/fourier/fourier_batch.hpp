// SPDX-License-Identifier: GPL-3.0-or-later
// Fourier transforms of any length for a batch of signals in lanes (fourier_lanes.hpp). Lengths with a prime
// factor above 31 use a chirp convolution (Bluestein 1970) of about twice the length. Unnormalised.
#pragma once

#include <array>
#include <complex>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/core/fourier/fourier_lanes.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

template <int lanes>
class AnyLengthFourier {
 public:
  using Complex = typename Lanes<double, lanes>::Complex;

  explicit AnyLengthFourier(int n);  // n >= 1

  int length() const { return n_; }
  int place(int k) const { return smooth_.length() == n_ ? smooth_.place(k) : k; }
  std::size_t work_length() const {
    return smooth_.length() == n_ ? 0 : static_cast<std::size_t>(smooth_.length());
  }

  // Thread-safe with one `work` per thread.
  void forward(Complex* values, Complex* work) const;
  void inverse(Complex* values, Complex* work) const;

 private:
  template <bool forwards>
  void by_convolution(Complex* values, Complex* work) const;

  int n_;
  LaneFourier<double, lanes> smooth_;
  std::vector<double> chirp_;     // e^{−πi k²/n} as pairs
  std::vector<double> response_;  // transform of the conjugate chirp by places, divided by the length
};

extern template class AnyLengthFourier<1>;
extern template class AnyLengthFourier<Lanes<double>::count>;

// Plans by length, cached for the process. Thread-safe.
template <class Plan>
const Plan& cached_fourier(int n) {
  static std::mutex mutex;
  static std::map<int, std::unique_ptr<const Plan>> plans;
  const std::lock_guard lock(mutex);
  std::unique_ptr<const Plan>& plan = plans[n];
  if (!plan) plan = std::make_unique<const Plan>(n);
  return *plan;
}

class BatchFourier {
 public:
  // Complex signals. Real signals r and r + columns share a transform, so the number affects the bits.
  static constexpr int columns = 8;
  static constexpr int lanes = Lanes<double>::count, parts = columns / lanes;
  static constexpr int rows = 2 * columns;  // real signals
  using Lane = Lanes<double>::Complex;

  struct Work {
    UnsetArray<Lane> values, more;  // all parts; work for one part
    explicit Work(const BatchFourier& batch);
    Work(const Work&) = default;
  };

  explicit BatchFourier(int n) : fourier_(n) {}
  // Signals r < count, `stride` apart.
  template <class Value>
  static std::array<Value*, rows> spaced(Value* first, std::ptrdiff_t stride, int count) {
    std::array<Value*, rows> signals{};
    for (int r = 0; r < count; ++r) signals[r] = first + r * stride;
    return signals;
  }
  static const BatchFourier& of_length(int n) { return cached_fourier<BatchFourier>(n); }

  // For one length, in lanes.
  static std::size_t work_values(int n);

  int length() const { return fourier_.length(); }
  int bins() const { return length() / 2 + 1; }
  int place(int k) const { return fourier_.place(k); }

  // Transforms signals r < count: `given` values at in[r], then zeros, to n/2 + 1 bins at out[r]. in[r] may
  // overlap out[r] of the same r only.
  void real_forward(Work& work, const double* const* in, int given, int count,
                    std::complex<double>* const* out) const;
  // `wanted` values times `scale` to out[r]. Ignores imaginary parts of real bins.
  void real_inverse(Work& work, const std::complex<double>* const* in, int count, int wanted, double scale,
                    double* const* out) const;

  void load_reals(Work& work, const double* const* in, int given, int count) const;
  void store_reals(const Work& work, int count, int wanted, double scale, double* const* out) const;
  // Bins ±b times factors[b], b = 0 … n/2; real signals stay real.
  void multiply_even(Work& work, const double* factors) const;

  // Columns c < count with row distance `stride`: `given` rows, then zeros. `bins`: rows are bins in natural
  // order.
  void load(Work& work, const std::complex<double>* from, std::ptrdiff_t stride, int given, int count,
            bool bins = false) const;
  void store(const Work& work, std::complex<double>* to, std::ptrdiff_t stride, int wanted, int count,
             bool bins = false) const;
  // All rows of columns c < count, to bins or back.
  void transform(Work& work, std::complex<double>* at, std::ptrdiff_t stride, int count,
                 bool forwards) const {
    load(work, at, stride, length(), count, !forwards);
    forwards ? forward(work) : inverse(work);
    store(work, at, stride, length(), count, forwards);
  }
  void forward(Work& work) const {
    for (int p = 0; p < parts; ++p) fourier_.forward(part(work, p), work.more.data());
  }
  void inverse(Work& work) const {
    for (int p = 0; p < parts; ++p) fourier_.inverse(part(work, p), work.more.data());
  }
  // Columns p·lanes … (p + 1)·lanes − 1.
  Lane* part(Work& work, int p) const {
    return work.values.data() + static_cast<std::ptrdiff_t>(length()) * p;
  }
  const Lane* part(const Work& work, int p) const {
    return work.values.data() + static_cast<std::ptrdiff_t>(length()) * p;
  }

 private:
  AnyLengthFourier<lanes> fourier_;
};

}  // namespace asperity

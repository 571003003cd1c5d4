// SPDX-License-Identifier: GPL-3.0-or-later
// FourierFilter for an even period_x and periods without a prime factor above 31, several times as fast: each
// vector lane transforms one row, then one column. Rows come from a source and go to a sink, which saves
// passes over memory. Real is the precision of transforms and multiplier.
#pragma once

#include <functional>
#include <span>

#include "engine/core/fourier/fourier_lanes.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

template <class Real>
class FourierLaneFilter {
 public:
  // As FourierFilter::Multiplier.
  using Multiplier = std::function<void(int a, std::span<double> factors)>;
  // Returns row j, in `scratch` or elsewhere.
  using Source = std::function<const double*(int j, double* scratch)>;
  using Sink = std::function<void(int j, const double* row)>;

  static bool possible(int period_x, int period_y);

  // Requires possible(period_x, period_y), 1 <= nx <= period_x, 1 <= ny <= period_y.
  FourierLaneFilter(int nx, int ny, int period_x, int period_y, const Multiplier& multiplier);
  ~FourierLaneFilter();

  // Source and sink are called concurrently, once per row, in any order, all source calls first. `scale`, a
  // power of two, brings values near 1 for single precision. A non-empty `out` of nx·ny values receives the
  // rows before the sink, which may then be empty. Not thread-safe.
  void apply(const Source& source, const Sink& sink, std::span<double> out = {}, double scale = 1);

  void apply(std::span<const double> in, std::span<double> out, double scale = 1);

  // Frees the spectrum until the next apply().
  void rest() { spectrum_ = UnsetArray<Complex>(); }

  // As stored; 0 <= a <= period_x/2, 0 <= b <= period_y/2.
  double factor(int a, int b) const;

 private:
  static constexpr int lanes = Lanes<Real>::count;
  using Complex = typename Lanes<Real>::Complex;
  using Vector = typename Lanes<Real>::Vector;
  struct Factors {
    Vector of;
  };
  struct Scratch;
  typename ScratchPool<Scratch>::Loan borrow();
  void set_multiplier(const Multiplier& multiplier);
  void load_rows(Scratch& scratch, const Source& source, int first, double scale) const;
  void unmix(Complex* values) const;
  void remix(Complex* values) const;
  void rows_forward(const Source& source, double scale);
  void columns();
  void multiply_packed(Complex* column) const;
  void rows_inverse(const Sink& sink, std::span<double> out, double scale);
  Complex* row(int j) { return spectrum_.data() + static_cast<std::ptrdiff_t>(j) * stride_; }

  int nx_, ny_, period_x_, period_y_;
  int half_;    // bins of a row; the real first and last bins share a place
  int blocks_;  // number of blocks of `lanes` bins
  int stride_;
  LaneFourier<Real> along_, across_;
  Array<Real> turns_;           // e^{−2πi k/period_x}, k = 0 … half/2
  Array<Factors> factors_;      // of a block of bins, b = 0 … period_y/2, with the normalisation
  Array<double> last_factors_;  // for a = period_x/2
  UnsetArray<Complex> spectrum_;
  ScratchPool<Scratch> scratch_;
};

extern template class FourierLaneFilter<float>;
extern template class FourierLaneFilter<double>;

}  // namespace asperity

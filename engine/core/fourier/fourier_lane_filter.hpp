// SPDX-License-Identifier: GPL-3.0-or-later
// A real field through a real, even Fourier multiplier, as FourierFilter, for an even period_x and periods
// without a prime factor above 31. Each lane of a vector transforms one row, then one column: several times
// as fast. The field comes in row by row from a source and leaves row by row into a sink, so that what is
// done to it before and after costs no pass over memory. Real is the precision of transforms and multiplier;
// fields are double. The same bits for any number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "engine/core/fourier/fourier_lanes.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/scratch_pool.hpp"

namespace asperity {

template <class Real>
class FourierLaneFilter {
 public:
  // Puts the factors of the waves (a, b), b = 0 … period_y/2, into the span, for one a of
  // 0 … period_x/2. Called from several threads at once.
  using Multiplier = std::function<void(int a, std::span<double> factors)>;
  // Row j of the field: its nx values, either put into `scratch`, or where the pointer returned says.
  using Source = std::function<const double*(int j, double* scratch)>;
  // Takes row j of the result.
  using Sink = std::function<void(int j, const double* row)>;

  static bool possible(int period_x, int period_y);

  // possible(period_x, period_y), 1 <= nx <= period_x, 1 <= ny <= period_y.
  FourierLaneFilter(int nx, int ny, int period_x, int period_y, const Multiplier& multiplier);
  ~FourierLaneFilter();

  // Rows are asked for, and handed out, from several threads at once, each once, in no order; none is
  // handed out before all have been asked for. `scale`, a power of two, brings values near to 1 where
  // single precision has its range. With `out`, of nx·ny values, rows are put there before the sink,
  // which may be empty then, is called. Not thread-safe; uses threads.
  void apply(const Source& source, const Sink& sink, std::span<double> out = {}, double scale = 1);

  // `in` and `out` may be the same.
  void apply(std::span<const double> in, std::span<double> out, double scale = 1);

  // Gives its spectrum back until it is applied again; the multiplier is kept.
  void rest() { spectrum_ = UnsetArray<Complex>(); }

  // The multiplier of wave (a, b), 0 <= a <= period_x/2, 0 <= b <= period_y/2, as it is held.
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
  int half_;    // period_x/2 bins of a row; the first and the last, which are real, share a place
  int blocks_;  // of `lanes` bins
  int stride_;
  LaneFourier<Real> along_, across_;
  Array<Real> turns_;       // e^{−2πi k/period_x}, k = 0 … half/2
  Array<Factors> factors_;  // of a block of bins, for b = 0 … period_y/2, divided by all that comes with it
  Array<double> last_factors_;  // of a = period_x/2
  UnsetArray<Complex> spectrum_;
  ScratchPool<Scratch> scratch_;
};

extern template class FourierLaneFilter<float>;
extern template class FourierLaneFilter<double>;

}  // namespace asperity

// SPDX-License-Identifier: GPL-3.0-or-later
// A row of n real values is transformed as n/2 complex values (even and odd places), then separated: X(k) = E
// + W^k O, with the factor 1/2 in the multiplier.
#include "engine/core/fourier/fourier_lane_filter.hpp"

#include <algorithm>
#include <numbers>
#include <optional>
#include <type_traits>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

namespace {

// Prefetch distance in rows; addresses are too far apart for the hardware.
constexpr int lane_rows_ahead = 16;

using Singles = Lanes<float>::Vector;
using Doubles = Lanes<double>::Vector;
using register_vectors::transpose;

inline void read(const double* from, double /*scale*/, Doubles& to) { register_vectors::read(from, to); }
inline void read(const double* from, double scale, Singles& to) {
  Doubles low, high;
  register_vectors::read(from, low);
  register_vectors::read(from + Lanes<double>::count, high);
  low *= scale;
  high *= scale;
  register_vectors::narrow(low, high, to);
}
inline void write(const Doubles& from, double /*scale*/, double* to) { register_vectors::write(from, to); }
inline void write(const Singles& from, double scale, double* to) {
  Doubles low, high;
  register_vectors::widen(from, low, high);
  low *= scale;
  high *= scale;
  register_vectors::write(low, to);
  register_vectors::write(high, to + Lanes<double>::count);
}

// As own_stride in fourier_filter.cpp.
int odd(int blocks) { return blocks % 2 == 0 ? blocks + 1 : blocks; }

}  // namespace

template <class Real>
struct FourierLaneFilter<Real>::Scratch {
  Array<Complex> values;  // rows or columns in lanes
  Array<double> rows;     // buffers for source and sink
  Array<double> factors;
  Scratch(int nx, int half, int period_y)
      : values(static_cast<std::size_t>(std::max(odd(half), period_y) + lanes)),
        rows(static_cast<std::size_t>((nx + lanes - 1) / lanes * lanes) * lanes) {}
  double* row(int nx, int r) {
    return rows.data() + static_cast<std::ptrdiff_t>((nx + lanes - 1) / lanes * lanes) * r;
  }
};

template <class Real>
typename ScratchPool<typename FourierLaneFilter<Real>::Scratch>::Loan FourierLaneFilter<Real>::borrow() {
  return scratch_.borrow([this] { return std::make_unique<Scratch>(nx_, half_, period_y_); });
}

template <class Real>
bool FourierLaneFilter<Real>::possible(int period_x, int period_y) {
  return period_x >= 2 && period_x % 2 == 0 && period_y >= 1 && LaneFourier<Real>::possible(period_x) &&
         LaneFourier<Real>::possible(period_y);
}

template <class Real>
FourierLaneFilter<Real>::FourierLaneFilter(int nx, int ny, int period_x, int period_y,
                                           const Multiplier& multiplier)
    : nx_(nx),
      ny_(ny),
      period_x_(period_x),
      period_y_(period_y),
      half_(period_x / 2),
      blocks_((half_ + lanes - 1) / lanes),
      stride_(odd(blocks_)),
      along_(half_),
      across_(period_y),
      turns_(static_cast<std::size_t>(half_ / 2 + 1) * 2),
      factors_(static_cast<std::size_t>(blocks_) * static_cast<std::size_t>(period_y / 2 + 1)),
      last_factors_(static_cast<std::size_t>(period_y / 2 + 1)) {
  for (int k = 0; k <= half_ / 2; ++k) {
    const elementary::SineCosine at = elementary::sincos(2 * std::numbers::pi * k / period_x);
    turns_[2 * static_cast<std::size_t>(k)] = static_cast<Real>(at.cosine);
    turns_[2 * static_cast<std::size_t>(k) + 1] = static_cast<Real>(-at.sine);
  }
  set_multiplier(multiplier);
}

template <class Real>
FourierLaneFilter<Real>::~FourierLaneFilter() = default;

template <class Real>
void FourierLaneFilter<Real>::set_multiplier(const Multiplier& multiplier) {
  const auto waves = static_cast<std::size_t>(period_y_ / 2 + 1);
  const double scale = 0.5 / (static_cast<double>(period_x_) * static_cast<double>(period_y_));
  parallel_for(blocks_, [&](std::int64_t block) {
    Array<double> column(waves);
    Factors* const to = factors_.data() + static_cast<std::size_t>(block) * waves;
    for (int l = 0; l < lanes; ++l) {
      const int a = static_cast<int>(block) * lanes + l;
      if (a >= half_) break;
      multiplier(a, column);
      for (std::size_t b = 0; b < waves; ++b) to[b].of[l] = static_cast<Real>(column[b] * scale);
    }
  });
  multiplier(half_, last_factors_);
  for (double& value : last_factors_) value *= scale;
}

template <class Real>
double FourierLaneFilter<Real>::factor(int a, int b) const {
  const auto waves = static_cast<std::size_t>(period_y_ / 2 + 1), wave = static_cast<std::size_t>(b);
  const double scale = 2 * (static_cast<double>(period_x_) * static_cast<double>(period_y_));
  if (a == half_) return last_factors_[wave] * scale;
  return static_cast<double>(factors_[static_cast<std::size_t>(a / lanes) * waves + wave].of[a % lanes]) *
         scale;
}

template <class Real>
void FourierLaneFilter<Real>::apply(const Source& source, const Sink& sink, std::span<double> out,
                                    double scale) {
  if (!out.empty() && out.size() != static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_))
    throw Error(ErrorCode::internal, "a filter of another grid's values");
  std::optional<SingleThreaded> alone;
  if (static_cast<std::int64_t>(period_x_) * period_y_ <= nodes_worth_sharing) alone.emplace();
  if constexpr (std::is_same_v<Real, double>) scale = 1;  // enough range
  spectrum_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(ny_));
  rows_forward(source, scale);
  columns();
  rows_inverse(sink, out, 1 / scale);
}

template <class Real>
void FourierLaneFilter<Real>::apply(std::span<const double> in, std::span<double> out, double scale) {
  if (in.size() != out.size()) throw Error(ErrorCode::internal, "a filter of another grid's values");
  apply([&](int j, double*) { return in.data() + static_cast<std::ptrdiff_t>(j) * nx_; }, {}, out, scale);
}

// Two neighbours of a row as one complex value.
template <class Real>
void FourierLaneFilter<Real>::load_rows(Scratch& scratch, const Source& source, int first,
                                        double scale) const {
  const double* rows[lanes];
  for (int r = 0; r < lanes; ++r) {
    const int j = first + r;
    rows[r] = j < ny_ ? source(j, scratch.row(nx_, r)) : rows[r - 1];
  }
  Complex* const to = scratch.values.data();
  const int whole = nx_ / lanes * lanes;
  for (int i = 0; i < whole; i += lanes) {
    Vector x[lanes];
    for (int r = 0; r < lanes; ++r) read(rows[r] + i, scale, x[r]);
    transpose(x);
    for (int k = 0; k < lanes / 2; ++k) to[i / 2 + k] = {x[2 * k], x[2 * k + 1]};
  }
  for (int k = whole / 2; k < half_; ++k) to[k] = {Vector{}, Vector{}};
  for (int i = whole; i < nx_; ++i) {
    Vector& part = i % 2 == 0 ? to[i / 2].re : to[i / 2].im;
    for (int r = 0; r < lanes; ++r) part[r] = static_cast<Real>(rows[r][i] * scale);
  }
}

// Converts bins of pairs to twice the bins of the row.
template <class Real>
void FourierLaneFilter<Real>::unmix(Complex* values) const {
  Complex& mean = values[along_.place(0)];
  mean = {(mean.re + mean.im) * Real{2}, (mean.re - mean.im) * Real{2}};
  for (int k = 1; 2 * k <= half_; ++k) {
    const Real c = turns_[2 * static_cast<std::size_t>(k)], s = turns_[2 * static_cast<std::size_t>(k) + 1];
    Complex &low = values[along_.place(k)], &high = values[along_.place(half_ - k)];
    const Complex even = {low.re + high.re, low.im - high.im};
    const Complex odd_part = {low.im + high.im, high.re - low.re};
    const Complex turned = {odd_part.re * c - odd_part.im * s, odd_part.re * s + odd_part.im * c};
    const Complex difference = {even.re - turned.re, turned.im - even.im};
    low = {even.re + turned.re, even.im + turned.im};
    if (2 * k != half_) high = difference;
  }
}

template <class Real>
void FourierLaneFilter<Real>::remix(Complex* values) const {
  Complex& mean = values[along_.place(0)];
  mean = {mean.re + mean.im, mean.re - mean.im};
  for (int k = 1; 2 * k <= half_; ++k) {
    const Real c = turns_[2 * static_cast<std::size_t>(k)], s = turns_[2 * static_cast<std::size_t>(k) + 1];
    Complex &low = values[along_.place(k)], &high = values[along_.place(half_ - k)];
    const Complex even = {low.re + high.re, low.im - high.im};
    const Complex turned = {low.re - high.re, low.im + high.im};
    const Complex odd_part = {turned.re * c + turned.im * s, turned.im * c - turned.re * s};
    const Complex difference = {even.re + odd_part.im, odd_part.re - even.im};
    low = {even.re - odd_part.im, even.im + odd_part.re};
    if (2 * k != half_) high = difference;
  }
}

template <class Real>
void FourierLaneFilter<Real>::rows_forward(const Source& source, double scale) {
  parallel_for(fourier_block_count(ny_, lanes), [&](std::int64_t batch) {
    const auto scratch = borrow();
    const int first = static_cast<int>(batch) * lanes;
    load_rows(*scratch, source, first, scale);
    Complex* const values = scratch->values.data();
    along_.forward(values);
    unmix(values);
    const int rows = std::min(lanes, ny_ - first);
    for (int block = 0; block < blocks_; ++block) {
      Vector re[lanes], im[lanes];
      for (int l = 0; l < lanes; ++l) {
        const int a = block * lanes + l;
        if (a < half_) {
          const Complex& value = values[along_.place(a)];
          re[l] = value.re;
          im[l] = value.im;
        } else {
          re[l] = im[l] = Vector{};
        }
      }
      transpose(re);
      transpose(im);
      Complex* const to = row(first) + block;
      for (int r = 0; r < rows; ++r) to[static_cast<std::ptrdiff_t>(r) * stride_] = {re[r], im[r]};
    }
  });
}

template <class Real>
void FourierLaneFilter<Real>::rows_inverse(const Sink& sink, std::span<double> out, double scale) {
  const auto nx = static_cast<std::size_t>(nx_);
  parallel_for(fourier_block_count(ny_, lanes), [&](std::int64_t batch) {
    const auto scratch = borrow();
    const int first = static_cast<int>(batch) * lanes;
    const int rows = std::min(lanes, ny_ - first);
    Complex* const values = scratch->values.data();
    for (int block = 0; block < blocks_; ++block) {
      Vector re[lanes], im[lanes];
      const Complex* const from = row(first) + block;
      for (int r = 0; r < lanes; ++r) {
        const Complex& value = from[static_cast<std::ptrdiff_t>(std::min(r, rows - 1)) * stride_];
        re[r] = value.re;
        im[r] = value.im;
      }
      transpose(re);
      transpose(im);
      for (int l = 0; l < lanes && block * lanes + l < half_; ++l)
        values[along_.place(block * lanes + l)] = {re[l], im[l]};
    }
    remix(values);
    along_.inverse(values);
    double* to[lanes];
    for (int r = 0; r < rows; ++r)
      to[r] = out.empty() ? scratch->row(nx_, r) : out.data() + static_cast<std::size_t>(first + r) * nx;
    const int whole = nx_ / lanes * lanes;
    for (int i = 0; i < whole; i += lanes) {
      Vector x[lanes];
      for (int k = 0; k < lanes / 2; ++k) {
        x[2 * k] = values[i / 2 + k].re;
        x[2 * k + 1] = values[i / 2 + k].im;
      }
      transpose(x);
      for (int r = 0; r < rows; ++r) write(x[r], scale, to[r] + i);
    }
    for (int i = whole; i < nx_; ++i) {
      const Vector& part = i % 2 == 0 ? values[i / 2].re : values[i / 2].im;
      for (int r = 0; r < rows; ++r) to[r][i] = static_cast<double>(part[r]) * scale;
    }
    if (sink)
      for (int r = 0; r < rows; ++r) sink(first + r, to[r]);
  });
}

// As FourierFilter::multiply_packed.
template <class Real>
void FourierLaneFilter<Real>::multiply_packed(Complex* column) const {
  for (int b = 0; 2 * b <= period_y_; ++b) {
    const double first = static_cast<double>(factors_[static_cast<std::size_t>(b)].of[0]);
    const double last = last_factors_[static_cast<std::size_t>(b)];
    const double same = 0.5 * (first + last), other = 0.5 * (first - last);
    Complex& low = column[across_.place(b)];
    Complex& high = column[across_.place(b == 0 ? 0 : period_y_ - b)];
    const double x = static_cast<double>(low.re[0]), y = static_cast<double>(low.im[0]);
    const double u = static_cast<double>(high.re[0]), v = static_cast<double>(high.im[0]);
    low.re[0] = static_cast<Real>(same * x + other * u);
    low.im[0] = static_cast<Real>(same * y - other * v);
    high.re[0] = static_cast<Real>(same * u + other * x);
    high.im[0] = static_cast<Real>(same * v - other * y);
  }
}

template <class Real>
void FourierLaneFilter<Real>::columns() {
  const auto waves = static_cast<std::size_t>(period_y_ / 2 + 1);
  parallel_for(blocks_, [&](std::int64_t block) {
    const auto scratch = borrow();
    Complex* const column = scratch->values.data();
    Complex* const spectrum = row(0) + block;
    const auto prefetch = [&](int j) {
      const Complex* const ahead = spectrum + static_cast<std::ptrdiff_t>(std::min(j, ny_ - 1)) * stride_;
      __builtin_prefetch(&ahead->re, 1);
      __builtin_prefetch(&ahead->im, 1);
    };
    for (int j = 0; j < ny_; ++j) {
      prefetch(j + lane_rows_ahead);
      column[j] = spectrum[static_cast<std::ptrdiff_t>(j) * stride_];
    }
    for (int j = ny_; j < period_y_; ++j) column[j] = {Vector{}, Vector{}};
    across_.forward(column);
    const Factors* const factors = factors_.data() + static_cast<std::size_t>(block) * waves;
    Array<Real> packed;  // the shared first lane
    const auto keep = [&](auto&& act) {
      for (int k = 0; k < period_y_; ++k) act(static_cast<std::size_t>(2 * k), column[k]);
    };
    if (block == 0) {
      packed.resize(2 * static_cast<std::size_t>(period_y_));
      keep([&](std::size_t at, const Complex& value) {
        packed[at] = value.re[0], packed[at + 1] = value.im[0];
      });
    }
    for (int b = 0; 2 * b <= period_y_; ++b) {
      const Vector& factor = factors[b].of;
      Complex& low = column[across_.place(b)];
      low.re *= factor;
      low.im *= factor;
      if (b == 0 || 2 * b == period_y_) continue;
      Complex& high = column[across_.place(period_y_ - b)];
      high.re *= factor;
      high.im *= factor;
    }
    if (block == 0) {
      keep([&](std::size_t at, Complex& value) { value.re[0] = packed[at], value.im[0] = packed[at + 1]; });
      multiply_packed(column);
    }
    across_.inverse(column);
    for (int j = 0; j < ny_; ++j) {
      prefetch(j + lane_rows_ahead);
      spectrum[static_cast<std::ptrdiff_t>(j) * stride_] = column[j];
    }
  });
}

template class FourierLaneFilter<float>;
template class FourierLaneFilter<double>;

}  // namespace asperity

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/fourier_filter.hpp"

#include <fftw3.h>

#include <algorithm>
#include <optional>

#include "engine/core/error.hpp"
#include "engine/core/fourier_blocks.hpp"
#include "engine/core/fourier_plan.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

namespace {

using Complex = std::complex<double>;

int filter_rows_per_block(int period) { return std::clamp(16384 / period, 1, 64); }

// Two cache lines, which the processor fetches as a pair, while a block fits the second cache.
int filter_columns_per_block(int period) { return period <= 4096 ? 8 : 4; }

bool aligned(const void* pointer) { return reinterpret_cast<std::uintptr_t>(pointer) % 64 == 0; }

int own_bins(int period) { return period % 2 == 0 ? period / 2 : period / 2 + 1; }

// Whole cache lines, and an odd number of pairs of them: rows a power of two apart would compete for
// the same few places of the cache when a column is gathered.
int own_stride(int period) {
  const int pairs = (own_bins(period) + 7) / 8;
  return 8 * (pairs % 2 == 0 ? pairs + 1 : pairs);
}

// A row of values is 64-byte aligned and holds its own transform.
bool in_place(int nx, int period_x) { return nx == period_x && nx % 8 == 0; }

// A column of odd length would leave the next one unaligned, and columns a power of two apart would
// compete for the same places of the cache.
std::size_t column_stride(int period) { return (static_cast<std::size_t>(period) + 3) / 4 * 4 + 4; }

// Rows ahead of the one being gathered that are asked for: their addresses are too far apart for the
// processor to foresee.
constexpr int rows_ahead = 12;

template <int columns>
void gather(const Complex* from, std::ptrdiff_t from_stride, int rows, Complex* to, std::size_t to_stride) {
  for (int b = 0; b < rows; ++b, from += from_stride, ++to) {
    const Complex* const ahead = from + (b + rows_ahead < rows ? rows_ahead * from_stride : 0);
    __builtin_prefetch(ahead, 1);
    if constexpr (columns > 4) __builtin_prefetch(ahead + 4, 1);
    for (std::size_t c = 0; c < columns; ++c) to[c * to_stride] = from[c];
  }
}

template <int columns>
void scatter(const Complex* from, std::size_t from_stride, int rows, Complex* to, std::ptrdiff_t to_stride) {
  for (int b = 0; b < rows; ++b, to += to_stride, ++from) {
    Complex* const ahead = to + (b + rows_ahead < rows ? rows_ahead * to_stride : 0);
    __builtin_prefetch(ahead, 1);
    if constexpr (columns > 4) __builtin_prefetch(ahead + 4, 1);
    for (std::size_t c = 0; c < columns; ++c) to[c] = from[c * from_stride];
  }
}

}  // namespace

struct FourierFilter::Scratch {
  Array<Complex> gathered, column, bins;
  Array<double> signal, factors, last_factors;
  Scratch(int period_x, int period_y)
      : gathered(column_stride(period_y) * static_cast<std::size_t>(filter_columns_per_block(period_y))),
        column(static_cast<std::size_t>(period_y)),
        bins(static_cast<std::size_t>(period_x / 2 + 1)),
        signal(static_cast<std::size_t>(period_x)),
        factors(static_cast<std::size_t>(period_y / 2 + 1)),
        last_factors(factors) {}
};

ScratchPool<FourierFilter::Scratch>::Loan FourierFilter::borrow() {
  return scratch_.borrow([this] { return std::make_unique<Scratch>(period_x_, period_y_); });
}

FourierFilter::FourierFilter(int nx, int ny, int period_x, int period_y)
    : nx_(nx), ny_(ny), period_x_(period_x), period_y_(period_y), bins_(own_bins(period_x)), stride_(0) {}

FourierFilter::~FourierFilter() = default;

std::int64_t FourierFilter::bytes(int nx, int ny, int period_x, int period_y) {
  const std::int64_t columns = static_cast<std::int64_t>(column_stride(period_y)) *
                               filter_columns_per_block(period_y) * thread_count();
  const std::int64_t spectrum =
      in_place(nx, period_x) ? 0 : static_cast<std::int64_t>(own_stride(period_x)) * ny;
  return static_cast<std::int64_t>(sizeof(Complex)) * (spectrum + columns);
}

void FourierFilter::apply(std::span<const double> in, std::span<double> out, const Multiplier& multiplier) {
  const auto nodes = static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_);
  if (in.size() != nodes || out.size() != nodes)
    throw Error(ErrorCode::internal, "a filter of another grid's values");
  if (in_place(nx_, period_x_) && aligned(out.data())) {
    spectrum_ = reinterpret_cast<Complex*>(out.data());
    stride_ = nx_ / 2;
  } else {
    stride_ = own_stride(period_x_);
    own_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(ny_));
    spectrum_ = own_.data();
  }
  std::optional<SingleThreaded> alone;
  if (static_cast<std::int64_t>(period_x_) * period_y_ <= nodes_worth_sharing) alone.emplace();
  rows_forward(in);
  columns(multiplier);
  rows_inverse(out);
}

void FourierFilter::rows_forward(std::span<const double> in) {
  const fftw_plan plan = fourier_plan(period_x_, FourierPlan::real_forward);
  const int rows = filter_rows_per_block(period_x_);
  const auto nx = static_cast<std::size_t>(nx_);
  parallel_for(block_count(ny_, rows), [&](std::int64_t block) {
    const auto scratch = borrow();
    std::fill(scratch->signal.begin() + nx_, scratch->signal.end(), 0.0);
    const int first = static_cast<int>(block) * rows;
    for (int j = first; j < std::min(first + rows, ny_); ++j) {
      const double* const values = in.data() + static_cast<std::size_t>(j) * nx;
      const bool direct = nx_ == period_x_ && aligned(values);
      if (!direct) std::copy_n(values, nx, scratch->signal.begin());
      // The plan keeps its input.
      double* const source = direct ? const_cast<double*>(values) : scratch->signal.data();
      fftw_execute_dft_r2c(plan, source, fftw(scratch->bins.data()));
      if (period_x_ % 2 == 0) scratch->bins.front().imag(scratch->bins.back().real());
      std::copy_n(scratch->bins.begin(), bins_, row(j));
    }
  });
}

void FourierFilter::rows_inverse(std::span<double> out) {
  const fftw_plan plan = fourier_plan(period_x_, FourierPlan::real_inverse);
  const int rows = filter_rows_per_block(period_x_);
  const auto nx = static_cast<std::size_t>(nx_);
  parallel_for(block_count(ny_, rows), [&](std::int64_t block) {
    const auto scratch = borrow();
    const int first = static_cast<int>(block) * rows;
    for (int j = first; j < std::min(first + rows, ny_); ++j) {
      double* const values = out.data() + static_cast<std::size_t>(j) * nx;
      std::copy_n(row(j), bins_, scratch->bins.begin());
      if (period_x_ % 2 == 0) scratch->bins.back() = scratch->bins.front().imag();
      scratch->bins.front().imag(0);
      const bool direct = nx_ == period_x_ && aligned(values);
      fftw_execute_dft_c2r(plan, fftw(scratch->bins.data()), direct ? values : scratch->signal.data());
      if (!direct) std::copy_n(scratch->signal.begin(), nx, values);
    }
  });
}

// Two real columns c and d were transformed as one, Z = C + iD. With even factors f and g,
// fC + igD = (f+g)/2 Z(b) + (f−g)/2 conj Z(−b).
void FourierFilter::multiply_packed(Scratch& scratch, const Multiplier& multiplier) const {
  multiplier(0, scratch.factors);
  multiplier(period_x_ / 2, scratch.last_factors);
  const double half = 0.5 / (static_cast<double>(period_x_) * static_cast<double>(period_y_));
  Complex* const wave = scratch.column.data();
  for (int b = 0; 2 * b <= period_y_; ++b) {
    const int mirror = b == 0 ? 0 : period_y_ - b;
    const double first = scratch.factors[static_cast<std::size_t>(b)];
    const double last = scratch.last_factors[static_cast<std::size_t>(b)];
    const double same = half * (first + last), other = half * (first - last);
    const Complex here = wave[b], there = wave[mirror];
    wave[b] = same * here + other * std::conj(there);
    wave[mirror] = same * there + other * std::conj(here);
  }
}

void FourierFilter::columns(const Multiplier& multiplier) {
  const fftw_plan forward = fourier_plan(period_y_, FourierPlan::complex_forward);
  const fftw_plan inverse = fourier_plan(period_y_, FourierPlan::complex_inverse);
  const std::size_t stride = column_stride(period_y_);
  const int width = filter_columns_per_block(period_y_);
  const double scale = 1 / (static_cast<double>(period_x_) * static_cast<double>(period_y_));
  const bool packed = period_x_ % 2 == 0;
  parallel_for(block_count(bins_, width), [&](std::int64_t block) {
    const auto scratch = borrow();
    const int first = static_cast<int>(block) * width;
    const int columns = std::min(width, bins_ - first);
    Complex* const gathered = scratch->gathered.data();
    for (int c = 0; c < columns; ++c)
      std::fill(gathered + static_cast<std::size_t>(c) * stride + ny_,
                gathered + static_cast<std::size_t>(c) * stride + period_y_, Complex(0));
    if (columns == 8) {
      gather<8>(row(0) + first, stride_, ny_, gathered, stride);
    } else if (columns == 4) {
      gather<4>(row(0) + first, stride_, ny_, gathered, stride);
    } else {
      for (int c = 0; c < columns; ++c)
        gather<1>(row(0) + first + c, stride_, ny_, gathered + static_cast<std::size_t>(c) * stride, stride);
    }
    for (int c = 0; c < columns; ++c) {
      Complex* const start = gathered + static_cast<std::size_t>(c) * stride;
      Complex* const wave = scratch->column.data();
      fftw_execute_dft(forward, fftw(start), fftw(wave));
      if (packed && first + c == 0) {
        multiply_packed(*scratch, multiplier);
      } else {
        multiplier(first + c, scratch->factors);
        double* const factors = scratch->factors.data();
        const int half = period_y_ / 2;
        for (int b = 0; b <= half; ++b) factors[b] *= scale;
        for (int b = 0; b <= half; ++b) wave[b] *= factors[b];
        for (int b = half + 1; b < period_y_; ++b) wave[b] *= factors[period_y_ - b];
      }
      fftw_execute_dft(inverse, fftw(wave), fftw(start));
    }
    if (columns == 8) {
      scatter<8>(gathered, stride, ny_, row(0) + first, stride_);
    } else if (columns == 4) {
      scatter<4>(gathered, stride, ny_, row(0) + first, stride_);
    } else {
      for (int c = 0; c < columns; ++c)
        scatter<1>(gathered + static_cast<std::size_t>(c) * stride, stride, ny_, row(0) + first + c, stride_);
    }
  });
}

int good_fourier_length(int least) {
  if (least <= 1) return 1;
  for (int n = least + least % 2;; n += 2) {
    int rest = n;
    for (const int factor : {2, 3, 5, 7})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return n;
  }
}

}  // namespace asperity

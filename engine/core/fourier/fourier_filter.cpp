// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/fourier/fourier_filter.hpp"

#include <algorithm>
#include <optional>

#include "engine/core/error.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

namespace {

using Complex = std::complex<double>;
constexpr int filter_rows = BatchFourier::rows, filter_columns = BatchFourier::columns;

bool aligned(const void* pointer) { return reinterpret_cast<std::uintptr_t>(pointer) % 64 == 0; }

int own_bins(int period) { return period % 2 == 0 ? period / 2 : period / 2 + 1; }

// An odd number of pairs of cache lines: rows a power of two apart would compete for few cache sets.
int own_stride(int period) {
  const int pairs = (own_bins(period) + 7) / 8;
  return 8 * (pairs % 2 == 0 ? pairs + 1 : pairs);
}

// A row of values is 64-byte aligned and has room for its transform.
bool in_place(int nx, int period_x) { return nx == period_x && nx % 8 == 0; }

}  // namespace

struct FourierFilter::Scratch {
  using Vector = BatchFourier::Lane;  // real part only
  BatchFourier::Work along, across;
  Array<Complex> bins, packed;
  Array<double> factors, last_factors;
  Array<Vector> lane_factors;
  Scratch(const BatchFourier& along_x, const BatchFourier& across_y)
      : along(along_x),
        across(across_y),
        bins(static_cast<std::size_t>(along_x.bins()) * filter_rows),
        packed(static_cast<std::size_t>(across_y.length())),
        factors(static_cast<std::size_t>(across_y.bins())),
        last_factors(factors),
        lane_factors(factors.size() * BatchFourier::parts) {}
};

ScratchPool<FourierFilter::Scratch>::Loan FourierFilter::borrow() {
  return scratch_.borrow([this] { return std::make_unique<Scratch>(along_, across_); });
}

FourierFilter::FourierFilter(int nx, int ny, int period_x, int period_y)
    : nx_(nx),
      ny_(ny),
      period_x_(period_x),
      period_y_(period_y),
      bins_(own_bins(period_x)),
      stride_(0),
      along_(BatchFourier::of_length(period_x)),
      across_(BatchFourier::of_length(period_y)) {}

FourierFilter::~FourierFilter() = default;

std::int64_t FourierFilter::bytes(int nx, int ny, int period_x, int period_y) {
  const auto lane = static_cast<std::int64_t>(sizeof(BatchFourier::Lane));
  const auto work = [](int period) {
    return lane * static_cast<std::int64_t>(BatchFourier::work_values(period));
  };
  const std::int64_t a_thread = work(period_x) + work(period_y) + lane * (period_y / 2 + 1) +
                                static_cast<std::int64_t>(sizeof(Complex)) *
                                    ((period_x / 2 + 1) * std::int64_t{filter_rows} + 2 * period_y);
  const std::int64_t spectrum =
      in_place(nx, period_x) ? 0 : static_cast<std::int64_t>(own_stride(period_x)) * ny;
  return static_cast<std::int64_t>(sizeof(Complex)) * spectrum + a_thread * thread_count();
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
  const std::ptrdiff_t nx = nx_;
  parallel_for(fourier_block_count(ny_, filter_rows), [&](std::int64_t block) {
    const auto scratch = borrow();
    const int first = static_cast<int>(block) * filter_rows, here = std::min(filter_rows, ny_ - first);
    const auto to = along_.spaced(scratch->bins.data(), along_.bins(), here);
    along_.real_forward(scratch->along, along_.spaced(in.data() + nx * first, nx, here).data(), nx_, here,
                        to.data());
    for (int r = 0; r < here; ++r) {
      Complex* const bins = to[r];
      if (period_x_ % 2 == 0) bins[0].imag(bins[bins_].real());
      std::copy_n(bins, bins_, row(first + r));
    }
  });
}

void FourierFilter::rows_inverse(std::span<double> out) {
  const std::ptrdiff_t nx = nx_;
  parallel_for(fourier_block_count(ny_, filter_rows), [&](std::int64_t block) {
    const auto scratch = borrow();
    const int first = static_cast<int>(block) * filter_rows, here = std::min(filter_rows, ny_ - first);
    const auto from = along_.spaced(scratch->bins.data(), along_.bins(), here);
    for (int r = 0; r < here; ++r) {
      std::copy_n(row(first + r), bins_, from[r]);
      if (period_x_ % 2 == 0) from[r][bins_] = from[r][0].imag();
    }
    along_.real_inverse(scratch->along, from.data(), here, nx_, 1,
                        along_.spaced(out.data() + nx * first, nx, here).data());
  });
}

// Columns c and d share a transform Z = C + iD in the first lane. For even factors f and g, fC + igD =
// (f+g)/2 Z(b) + (f−g)/2 conj Z(−b).
void FourierFilter::multiply_packed(Scratch& scratch, const Multiplier& multiplier) const {
  multiplier(0, scratch.factors);
  multiplier(period_x_ / 2, scratch.last_factors);
  const double half = 0.5 / (static_cast<double>(period_x_) * static_cast<double>(period_y_));
  const auto bin = [&](int b) {
    const BatchFourier::Lane& value = across_.part(scratch.across, 0)[across_.place(b)];
    return Complex(value.re[0], value.im[0]);
  };
  for (int b = 0; 2 * b <= period_y_; ++b) {
    const int mirror = b == 0 ? 0 : period_y_ - b;
    const double first = scratch.factors[static_cast<std::size_t>(b)];
    const double last = scratch.last_factors[static_cast<std::size_t>(b)];
    const double same = half * (first + last), other = half * (first - last);
    const Complex here = bin(b), there = bin(mirror);
    scratch.packed[static_cast<std::size_t>(b)] = same * here + other * std::conj(there);
    scratch.packed[static_cast<std::size_t>(mirror)] = same * there + other * std::conj(here);
  }
}

void FourierFilter::columns(const Multiplier& multiplier) {
  const double scale = 1 / (static_cast<double>(period_x_) * static_cast<double>(period_y_));
  const bool packed = period_x_ % 2 == 0;
  parallel_for(fourier_block_count(bins_, filter_columns), [&](std::int64_t block) {
    const auto scratch = borrow();
    const int first = static_cast<int>(block) * filter_columns;
    const int here = std::min(filter_columns, bins_ - first);
    BatchFourier::Work& work = scratch->across;
    across_.load(work, row(0) + first, stride_, ny_, here);
    across_.forward(work);
    const bool with_packed = packed && first == 0;
    if (with_packed) multiply_packed(*scratch, multiplier);
    const std::size_t waves = scratch->factors.size();
    constexpr int lanes = BatchFourier::lanes;
    for (int c = with_packed ? 1 : 0; c < here; ++c) {
      multiplier(first + c, scratch->factors);
      auto* const to = scratch->lane_factors.data() + static_cast<std::size_t>(c / lanes) * waves;
      for (std::size_t b = 0; b < waves; ++b) to[b].re[c % lanes] = scratch->factors[b] * scale;
    }
    for (int p = 0; p < BatchFourier::parts; ++p) {
      BatchFourier::Lane* const values = across_.part(work, p);
      const auto* const factors = scratch->lane_factors.data() + static_cast<std::size_t>(p) * waves;
      const auto multiply = [&](int b, const auto& factor) {
        BatchFourier::Lane& value = values[across_.place(b)];
        value.re *= factor.re;
        value.im *= factor.re;
      };
      for (int b = 0; 2 * b <= period_y_; ++b) {
        multiply(b, factors[b]);
        if (b > 0 && 2 * b < period_y_) multiply(period_y_ - b, factors[b]);
      }
    }
    if (with_packed)
      for (int b = 0; b < period_y_; ++b) {
        BatchFourier::Lane& value = across_.part(work, 0)[across_.place(b)];
        value.re[0] = scratch->packed[static_cast<std::size_t>(b)].real();
        value.im[0] = scratch->packed[static_cast<std::size_t>(b)].imag();
      }
    across_.inverse(work);
    across_.store(work, row(0) + first, stride_, ny_, here);
  });
}

int good_fourier_length(int least) { return least <= 1 ? 1 : 2 * smooth_length((least + 1) / 2); }

}  // namespace asperity

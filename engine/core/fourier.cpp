// SPDX-License-Identifier: GPL-3.0-or-later
// Every one-dimensional transform runs from one 64-byte aligned buffer into another, so that FFTW
// may use the machine's vector instructions whatever the row length, and the same plan, hence the
// same bits, serves every row of a length.
#include "engine/core/fourier.hpp"

#include <fftw3.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/fourier_blocks.hpp"
#include "engine/core/fourier_plan.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

namespace {

using Complex = std::complex<double>;

struct RowWork {
  Array<double> signal;
  Array<Complex> bins;
  explicit RowWork(int n) : signal(static_cast<std::size_t>(n)), bins(static_cast<std::size_t>(n / 2 + 1)) {}
};

void forward(fftw_plan plan, RowWork& work, std::span<const double> signal, std::span<Complex> bins) {
  std::copy(signal.begin(), signal.end(), work.signal.begin());
  fftw_execute_dft_r2c(plan, work.signal.data(), fftw(work.bins.data()));
  std::copy(work.bins.begin(), work.bins.end(), bins.begin());
}

void inverse(fftw_plan plan, RowWork& work, std::span<const Complex> bins, std::span<double> signal,
             double scale) {
  std::copy(bins.begin(), bins.end(), work.bins.begin());
  // Plans of some lengths read these parts, of others not.
  work.bins.front().imag(0);
  if (signal.size() % 2 == 0) work.bins.back().imag(0);
  fftw_execute_dft_c2r(plan, fftw(work.bins.data()), work.signal.data());
  std::transform(work.signal.begin(), work.signal.end(), signal.begin(),
                 [scale](double v) { return v * scale; });
}

// Waking a helper costs more than a small transform.
std::optional<SingleThreaded> alone_if_small(std::size_t nodes) {
  constexpr std::size_t worth_sharing = 64 * 64;
  return nodes < worth_sharing ? std::optional<SingleThreaded>(std::in_place) : std::nullopt;
}

// Rows a block takes: enough values to be worth a turn, few enough to share out.
int rows_per_block(int nx) { return std::clamp(65536 / nx, 1, 256); }

// Columns are gathered a cache line's worth at a time, so that each line is read once.
constexpr int columns_per_block = 8;

void transform_columns(HalfSpectrum& spectrum, FourierPlan kind) {
  const int ny = spectrum.ny();
  const int bins_x = spectrum.bins_x();
  if (ny == 1) return;
  const fftw_plan plan = fourier_plan(ny, kind);
  // A column of odd length would leave the next one in the buffer unaligned.
  const std::size_t stride = (static_cast<std::size_t>(ny) + 3) / 4 * 4;
  parallel_for(block_count(bins_x, columns_per_block), [&](std::int64_t block) {
    const int first = static_cast<int>(block) * columns_per_block;
    const int columns = std::min(columns_per_block, bins_x - first);
    Array<Complex> gathered(stride * static_cast<std::size_t>(columns));
    Array<Complex> column(static_cast<std::size_t>(ny));
    for (int b = 0; b < ny; ++b)
      for (int c = 0; c < columns; ++c)
        gathered[static_cast<std::size_t>(c) * stride + static_cast<std::size_t>(b)] = spectrum(first + c, b);
    for (int c = 0; c < columns; ++c) {
      Complex* const start = gathered.data() + static_cast<std::size_t>(c) * stride;
      fftw_execute_dft(plan, fftw(start), fftw(column.data()));
      std::copy(column.begin(), column.end(), start);
    }
    for (int b = 0; b < ny; ++b)
      for (int c = 0; c < columns; ++c)
        spectrum(first + c, b) = gathered[static_cast<std::size_t>(c) * stride + static_cast<std::size_t>(b)];
  });
}

}  // namespace

Array<Complex> fourier_forward(std::span<const double> signal) {
  const auto n = static_cast<int>(signal.size());
  if (n == 0) return {};
  RowWork work(n);
  Array<Complex> bins(work.bins.size());
  forward(fourier_plan(n, FourierPlan::real_forward), work, signal, bins);
  return bins;
}

Array<double> fourier_inverse(std::span<const Complex> half_spectrum, int n) {
  if (n < 0 || half_spectrum.size() != (n == 0 ? 0 : static_cast<std::size_t>(n / 2 + 1)))
    throw Error(ErrorCode::internal, std::to_string(half_spectrum.size()) +
                                         " bins are not the half spectrum of " + std::to_string(n) +
                                         " values");
  if (n == 0) return {};
  RowWork work(n);
  Array<double> signal(static_cast<std::size_t>(n));
  inverse(fourier_plan(n, FourierPlan::real_inverse), work, half_spectrum, signal, 1.0 / n);
  return signal;
}

HalfSpectrum::HalfSpectrum(int nx, int ny)
    : nx_(nx), ny_(ny), bins_(static_cast<std::size_t>(nx / 2 + 1) * static_cast<std::size_t>(ny)) {}

HalfSpectrum fourier_forward(const Field& field) {
  const int nx = field.nx();
  const int ny = field.ny();
  if (field.empty()) throw Error(ErrorCode::internal, "a transform of no values");
  const auto alone = alone_if_small(field.size());
  HalfSpectrum spectrum(nx, ny);
  const fftw_plan plan = fourier_plan(nx, FourierPlan::real_forward);
  const int rows = rows_per_block(nx);
  const auto bins_x = static_cast<std::size_t>(spectrum.bins_x());
  parallel_for(block_count(ny, rows), [&](std::int64_t block) {
    RowWork work(nx);
    const int first = static_cast<int>(block) * rows;
    for (int j = first; j < std::min(first + rows, ny); ++j)
      forward(plan, work, field.row(j),
              spectrum.bins().subspan(static_cast<std::size_t>(j) * bins_x, bins_x));
  });
  transform_columns(spectrum, FourierPlan::complex_forward);
  cost::count_transforms(1);
  return spectrum;
}

Field fourier_inverse(HalfSpectrum spectrum) {
  const int nx = spectrum.nx();
  const int ny = spectrum.ny();
  if (spectrum.bins().empty()) throw Error(ErrorCode::internal, "a transform of no values");
  Field field(nx, ny);
  const auto alone = alone_if_small(field.size());
  transform_columns(spectrum, FourierPlan::complex_inverse);
  const fftw_plan plan = fourier_plan(nx, FourierPlan::real_inverse);
  const int rows = rows_per_block(nx);
  const auto bins_x = static_cast<std::size_t>(spectrum.bins_x());
  const double scale = 1.0 / static_cast<double>(field.size());
  parallel_for(block_count(ny, rows), [&](std::int64_t block) {
    RowWork work(nx);
    const int first = static_cast<int>(block) * rows;
    for (int j = first; j < std::min(first + rows, ny); ++j)
      inverse(plan, work,
              std::as_const(spectrum).bins().subspan(static_cast<std::size_t>(j) * bins_x, bins_x),
              field.row(j), scale);
  });
  cost::count_transforms(1);
  return field;
}

}  // namespace asperity

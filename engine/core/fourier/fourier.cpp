// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/fourier/fourier.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/fourier/fourier_batch.hpp"
#include "engine/core/fourier/fourier_lanes.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

namespace {

using Complex = std::complex<double>;
using SingleFourier = AnyLengthFourier<1>;

std::optional<SingleThreaded> alone_if_small(std::size_t nodes) {
  constexpr std::size_t worth_sharing = 64 * 64;
  return nodes < worth_sharing ? std::optional<SingleThreaded>(std::in_place) : std::nullopt;
}

void transform_columns(HalfSpectrum& spectrum, bool forwards) {
  const int ny = spectrum.ny();
  const int bins_x = spectrum.bins_x();
  if (ny == 1) return;
  const BatchFourier& batch = BatchFourier::of_length(ny);
  constexpr int columns = BatchFourier::columns;
  parallel_for(fourier_block_count(bins_x, columns), [&](std::int64_t block) {
    const int first = static_cast<int>(block) * columns;
    const int here = std::min(columns, bins_x - first);
    BatchFourier::Work work(batch);
    batch.transform(work, &spectrum(first, 0), bins_x, here, forwards);
  });
}

}  // namespace

Array<Complex> fourier_forward(std::span<const double> signal) {
  const auto n = static_cast<int>(signal.size());
  if (n == 0) return {};
  const SingleFourier& plan = cached_fourier<SingleFourier>(n);
  Array<SingleFourier::Complex> values(signal.size()), work(plan.work_length());
  std::ranges::transform(signal, values.begin(), [](double v) { return SingleFourier::Complex{v, 0}; });
  plan.forward(values.data(), work.data());
  Array<Complex> bins(signal.size() / 2 + 1);
  for (int k = 0; k <= n / 2; ++k) {
    const SingleFourier::Complex& bin = values[static_cast<std::size_t>(plan.place(k))];
    bins[static_cast<std::size_t>(k)] = {bin.re, bin.im};
  }
  return bins;
}

Array<double> fourier_inverse(std::span<const Complex> half_spectrum, int n) {
  if (n < 0 || half_spectrum.size() != (n == 0 ? 0 : static_cast<std::size_t>(n / 2 + 1)))
    throw Error(ErrorCode::internal, std::to_string(half_spectrum.size()) +
                                         " bins are not the half spectrum of " + std::to_string(n) +
                                         " values");
  if (n == 0) return {};
  const SingleFourier& plan = cached_fourier<SingleFourier>(n);
  Array<SingleFourier::Complex> values(static_cast<std::size_t>(n)), work(plan.work_length());
  for (int k = 0; k <= n / 2; ++k) {
    const Complex bin = half_spectrum[static_cast<std::size_t>(k)];
    const bool is_real = k == 0 || 2 * k == n;
    values[static_cast<std::size_t>(plan.place(k))] = {bin.real(), is_real ? 0 : bin.imag()};
    if (!is_real) values[static_cast<std::size_t>(plan.place(n - k))] = {bin.real(), -bin.imag()};
  }
  plan.inverse(values.data(), work.data());
  Array<double> signal(static_cast<std::size_t>(n));
  std::ranges::transform(values, signal.begin(),
                         [scale = 1.0 / n](const SingleFourier::Complex& v) { return v.re * scale; });
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
  const BatchFourier& batch = BatchFourier::of_length(nx);
  constexpr int rows = BatchFourier::rows;
  parallel_for(fourier_block_count(ny, rows), [&](std::int64_t block) {
    BatchFourier::Work work(batch);
    const int first = static_cast<int>(block) * rows, here = std::min(rows, ny - first);
    batch.real_forward(work, batch.spaced(field.row(first).data(), nx, here).data(), nx, here,
                       batch.spaced(&spectrum(0, first), spectrum.bins_x(), here).data());
  });
  transform_columns(spectrum, true);
  cost::count_transforms(1);
  return spectrum;
}

Field fourier_inverse(HalfSpectrum spectrum) {
  const int nx = spectrum.nx();
  const int ny = spectrum.ny();
  if (spectrum.bins().empty()) throw Error(ErrorCode::internal, "a transform of no values");
  Field field(nx, ny);
  const auto alone = alone_if_small(field.size());
  transform_columns(spectrum, false);
  const BatchFourier& batch = BatchFourier::of_length(nx);
  constexpr int rows = BatchFourier::rows;
  const double scale = 1.0 / static_cast<double>(field.size());
  parallel_for(fourier_block_count(ny, rows), [&](std::int64_t block) {
    BatchFourier::Work work(batch);
    const int first = static_cast<int>(block) * rows, here = std::min(rows, ny - first);
    batch.real_inverse(work, batch.spaced(&spectrum(0, first), spectrum.bins_x(), here).data(), here, nx,
                       scale, batch.spaced(field.row(first).data(), nx, here).data());
  });
  cost::count_transforms(1);
  return field;
}

}  // namespace asperity

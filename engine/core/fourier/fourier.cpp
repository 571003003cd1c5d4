// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/fourier/fourier.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "engine/core/cost.hpp"
#include "engine/core/error.hpp"
#include "engine/core/fourier/fourier_batch.hpp"
#include "engine/core/fourier/fourier_blocks.hpp"
#include "engine/core/parallel.hpp"

namespace asperity {

namespace {

using Complex = std::complex<double>;
using SingleFourier = AnyLengthFourier<1>;

// Cached for the life of the process.
const SingleFourier& single_fourier(int n) {
  static std::mutex mutex;
  static std::map<int, std::unique_ptr<const SingleFourier>> kept;
  const std::lock_guard lock(mutex);
  std::unique_ptr<const SingleFourier>& plan = kept[n];
  if (!plan) plan = std::make_unique<const SingleFourier>(n);
  return *plan;
}

// Waking a helper costs more than a small transform.
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
  parallel_for(block_count(bins_x, columns), [&](std::int64_t block) {
    const int first = static_cast<int>(block) * columns;
    const int here = std::min(columns, bins_x - first);
    BatchFourier::Work work(batch);
    Complex* const at = spectrum.bins().data() + first;
    if (forwards) {
      batch.load(work, at, bins_x, ny, here);
      batch.forward(work);
      batch.store_bins(work, at, bins_x, here);
    } else {
      batch.load_bins(work, at, bins_x, here);
      batch.inverse(work);
      batch.store(work, at, bins_x, ny, here);
    }
  });
}

}  // namespace

Array<Complex> fourier_forward(std::span<const double> signal) {
  const auto n = static_cast<int>(signal.size());
  if (n == 0) return {};
  const SingleFourier& plan = single_fourier(n);
  Array<SingleFourier::Complex> values(signal.size()), work(plan.work_length());
  std::transform(signal.begin(), signal.end(), values.begin(), [](double v) {
    return SingleFourier::Complex{v, 0};
  });
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
  const SingleFourier& plan = single_fourier(n);
  Array<SingleFourier::Complex> values(static_cast<std::size_t>(n)), work(plan.work_length());
  for (int k = 0; k <= n / 2; ++k) {
    const Complex bin = half_spectrum[static_cast<std::size_t>(k)];
    const bool is_real = k == 0 || 2 * k == n;
    values[static_cast<std::size_t>(plan.place(k))] = {bin.real(), is_real ? 0 : bin.imag()};
    if (!is_real) values[static_cast<std::size_t>(plan.place(n - k))] = {bin.real(), -bin.imag()};
  }
  plan.inverse(values.data(), work.data());
  Array<double> signal(static_cast<std::size_t>(n));
  std::transform(values.begin(), values.end(), signal.begin(),
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
  const auto bins_x = static_cast<std::size_t>(spectrum.bins_x());
  parallel_for(block_count(ny, rows), [&](std::int64_t block) {
    BatchFourier::Work work(batch);
    const int first = static_cast<int>(block) * rows, here = std::min(rows, ny - first);
    std::array<const double*, rows> in;
    std::array<Complex*, rows> out;
    for (int r = 0; r < here; ++r) {
      in[static_cast<std::size_t>(r)] = field.row(first + r).data();
      out[static_cast<std::size_t>(r)] =
          spectrum.bins().data() + static_cast<std::size_t>(first + r) * bins_x;
    }
    batch.real_forward(work, in.data(), nx, here, out.data());
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
  const auto bins_x = static_cast<std::size_t>(spectrum.bins_x());
  const double scale = 1.0 / static_cast<double>(field.size());
  parallel_for(block_count(ny, rows), [&](std::int64_t block) {
    BatchFourier::Work work(batch);
    const int first = static_cast<int>(block) * rows, here = std::min(rows, ny - first);
    std::array<const Complex*, rows> in;
    std::array<double*, rows> out;
    for (int r = 0; r < here; ++r) {
      in[static_cast<std::size_t>(r)] = spectrum.bins().data() + static_cast<std::size_t>(first + r) * bins_x;
      out[static_cast<std::size_t>(r)] = field.row(first + r).data();
    }
    batch.real_inverse(work, in.data(), here, nx, scale, out.data());
  });
  cost::count_transforms(1);
  return field;
}

}  // namespace asperity

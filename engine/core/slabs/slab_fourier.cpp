// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/slabs/slab_fourier.hpp"

#include <algorithm>
#include <array>

#include "engine/core/fourier/fourier_batch.hpp"

namespace asperity {

namespace {

class SlabFourierOfOne final : public SlabFourier {
 public:
  SlabFourierOfOne(int nx, int ny)
      : nx_(nx), ny_(ny), along_(BatchFourier::of_length(nx)), across_(BatchFourier::of_length(ny)) {
    waves_ = nx / 2 + 1;
    step_b_ = waves_;
    stride_ = 2 * step_b_;
    buffer_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(ny));
  }

  void forward() override {
    BatchFourier::Work work(along_);
    for (int first = 0; first < ny_; first += BatchFourier::rows) {
      const int here = std::min(BatchFourier::rows, ny_ - first);
      std::array<const double*, BatchFourier::rows> from;
      std::array<std::complex<double>*, BatchFourier::rows> to;
      for (int r = 0; r < here; ++r) {
        from[static_cast<std::size_t>(r)] = row(first + r);
        to[static_cast<std::size_t>(r)] = &bin(0, first + r);
      }
      along_.real_forward(work, from.data(), nx_, here, to.data());
    }
    columns([this](BatchFourier::Work& column, std::complex<double>* at, int count) {
      across_.load(column, at, step_b_, ny_, count);
      across_.forward(column);
      across_.store_bins(column, at, step_b_, count);
    });
  }

  void inverse() override {
    columns([this](BatchFourier::Work& column, std::complex<double>* at, int count) {
      across_.load_bins(column, at, step_b_, count);
      across_.inverse(column);
      across_.store(column, at, step_b_, ny_, count);
    });
    BatchFourier::Work work(along_);
    for (int first = 0; first < ny_; first += BatchFourier::rows) {
      const int here = std::min(BatchFourier::rows, ny_ - first);
      std::array<const std::complex<double>*, BatchFourier::rows> from;
      std::array<double*, BatchFourier::rows> to;
      for (int r = 0; r < here; ++r) {
        from[static_cast<std::size_t>(r)] = &bin(0, first + r);
        to[static_cast<std::size_t>(r)] = row(first + r);
      }
      along_.real_inverse(work, from.data(), here, nx_, 1, to.data());
    }
  }

 private:
  template <class Act>
  void columns(const Act& act) {
    BatchFourier::Work work(across_);
    for (int first = 0; first < waves_; first += BatchFourier::columns)
      act(work, &bin(first, 0), std::min(BatchFourier::columns, waves_ - first));
  }

  int nx_, ny_;
  const BatchFourier &along_, &across_;
};

}  // namespace

std::unique_lock<std::mutex> lock_fourier_planner() {
  static std::mutex mutex;
  return std::unique_lock(mutex);
}

std::unique_ptr<SlabFourier> fourier_alone(int nx, int ny) {
  return std::make_unique<SlabFourierOfOne>(nx, ny);
}

}  // namespace asperity

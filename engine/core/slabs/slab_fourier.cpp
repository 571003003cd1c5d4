// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/slabs/slab_fourier.hpp"

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
      along_.real_forward(work, along_.spaced(row(first), stride_, here).data(), nx_, here,
                          along_.spaced(&bin(0, first), step_b_, here).data());
    }
    columns(true);
  }

  void inverse() override {
    columns(false);
    BatchFourier::Work work(along_);
    for (int first = 0; first < ny_; first += BatchFourier::rows) {
      const int here = std::min(BatchFourier::rows, ny_ - first);
      along_.real_inverse(work, along_.spaced(&bin(0, first), step_b_, here).data(), here, nx_, 1,
                          along_.spaced(row(first), stride_, here).data());
    }
  }

 private:
  void columns(bool forwards) {
    BatchFourier::Work work(across_);
    for (int first = 0; first < waves_; first += BatchFourier::columns)
      across_.transform(work, &bin(first, 0), step_b_, std::min(BatchFourier::columns, waves_ - first),
                        forwards);
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/slabs/slab_fourier.hpp"

#include <fftw3.h>

#include "engine/core/error.hpp"
#include "engine/core/fourier_plan.hpp"

namespace asperity {

namespace {

class SlabFourierOfOne final : public SlabFourier {
 public:
  SlabFourierOfOne(int nx, int ny) {
    waves_ = nx / 2 + 1;
    step_b_ = waves_;
    stride_ = 2 * step_b_;
    buffer_.resize(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(ny));
    auto* const bins = reinterpret_cast<fftw_complex*>(buffer_.data());
    const auto lock = lock_fourier_planner();
    forward_ = fftw_plan_dft_r2c_2d(ny, nx, buffer_.data(), bins, FFTW_ESTIMATE);
    back_ = fftw_plan_dft_c2r_2d(ny, nx, bins, buffer_.data(), FFTW_ESTIMATE);
    if (forward_ == nullptr || back_ == nullptr)
      throw Error(ErrorCode::internal, "FFTW has no plan for a transform of this grid");
  }
  ~SlabFourierOfOne() override {
    const auto lock = lock_fourier_planner();
    if (forward_ != nullptr) fftw_destroy_plan(forward_);
    if (back_ != nullptr) fftw_destroy_plan(back_);
  }
  SlabFourierOfOne(const SlabFourierOfOne&) = delete;
  SlabFourierOfOne& operator=(const SlabFourierOfOne&) = delete;
  void forward() override { fftw_execute(forward_); }
  void inverse() override { fftw_execute(back_); }

 private:
  fftw_plan forward_ = nullptr, back_ = nullptr;
};

}  // namespace

std::unique_ptr<SlabFourier> fourier_alone(int nx, int ny) {
  return std::make_unique<SlabFourierOfOne>(nx, ny);
}

}  // namespace asperity

// SPDX-License-Identifier: GPL-3.0-or-later
// Real Fourier transform of a field in slabs, unnormalised, in its own buffer. Each process has rows before,
// and some waves along x with all waves along y after. No plan is measured: one process gives the same bits
// everywhere, K processes only on one kind of processor and C library.
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <mutex>

#include "engine/core/memory.hpp"
#include "engine/core/slabs/slab.hpp"

namespace asperity {

class SlabFourier {
 public:
  virtual ~SlabFourier() = default;
  // Row j of this process, nx values.
  double* row(int j) { return buffer_.data() + static_cast<std::ptrdiff_t>(j) * stride_; }

  // From rows to waves, and back; all processes together.
  virtual void forward() = 0;
  virtual void inverse() = 0;

  // The waves of this process: a = first_wave() … + waves(), b = 0 … ny − 1; b > ny/2 represents b − ny.
  int first_wave() const { return first_wave_; }
  int waves() const { return waves_; }
  std::complex<double>& bin(int a, int b) {
    return reinterpret_cast<std::complex<double>*>(
        buffer_.data())[(a - first_wave_) * step_a_ + static_cast<std::ptrdiff_t>(b) * step_b_];
  }
  // The loop with the smaller memory step is faster.
  bool along_b_is_faster() const { return step_b_ == 1; }

 protected:
  Array<double> buffer_;
  std::ptrdiff_t stride_ = 0, step_a_ = 1, step_b_ = 1;
  int first_wave_ = 0, waves_ = 0;
};

std::unique_ptr<SlabFourier> fourier_alone(int nx, int ny);

// FFTW's planner is not thread-safe: lock while plans are made or destroyed.
std::unique_lock<std::mutex> lock_fourier_planner();

}  // namespace asperity

// SPDX-License-Identifier: GPL-3.0-or-later
// The real Fourier transform of a field in slabs, in place in a buffer of its own: each process holds rows of
// the field before and some of the waves along x, with all those along y, after. Unnormalised both ways. No
// plan is measured, so the same number of processes gives the same bits on one kind of processor. One process
// gives the same on all; of several FFTW chooses the operations by the processor, and takes factors from the
// C library: elsewhere the last bits may differ.
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

  // All processes together. From rows to waves, and back.
  virtual void forward() = 0;
  virtual void inverse() = 0;

  // The waves of this process: a = first_wave() … + waves(), b = 0 … ny − 1; b > ny/2 stands for b − ny.
  int first_wave() const { return first_wave_; }
  int waves() const { return waves_; }
  std::complex<double>& bin(int a, int b) {
    return reinterpret_cast<std::complex<double>*>(
        buffer_.data())[(a - first_wave_) * step_a_ + static_cast<std::ptrdiff_t>(b) * step_b_];
  }
  // Along b in steps of step_b, or along a in steps of step_a: the smaller runs faster.
  bool along_b_is_faster() const { return step_b_ == 1; }

 protected:
  Array<double> buffer_;
  std::ptrdiff_t stride_ = 0, step_a_ = 1, step_b_ = 1;
  int first_wave_ = 0, waves_ = 0;
};

// Of a process alone, in batches of lanes: the same bits on every processor.
std::unique_ptr<SlabFourier> fourier_alone(int nx, int ny);

// Held while plans are made or destroyed: FFTW's planner is not thread-safe.
std::unique_lock<std::mutex> lock_fourier_planner();

}  // namespace asperity

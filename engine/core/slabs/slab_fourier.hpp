// SPDX-License-Identifier: GPL-3.0-or-later
// Real Fourier transform of a field in slabs, unnormalised, in its own buffer: rows before; some waves along
// x, with all waves along y, after. One process gives the same bits everywhere, K processes only on one kind
// of processor and C library.
#pragma once

#include <algorithm>
#include <complex>
#include <cstddef>
#include <memory>
#include <mutex>

#include "engine/core/memory.hpp"

namespace asperity {

// Rows of a grid on one process, in FFTW's blocks of ⌈ny/K⌉; the last ones shorter or empty.
struct Slab {
  int nx = 0, ny = 0;  // of the whole grid
  int rank = 0, ranks = 1;

  int block() const { return (ny + ranks - 1) / ranks; }
  int first_of(int r) const { return std::min(r * block(), ny); }
  int rows_of(int r) const { return first_of(r + 1) - first_of(r); }
  int owner(int row) const { return row / block(); }
  int first() const { return first_of(rank); }
  int rows() const { return rows_of(rank); }
  std::size_t width() const { return static_cast<std::size_t>(nx); }
  std::size_t nodes() const { return width() * static_cast<std::size_t>(rows()); }  // of this process
  double all_nodes() const { return static_cast<double>(nx) * static_cast<double>(ny); }
  bool operator==(const Slab&) const = default;
};

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

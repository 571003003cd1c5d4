// SPDX-License-Identifier: GPL-3.0-or-later
// Real 1-D and 2-D Fourier transforms, rows before columns, in batches of lanes (fourier_batch.hpp). The
// inverse divides by n. Tables are cached per length. Thread-safe. Any length from 1; a prime factor above 31
// costs six times as much.
#pragma once

#include <complex>
#include <span>

#include "engine/core/grid.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

// Half spectrum of n real values: bins 0 … n/2.
Array<std::complex<double>> fourier_forward(std::span<const double> signal);
Array<double> fourier_inverse(std::span<const std::complex<double>> half_spectrum, int n);

// Half spectrum of a real field: ny rows of nx/2+1 bins. Bin (a, b) is the wave exp(2πi(a·i/nx + b·j/ny)), b
// = 0 … ny-1; the upper half of b is negative waves.
class HalfSpectrum {
 public:
  HalfSpectrum(int nx, int ny);
  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int bins_x() const { return nx_ / 2 + 1; }
  std::complex<double>& operator()(int a, int b) { return bins_[index(a, b)]; }
  std::complex<double> operator()(int a, int b) const { return bins_[index(a, b)]; }
  std::span<std::complex<double>> bins() { return bins_; }
  std::span<const std::complex<double>> bins() const { return bins_; }
  // -ny/2 … ny/2.
  int wave_y(int b) const { return b <= ny_ / 2 ? b : b - ny_; }

 private:
  std::size_t index(int a, int b) const {
    return static_cast<std::size_t>(b) * static_cast<std::size_t>(bins_x()) + static_cast<std::size_t>(a);
  }
  int nx_, ny_;
  Array<std::complex<double>> bins_;
};

// Each counts one transform (cost::count_transforms).
HalfSpectrum fourier_forward(const Field& field);
// Overwrites the spectrum; ignores imaginary parts of real bins.
Field fourier_inverse(HalfSpectrum spectrum);

}  // namespace asperity

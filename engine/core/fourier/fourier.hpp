// SPDX-License-Identifier: GPL-3.0-or-later
// Real Fourier transforms in one and two dimensions: rows first, then columns, in batches of lanes
// (fourier_batch.hpp), so that the bits depend neither on the number of threads nor on the processor.
// Unnormalised forwards; inverse divides by n. Tables are made once per length and kept. Thread-safe. Any
// length from 1; one with a prime factor above 31 takes some six times as long.
#pragma once

#include <complex>
#include <span>

#include "engine/core/grid.hpp"
#include "engine/core/memory.hpp"

namespace asperity {

// Half spectrum of a real signal of n values: bins 0 … n/2.
Array<std::complex<double>> fourier_forward(std::span<const double> signal);
Array<double> fourier_inverse(std::span<const std::complex<double>> half_spectrum, int n);

// Half spectrum of a real field: ny rows of nx/2+1 bins; bin (a, b) belongs to the wave
// exp(2πi(a·i/nx + b·j/ny)), b running 0 … ny-1 with the upper half the negative waves.
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
  // The signed wave number of row b, from -ny/2 … ny/2.
  int wave_y(int b) const { return b <= ny_ / 2 ? b : b - ny_; }

 private:
  std::size_t index(int a, int b) const {
    return static_cast<std::size_t>(b) * static_cast<std::size_t>(bins_x()) + static_cast<std::size_t>(a);
  }
  int nx_, ny_;
  Array<std::complex<double>> bins_;
};

// One transform each, counted with cost::count_transforms(1).
HalfSpectrum fourier_forward(const Field& field);
// Consumes the spectrum as work space. Imaginary parts of bins that must be real are ignored.
Field fourier_inverse(HalfSpectrum spectrum);

}  // namespace asperity

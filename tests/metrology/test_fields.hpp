// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/surface/profile.hpp"
#include "engine/surface/surface.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::testing {

template <class Height>
Surface make_surface(int nx, int ny, double size_x, double size_y, const Height& height,
                     SurfaceTraits traits = {}) {
  Field z(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) z(i, j) = height(i, j);
  return Surface(make_grid(nx, ny, size_x, size_y), std::move(z), std::move(traits));
}

inline SurfaceTraits periodic() {
  SurfaceTraits traits;
  traits.periodic = true;
  return traits;
}

template <class Height>
Profile make_profile(int n, double spacing, const Height& height) {
  Array<double> z(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) z[static_cast<std::size_t>(i)] = height(i);
  return Profile(spacing, std::move(z));
}

inline Surface white_noise(int nx, int ny, double size_x, double size_y, std::uint64_t seed) {
  const Stream stream(seed, "white noise");
  return make_surface(nx, ny, size_x, size_y, [&](int i, int j) {
    return stream.normal(static_cast<std::uint64_t>(j) * 100000 + i);
  });
}

// Exact fractional Brownian motion, increments of variance 1, by circulant embedding (Davies & Harte 1987).
inline Array<double> fractional_brownian(int n, double H, std::uint64_t seed) {
  const int m = 2 * n;
  const auto covariance = [H](double k) {
    const double p = 2 * H;
    return 0.5 * (std::pow(std::abs(k + 1), p) - 2 * std::pow(std::abs(k), p) + std::pow(std::abs(k - 1), p));
  };
  Array<double> row(static_cast<std::size_t>(m));
  for (int k = 0; k < m; ++k) row[static_cast<std::size_t>(k)] = covariance(k <= n ? k : m - k);
  const Array<std::complex<double>> eigenvalues = fourier_forward(row);
  const Stream stream(seed, "fractional brownian");
  Array<std::complex<double>> waves(eigenvalues.size());
  for (std::size_t k = 0; k < waves.size(); ++k) {
    const double size = std::sqrt(std::max(0.0, eigenvalues[k].real()) * m);
    const bool own_twin = k == 0 || 2 * k == static_cast<std::size_t>(m);
    waves[k] = own_twin ? std::complex<double>(size * stream.normal(2 * k))
                        : size * std::sqrt(0.5) *
                              std::complex<double>(stream.normal(2 * k), stream.normal(2 * k + 1));
  }
  const Array<double> increments = fourier_inverse(waves, m);
  Array<double> heights(static_cast<std::size_t>(n));
  double sum = 0;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    heights[i] = sum;
    sum += increments[i];
  }
  return heights;
}

template <class Call>
std::string error_text(const Call& call) {
  return test::error_of([&] { call(); }, "no error");
}

}  // namespace asperity::testing

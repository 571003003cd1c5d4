// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/parameters/texture_direction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/require.hpp"
#include "engine/metrology/blocked_sums.hpp"
#include "engine/metrology/spectrum.hpp"
#include "engine/surface/operations/missing_points.hpp"

namespace asperity {

namespace {

constexpr int half_degrees = 360;
constexpr double least_cycles = 3;  // shortest waves along the shorter side

// Bin of a wave (x, y), y >= 0, by cross products with the borders, without arc tangents.
class Bins {
 public:
  Bins() {
    for (int k = 0; k < half_degrees; ++k) {
      const double angle = (k + 0.5) * std::numbers::pi / half_degrees;
      cosines_[static_cast<std::size_t>(k)] = elementary::cos(angle);
      sines_[static_cast<std::size_t>(k)] = elementary::sin(angle);
    }
  }
  int of(double x, double y) const {
    int low = 0, high = half_degrees;  // borders passed
    while (low < high) {
      const int k = (low + high) / 2;
      const auto m = static_cast<std::size_t>(k);
      if (y * cosines_[m] - x * sines_[m] >= 0)
        low = k + 1;
      else
        high = k;
    }
    return low % half_degrees;
  }

 private:
  std::array<double, half_degrees> cosines_{}, sines_{};
};

}  // namespace

TextureDirection texture_direction(const Surface& surface) {
  const Grid& grid = surface.grid();
  const Range r = surface.height_range();
  if (r.span() == 0) refuse("the direction of a flat surface was asked for", "it needs heights that differ");
  const double nyquist = 0.5 / std::max(grid.hx(), grid.hy());
  if (nyquist * std::min(grid.size_x, grid.size_y) < least_cycles)
    refuse("the map is under six of its longer cells wide, and so few waves have no direction",
           "measure more cells along the shorter side");
  const Field& z = surface.measured_heights();
  const double mean = exact_mean(MeasuredValues(surface).values(), r);
  const double unit = std::ldexp(1.0, -scale_exponent(std::max(r.max - mean, mean - r.min)));
  const Array<double> along_x = hann_window(grid.nx), along_y = hann_window(grid.ny);
  Field windowed(grid.nx, grid.ny);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i)
      if (const double h = z(i, j); !std::isnan(h))
        windowed(i, j) =
            (h - mean) * unit * along_x[static_cast<std::size_t>(i)] * along_y[static_cast<std::size_t>(j)];
  const HalfSpectrum spectrum = fourier_forward(windowed);

  const Bins bins;
  // Row by row: fixed order of sums.
  Field of_rows(half_degrees, grid.ny);
  parallel_for(grid.ny, [&](std::int64_t row) {
    const int b = static_cast<int>(row), wave_y = spectrum.wave_y(b);
    const std::span<double> power = of_rows.row(b);
    for (int a = 0; a < spectrum.bins_x(); ++a) {
      if (a == 0 && wave_y < 0) continue;  // same as its opposite
      const double fx = a / grid.size_x, fy = wave_y / grid.size_y;
      if (a * a + static_cast<double>(wave_y) * wave_y <= 1.5 * 1.5 || fx * fx + fy * fy >= nyquist * nyquist)
        continue;
      const int bin = fy < 0 ? bins.of(-fx, -fy) : bins.of(fx, fy);
      power[static_cast<std::size_t>(bin)] += std::norm(spectrum(a, b));
    }
  });
  std::array<double, half_degrees> power{};
  for (int b = 0; b < grid.ny; ++b)
    for (int k = 0; k < half_degrees; ++k) power[static_cast<std::size_t>(k)] += of_rows(k, b);
  double total = 0;
  for (const double p : power) total += p;
  if (!(total > 0))
    refuse("no wave of the surface is longer than two cells and shorter than two thirds of the map",
           "its direction needs more cells");
  const auto greatest = std::max_element(power.begin(), power.end());
  const auto bin = static_cast<double>(greatest - power.begin());
  TextureDirection result;
  result.wave = bin * std::numbers::pi / half_degrees;
  result.lay = (bin < half_degrees / 2 ? bin + half_degrees / 2.0 : bin - half_degrees / 2.0) *
               std::numbers::pi / half_degrees;
  result.share = *greatest / total;
  return result;
}

}  // namespace asperity

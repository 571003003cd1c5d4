// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/sine.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/constants.hpp"
#include "engine/core/require.hpp"

namespace asperity {

namespace {

// cos(2π turns), turns in [0, 1/2]; exact at every eighth with an exact cosine.
double cosine_of_turns(double turns) {
  if (turns > 0.25) return -cosine_of_turns(0.5 - turns);
  return turns > 0.125 ? elementary::sin(two_pi * (0.25 - turns)) : elementary::cos(two_pi * turns);
}

struct Waves {
  double count;  // wavelengths per size
  bool whole;
};

Waves waves_in(double size, double wavelength) {
  constexpr double whole_to = 1e-12;
  const double count = size / wavelength;
  const double nearest = std::round(count);
  const bool whole = nearest >= 1 && std::abs(count - nearest) <= whole_to * nearest;
  return {whole ? nearest : count, whole};
}

Array<double> wave(int n, Waves waves) {
  Array<double> values(static_cast<std::size_t>(n));
  const auto turns = static_cast<std::int64_t>(waves.whole ? waves.count : 0);
  for (int i = 0; i < n; ++i) {
    if (waves.whole) {
      const std::int64_t step = turns * i % n;
      values[i] = cosine_of_turns(static_cast<double>(std::min(step, n - step)) / n);
    } else {
      values[i] = cosine_of_turns(std::abs(std::remainder(i * waves.count, n)) / n);
    }
  }
  return values;
}

void check_resolved(double wavelength, double cell, const char* direction) {
  constexpr double rounding = 1e-12;
  if (wavelength >= 2 * cell * (1 - rounding)) return;
  refuse("`wavelength` is " + metres(wavelength) + ", under two cells of " + metres(cell) + " along " +
             direction,
         "give at least " + metres(2 * cell) + ", or more `cells`");
}

}  // namespace

SineFactors sine_factors(const SineOptions& options) {
  const Grid grid = make_grid(options.grid.nx, options.grid.ny, options.grid.size_x, options.grid.size_y);
  const double amplitude = options.amplitude;
  require(std::isfinite(amplitude) && amplitude >= 0, "amplitude", amplitude, "m",
          "give a finite length, zero or above");
  const double wavelength = options.wavelength.value_or(grid.size_x);
  require_positive("wavelength", wavelength, "m", "give a finite length above zero");
  require(options.directions == 1 || options.directions == 2, "directions", options.directions, "",
          "give 1 for waves along x, or 2 for their product with waves along y");
  const bool both = options.directions == 2;
  check_resolved(wavelength, grid.hx(), "x");
  if (both) check_resolved(wavelength, grid.hy(), "y");

  SineFactors factors;
  factors.wavelength = wavelength;
  const Waves along_x = waves_in(grid.size_x, wavelength);
  const Waves along_y = waves_in(grid.size_y, wavelength);
  factors.x = wave(grid.nx, along_x);
  factors.y = both ? wave(grid.ny, along_y) : Array<double>(static_cast<std::size_t>(grid.ny), 1.0);
  factors.periodic = along_x.whole && (!both || along_y.whole);
  return factors;
}

Surface sine_surface(const SineOptions& options, Monitor&) {
  const SineFactors factors = sine_factors(options);
  const Grid& grid = options.grid;
  Field heights(grid.nx, grid.ny);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) heights(i, j) = options.amplitude * (factors.x[i] * factors.y[j]);
  SineOptions same = options;
  same.wavelength = factors.wavelength;
  return Surface(grid, std::move(heights), {.periodic = factors.periodic})
      .made_by([same](int nx, int ny, Monitor& monitor) {
        SineOptions on_other_cells = same;
        on_other_cells.grid.nx = nx;
        on_other_cells.grid.ny = ny;
        return sine_surface(on_other_cells, monitor);
      });
}

}  // namespace asperity

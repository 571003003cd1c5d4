// SPDX-License-Identifier: GPL-3.0-or-later
// Fractional shifts multiply the spectrum by a phase; Nyquist bins take its real part.
#include "engine/surface/operations/placement.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/fourier/fourier.hpp"
#include "engine/core/require.hpp"
#include "engine/surface/operations/missing_points.hpp"
#include "engine/surface/operations/resampling.hpp"
#include "engine/surface/parallel_rows.hpp"

namespace asperity {

namespace {

constexpr double whole_cell = 1e-9;

bool is_whole(double cells) { return std::abs(cells - std::round(cells)) <= whole_cell; }

int wrapped(double cells, int n) {
  return static_cast<int>(std::fmod(std::fmod(std::round(cells), n) + n, n));
}

Field shifted_by_cells(const Field& heights, int right, int up) {
  const int nx = heights.nx(), ny = heights.ny();
  Field result(nx, ny);
  for (int j = 0; j < ny; ++j) {
    const auto from = heights.row(j);
    const auto to = result.row((j + up) % ny);
    std::rotate_copy(from.begin(), from.end() - right, from.end(), to.begin());
  }
  return result;
}

std::complex<double> phase(double cells, int wave, int n) {
  const double turns = cells * wave / n;
  const double angle = -2 * std::numbers::pi * (turns - std::round(turns));
  if (2 * wave == n || 2 * wave == -n) return elementary::cos(angle);
  return {elementary::cos(angle), elementary::sin(angle)};
}

Field shifted_by_waves(const Field& heights, double right, double up) {
  HalfSpectrum spectrum = fourier_forward(heights);
  const int nx = heights.nx(), ny = heights.ny();
  Array<std::complex<double>> along_x(static_cast<std::size_t>(spectrum.bins_x()));
  for (int a = 0; a < spectrum.bins_x(); ++a) along_x[static_cast<std::size_t>(a)] = phase(right, a, nx);
  for (int b = 0; b < ny; ++b) {
    const std::complex<double> along_y = phase(up, spectrum.wave_y(b), ny);
    for (int a = 0; a < spectrum.bins_x(); ++a)
      spectrum(a, b) *= along_x[static_cast<std::size_t>(a)] * along_y;
  }
  return fourier_inverse(std::move(spectrum));
}

Surface quarter_turned(const Surface& surface, int quarters) {
  const Grid& g = surface.grid();
  const Field& h = surface.measured_heights();
  const bool odd = quarters % 2 != 0;
  const Grid grid = odd ? Grid{g.ny, g.nx, g.size_y, g.size_x} : g;
  Field result(grid.nx, grid.ny);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i)
      result(i, j) = quarters == 1   ? h(j, g.ny - 1 - i)
                     : quarters == 2 ? h(g.nx - 1 - i, g.ny - 1 - j)
                                     : h(g.nx - 1 - j, i);
  return remade_with(!surface.complete(), grid, std::move(result), surface.traits());
}

// For periodic surfaces with holes: no spectrum.
Surface shifted_between_nodes(const Surface& surface, double right, double up) {
  const Grid& g = surface.grid();
  Field result(g.nx, g.ny);
  // A nearly whole shift must touch only one node.
  const auto place = [](double at) { return is_whole(at) ? std::round(at) : at; };
  right = place(right);
  up = place(up);
  for_each_row<1>(g.ny, [&](int j) {
    const CubicWeights y = cubic_weights(j - up, g.ny, true);
    for (int i = 0; i < g.nx; ++i)
      result(i, j) = cubic_height(surface.measured_heights(), cubic_weights(i - right, g.nx, true), y, true);
  });
  SurfaceTraits traits = surface.traits();
  traits.aliased_share.reset();
  return remade_with(true, g, std::move(result), std::move(traits));
}

}  // namespace

Surface shifted(const Surface& surface, double x, double y) {
  const Grid& grid = surface.grid();
  for (const double shift : {x, y})
    if (!std::isfinite(shift))
      refuse("a shift is " + format_short(shift) + " m", "give finite lengths `x` and `y`");
  const double right = x / grid.hx(), up = y / grid.hy();
  if (is_whole(right) && is_whole(up)) {
    const Surface moved = remade_with(
        !surface.complete(), grid,
        shifted_by_cells(surface.measured_heights(), wrapped(right, grid.nx), wrapped(up, grid.ny)),
        surface.traits());
    if (!surface.recipe()) return moved;
    // Throws for cells that make the shift fractional, unless periodic.
    return moved.made_by([recipe = surface.recipe(), x, y](int nx, int ny, Monitor& monitor) {
      return shifted((*recipe)(nx, ny, monitor), x, y);
    });
  }
  if (!surface.traits().periodic) {
    const bool along_x = !is_whole(right);
    const double cells = along_x ? right : up, cell = along_x ? grid.hx() : grid.hy();
    refuse(std::string("a shift of `") + (along_x ? "x` = " : "y` = ") + format_short(along_x ? x : y) +
               " m is " + format_short(cells) + " cells, and this surface is not periodic",
           "shift it by whole cells; the nearest is " + format_short(std::round(cells) * cell, 12) + " m");
  }
  if (!surface.complete())
    return shifted_between_nodes(surface, std::fmod(right, grid.nx), std::fmod(up, grid.ny));
  // Large shifts would lose digits of the phase.
  return Surface(grid, shifted_by_waves(surface.heights(), std::fmod(right, grid.nx), std::fmod(up, grid.ny)),
                 surface.traits());
}

Surface rotated(const Surface& surface, double angle) {
  if (!std::isfinite(angle))
    refuse("the angle of a rotation is " + format_short(angle), "give a finite angle");
  const double quarters = angle / (std::numbers::pi / 2);
  if (is_whole(quarters)) {
    const int turn = wrapped(quarters, 4);
    return turn == 0 ? surface : quarter_turned(surface, turn);
  }
  const Grid& g = surface.grid();
  const double c = elementary::cos(angle), s = elementary::sin(angle);
  const bool periodic = surface.traits().periodic;
  const double width = (g.nx - 1) * g.hx(), height = (g.ny - 1) * g.hy();
  int nx = g.nx, ny = g.ny;
  if (!periodic) {
    const double share = std::min(width / (width * std::abs(c) + height * std::abs(s)),
                                  height / (width * std::abs(s) + height * std::abs(c)));
    const double kept = share > 0 ? share : 0.0;  // 0 for a single node
    nx = static_cast<int>(kept * (g.nx - 1) + whole_cell) + 1;
    ny = static_cast<int>(kept * (g.ny - 1) + whole_cell) + 1;
    if (nx < 2 || ny < 2)
      refuse("nothing of a surface of " + std::to_string(g.nx) + " x " + std::to_string(g.ny) +
                 " cells remains after a turn of " + format_short(angle) + " rad",
             "turn it by a multiple of a quarter turn, or use more cells");
  }
  Field result(nx, ny);
  const Field& h = surface.measured_heights();
  const bool holes = !surface.complete();
  for_each_row(ny, [&](int j) {
    for (int i = 0; i < nx; ++i) {
      const double x = (i - 0.5 * (nx - 1)) * g.hx(), y = (j - 0.5 * (ny - 1)) * g.hy();
      double u = (c * x + s * y) / g.hx() + 0.5 * (g.nx - 1);
      double v = (c * y - s * x) / g.hy() + 0.5 * (g.ny - 1);
      if (!periodic) {
        u = std::clamp(u, 0.0, g.nx - 1.0);
        v = std::clamp(v, 0.0, g.ny - 1.0);
      }
      result(i, j) =
          cubic_height(h, cubic_weights(u, g.nx, periodic), cubic_weights(v, g.ny, periodic), holes);
    }
  });
  const Grid grid = periodic ? g : make_grid(nx, ny, nx * g.hx(), ny * g.hy());
  return remade_with(holes, grid, std::move(result), {.material = surface.material()});
}

Surface mirrored(const Surface& surface) {
  const Field& h = surface.measured_heights();
  Field result(h.nx(), h.ny());
  for (int j = 0; j < h.ny(); ++j) std::reverse_copy(h.row(j).begin(), h.row(j).end(), result.row(j).begin());
  return remade_with(!surface.complete(), surface.grid(), std::move(result), surface.traits());
}

Surface cropped(const Surface& surface, double i, double j, double nx, double ny) {
  const Grid& g = surface.grid();
  const auto check = [](double first, double count, int all, const char* along) {
    const bool whole = first == std::floor(first) && count == std::floor(count);
    if (!(whole && first >= 0 && count >= 1 && first + count <= all))
      refuse("a crop of " + format_short(count) + " cells from node " + format_short(first) + " along " +
                 along + " exceeds a surface of " + std::to_string(all) + " cells",
             "give whole cells between node 0 and the rim");
  };
  check(i, nx, g.nx, "x");
  check(j, ny, g.ny, "y");
  const int left = static_cast<int>(i), low = static_cast<int>(j);
  const int columns = static_cast<int>(nx), rows = static_cast<int>(ny);
  if (columns == g.nx && rows == g.ny) return surface;
  Field result(columns, rows);
  for (int row = 0; row < rows; ++row) {
    const auto from = surface.measured_heights().row(low + row).subspan(static_cast<std::size_t>(left),
                                                                        static_cast<std::size_t>(columns));
    std::copy(from.begin(), from.end(), result.row(row).begin());
  }
  const Grid grid{columns, rows, columns == g.nx ? g.size_x : columns * g.hx(),
                  rows == g.ny ? g.size_y : rows * g.hy()};
  if (!surface.complete() && known_count(result.values()) == 0)
    refuse("no point of this part of the surface was measured", "give a part with measured points");
  return remade_with(!surface.complete(), grid, std::move(result), {.material = surface.material()});
}

Surface cropped_to(const Surface& surface, double x, double y, double size_x, double size_y) {
  const Grid& g = surface.grid();
  for (const double length : {x, y, size_x, size_y})
    if (!std::isfinite(length))
      refuse("a length of a crop is " + format_short(length) + " m", "give finite lengths");
  return cropped(surface, std::round(x / g.hx()), std::round(y / g.hy()), std::round(size_x / g.hx()),
                 std::round(size_y / g.hy()));
}

}  // namespace asperity

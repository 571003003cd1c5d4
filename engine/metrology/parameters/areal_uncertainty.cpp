// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/parameters/areal_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/core/require.hpp"
#include "engine/core/text.hpp"
#include "engine/metrology/parameters/areal_slopes.hpp"
#include "engine/metrology/roughness.hpp"

namespace asperity {

namespace {

constexpr int tiles_a_side = 4;
constexpr double lengths_a_tile = 10;  // autocorrelation lengths

struct TileValues {
  std::vector<std::optional<double>> Sa, Sq, Ssk, Sku, Sdq, Sdr;
};

// s/√n; empty if a tile has no value.
std::optional<double> standard_uncertainty(const std::vector<std::optional<double>>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const auto& value : values) {
    if (!value) return {};
    mean += *value / n;
  }
  for (const auto& value : values) squares += (*value - mean) * (*value - mean);
  return std::sqrt(squares / (n - 1) / n);
}

// Tile from node (i0, j0); empty if less than half is measured.
std::optional<Surface> tile(const Surface& map, int i0, int j0, int nx, int ny) {
  const Field& z = map.measured_heights();
  Field heights(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) heights(i, j) = z(i0 + i, j0 + j);
  if (2 * known_count(heights.values()) < heights.size()) return {};
  const Grid& grid = map.grid();
  return Surface::with_holes(make_grid(nx, ny, nx * grid.hx(), ny * grid.hy()), std::move(heights));
}

}  // namespace

ArealUncertainty areal_uncertainty(const Surface& map, std::optional<double> Sal) {
  ArealUncertainty result;
  const Grid& grid = map.grid();
  const int nx = grid.nx / tiles_a_side, ny = grid.ny / tiles_a_side;
  const double side = std::min(nx * grid.hx(), ny * grid.hy());
  if (!Sal) {
    result.why_not = "no autocorrelation length Sal says how large independent tiles are";
    return result;
  }
  if (nx < 2 || ny < 2 || side < lengths_a_tile * *Sal) {
    result.why_not = "a sixteenth of the map, " + metres(side) +
                     " wide, is under ten autocorrelation lengths (Sal " + metres(*Sal) +
                     "): measure a larger map";
    return result;
  }
  TileValues values;
  for (int J = 0; J < tiles_a_side; ++J)
    for (int I = 0; I < tiles_a_side; ++I) {
      const auto part = tile(map, I * nx, J * ny, nx, ny);
      if (!part) {
        result.why_not = "of one of sixteen tiles less than half was measured";
        return result;
      }
      const Roughness heights = roughness(*part);
      const ArealSlopes slopes = areal_slopes(*part);
      const bool flat = !(heights.amplitude > 0);
      values.Sa.push_back(heights.Ra);
      values.Sq.push_back(heights.Rq);
      values.Ssk.push_back(flat ? std::nullopt : std::optional(heights.skewness));
      values.Sku.push_back(flat ? std::nullopt : std::optional(heights.kurtosis));
      values.Sdq.push_back(slopes.Sdq);
      values.Sdr.push_back(slopes.Sdr);
    }
  result.Sa = standard_uncertainty(values.Sa);
  result.Sq = standard_uncertainty(values.Sq);
  result.Ssk = standard_uncertainty(values.Ssk);
  result.Sku = standard_uncertainty(values.Sku);
  result.Sdq = standard_uncertainty(values.Sdq);
  result.Sdr = standard_uncertainty(values.Sdr);
  return result;
}

}  // namespace asperity

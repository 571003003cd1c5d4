// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/half_space/solver/contact_level.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/core/parallel.hpp"

namespace asperity {

namespace {
// |q|/2; the wave number q is π/2 over the root of the cell's area.
double stiffness_of_short_waves(const LevelShape& shape) {
  const double wave = std::numbers::pi / 2 / std::sqrt(shape.aspect), of_half_space = wave / 2;
  return shape.multiplier.shares() ? of_half_space / shape.multiplier.share(wave) : of_half_space;
}

double compliance_of_long_waves(const LevelShape& shape) {
  const double longest = std::max(static_cast<double>(shape.nx), shape.ny * shape.aspect);
  return shape.multiplier.shares() ? shape.multiplier.greatest_from(2 * std::numbers::pi / longest)
                                   : longest / std::numbers::pi;
}

// With four, one random scene in 2000 with weak hardening stalled.
int sweeps_under(const PressureLimit& limit) {
  return std::holds_alternative<LinearHardening>(limit) ? 8 : 4;
}

// Even if possible, for further nesting.
int coarser_side(int n, Boundary boundary) {
  if (n < 2 * least_side) return n;
  if (n % 2 == 0) return n / 2;
  if (boundary == Boundary::free) return (n + 1) / 2;
  constexpr int multiple = 4;  // for nesting and fast transforms
  return (n / 2 + multiple - 1) / multiple * multiple;
}

}  // namespace

ContactLevel::ContactLevel(const LevelShape& level_shape, std::span<const double> raw_heights,
                           double height_origin, double height_factor, PressureLimit pressure_limit,
                           double mean)
    : AllNodes(level_shape.nodes()),
      shape(level_shape),
      limit(std::move(pressure_limit)),
      mean_pressure(mean),
      compliance(shape.nx, shape.ny, shape.aspect, shape.boundary, shape.weight, shape.single,
                 shape.multiplier),
      preconditioner(shape.nx, shape.ny, shape.aspect, shape.boundary, shape.weight, sweeps_under(limit),
                     shape.multiplier),
      short_wave_stiffness(stiffness_of_short_waves(shape)),
      greatest_compliance(compliance_of_long_waves(shape)),
      heights_(raw_heights),
      origin_(height_origin),
      factor_(height_factor),
      unit_(mean > 0 && std::isfinite(mean) ? std::ldexp(1.0, std::ilogb(mean)) : 1) {
  compliance.count_pressures_in(unit_);
}

void ContactLevel::unpressed_gap(std::size_t first, std::size_t n, double* g) const {
  for_stretch(0, n, [=, h = heights_.data() + first, origin = origin_, factor = factor_](std::size_t k) {
    g[k] = (origin - h[k]) * factor;
  });
}

void ContactLevel::gap_beside(double mean, std::span<const double> p, std::span<double> g) {
  ++applications;
  const auto nx = static_cast<std::size_t>(shape.nx);
  const auto source = [=](int j, double* row) -> const double* {
    const std::size_t begin = static_cast<std::size_t>(j) * nx;
    for_stretch(0, nx, [=, from = p.data() + begin](std::size_t k) { row[k] = from[k] - mean; });
    return row;
  };
  const auto sink = [=, h = heights_.data(), origin = origin_, factor = factor_](int j, const double* row) {
    const std::size_t begin = static_cast<std::size_t>(j) * nx;
    for_stretch(0, nx, [=, h = h + begin, to = g.data() + begin](std::size_t k) {
      to[k] = row[k] - (h[k] - origin) * factor;
    });
  };
  compliance.apply_in_double(source, sink, g);
}

Between between(double position, int n, Boundary boundary) {
  const double floor = std::floor(position);
  int low = static_cast<int>(floor), high = low + 1;
  if (boundary == Boundary::periodic) return {low % n, high % n, position - floor};
  low = std::min(low, n - 1);
  high = std::min(high, n - 1);
  return {low, high, low == high ? 0.0 : position - floor};
}

std::optional<CoarserGrid> coarser(const LevelShape& fine) {
  const int nx = coarser_side(fine.nx, fine.boundary), ny = coarser_side(fine.ny, fine.boundary);
  if (nx == fine.nx && ny == fine.ny) return {};
  CoarserGrid coarse;
  // A free tile keeps every other node; periodic tiles must close.
  auto pitch = [&](int n, int m) {
    if (n == m) return 1.0;
    return fine.boundary == Boundary::free ? 2.0 : static_cast<double>(n) / m;
  };
  coarse.pitch_x = pitch(fine.nx, nx);
  coarse.pitch_y = pitch(fine.ny, ny);
  coarse.shape = fine;
  coarse.shape.nx = nx;
  coarse.shape.ny = ny;
  coarse.shape.aspect = fine.aspect * (coarse.pitch_y / coarse.pitch_x);
  coarse.shape.multiplier = fine.multiplier.on_coarser(coarse.pitch_x);
  return coarse;
}

Array<double> restrict_to(const LevelShape& fine, const CoarserGrid& coarse, std::span<const double> field) {
  const int nx = coarse.shape.nx, ny = coarse.shape.ny;
  Array<double> result(coarse.shape.nodes());
  parallel_for(ny, [&](std::int64_t j) {
    const Between y = between(static_cast<double>(j) * coarse.pitch_y, fine.ny, fine.boundary);
    const double* low = field.data() + static_cast<std::size_t>(y.low) * static_cast<std::size_t>(fine.nx);
    const double* high = field.data() + static_cast<std::size_t>(y.high) * static_cast<std::size_t>(fine.nx);
    double* out = result.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(nx);
    for (int i = 0; i < nx; ++i) {
      const Between x = between(i * coarse.pitch_x, fine.nx, fine.boundary);
      auto along = [&](const double* row) {
        return x.share == 0 ? row[x.low] : row[x.low] + x.share * (row[x.high] - row[x.low]);
      };
      out[i] = y.share == 0 ? along(low) : along(low) + y.share * (along(high) - along(low));
    }
  });
  return result;
}

void prolong(const CoarserGrid& coarse, std::span<const double> values, double factor, const LevelShape& fine,
             std::span<double> target) {
  const int nx = coarse.shape.nx, ny = coarse.shape.ny;
  Array<Between> columns(static_cast<std::size_t>(fine.nx));
  for (int i = 0; i < fine.nx; ++i)
    columns[static_cast<std::size_t>(i)] = between(i / coarse.pitch_x, nx, fine.boundary);
  parallel_for(fine.ny, [&](std::int64_t j) {
    const Between y = between(static_cast<double>(j) / coarse.pitch_y, ny, fine.boundary);
    const double* low = values.data() + static_cast<std::size_t>(y.low) * static_cast<std::size_t>(nx);
    const double* high = values.data() + static_cast<std::size_t>(y.high) * static_cast<std::size_t>(nx);
    double* out = target.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(fine.nx);
    for (int i = 0; i < fine.nx; ++i) {
      const Between& x = columns[static_cast<std::size_t>(i)];
      const double a = low[x.low] + x.share * (low[x.high] - low[x.low]);
      const double b = high[x.low] + x.share * (high[x.high] - high[x.low]);
      out[i] = factor * (a + y.share * (b - a));
    }
  });
}

}  // namespace asperity

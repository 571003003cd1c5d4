// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/slabs/slab_level.hpp"

namespace asperity {

SlabLevel::SlabLevel(Team& level_team, const LevelShape& level_shape, std::span<const double> heights,
                     double origin, double factor, double level_cap, double level_mean_pressure)
    : team(level_team),
      shape(level_shape),
      slab(level_team.slab(level_shape.nx, level_shape.ny)),
      cap(level_cap),
      mean_pressure(level_mean_pressure),
      short_wave_stiffness(0.25 * std::numbers::pi / std::sqrt(level_shape.aspect)),
      heights_(heights),
      origin_(origin),
      factor_(factor),
      fourier_(level_team.fourier(level_shape.nx, level_shape.ny)) {}

double SlabLevel::first_number(double own) {
  const Array<double> all = team.gather(std::array<double, 1>{own});
  const auto first = std::find_if(all.begin(), all.end(), [](double number) { return !std::isnan(number); });
  return first == all.end() ? own : *first;
}

Array<double> restrict_slabs(Team& team, const Slab& fine, const CoarserGrid& coarse,
                             std::span<const double> field) {
  const int nx = coarse.shape.nx;
  const Slab to = team.slab(nx, coarse.shape.ny);
  struct Part {
    int row;  // on the coarse grid
    double share;
  };
  std::vector<Part> parts;
  Array<double> result;
  Array<Between> columns;
  RowExchange rows(team, fine, [&](int rank) {
    std::vector<int> needed;
    for (int j = 0; j < to.rows_of(rank); ++j) {
      const Between y = between((to.first_of(rank) + j) * coarse.pitch_y, fine.ny, Boundary::periodic);
      needed.push_back(y.low);
      if (rank == to.rank) parts.push_back({j, 1 - y.share});
      if (y.share == 0) continue;
      needed.push_back(y.high);
      if (rank == to.rank) parts.push_back({j, y.share});
    }
    return needed;
  });
  team.work([&] {
    result.resize(to.nodes());
    for (int i = 0; i < nx; ++i) columns.push_back(between(i * coarse.pitch_x, fine.nx, Boundary::periodic));
  });
  team.agree();
  rows.run(
      [&](int j, double* out) {
        std::copy_n(field.data() + static_cast<std::size_t>(j) * fine.width(), fine.width(), out);
      },
      [&](std::size_t k, const double* row) {
        double* const out = result.data() + static_cast<std::size_t>(parts[k].row) * to.width();
        for (std::size_t i = 0; i < columns.size(); ++i) {
          const Between& x = columns[i];
          out[i] +=
              parts[k].share * (row[x.low] + (x.share == 0 ? 0.0 : x.share * (row[x.high] - row[x.low])));
        }
      });
  return result;
}

void prolong_slabs(Team& team, const CoarserGrid& coarse, std::span<const double> values, double factor,
                   const Slab& fine, std::span<double> target) {
  const Slab from = team.slab(coarse.shape.nx, coarse.shape.ny);
  const auto row_below = [&](int j) { return static_cast<int>(std::floor(j / coarse.pitch_y)); };
  RowExchange rows(team, from, [&](int rank) {
    std::vector<int> needed;
    const int first = fine.first_of(rank), last = first + fine.rows_of(rank) - 1;
    if (last < first) return needed;
    for (int j = row_below(first); j <= row_below(last) + 1; ++j) needed.push_back(j % from.ny);
    return needed;
  });
  std::vector<const double*> held;
  Array<Between> columns;
  team.work([&] {
    held.resize(rows.needed());
    for (int i = 0; i < fine.nx; ++i)
      columns.push_back(between(i / coarse.pitch_x, from.nx, Boundary::periodic));
  });
  team.agree();
  rows.run(
      [&](int j, double* out) {
        std::copy_n(values.data() + static_cast<std::size_t>(j) * from.width(), from.width(), out);
      },
      [&](std::size_t k, const double* row) { held[k] = row; });
  for (int j = 0; j < fine.rows(); ++j) {
    const double y = (fine.first() + j) / coarse.pitch_y, share = y - std::floor(y);
    const auto k = static_cast<std::size_t>(row_below(fine.first() + j) - row_below(fine.first()));
    const double *const low = held[k], *const high = held[k + 1];
    double* const out = target.data() + static_cast<std::size_t>(j) * fine.width();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Between& x = columns[i];
      const double a = low[x.low] + x.share * (low[x.high] - low[x.low]);
      const double b = high[x.low] + x.share * (high[x.high] - high[x.low]);
      out[i] = factor * (a + share * (b - a));
    }
  }
}

}  // namespace asperity

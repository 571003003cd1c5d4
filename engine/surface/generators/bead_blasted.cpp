// SPDX-License-Identifier: GPL-3.0-or-later
// Dents use unwrapped coordinates: no special cases at rims.
#include "engine/surface/generators/bead_blasted.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/digest.hpp"
#include "engine/core/require.hpp"
#include "engine/surface/generators/recalled_heights.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "engine/surface/parallel_rows.hpp"

namespace asperity {

namespace {

constexpr double floor_reach = 2.2;  // of r²/a²
constexpr double rim_radius = 1.15, rim_width = 0.2, rim_share = 0.5;
// At 4.3 widths the rim has decayed to 1e-8.
constexpr double rim_reach = rim_radius + 4.3 * rim_width;

void check_pair(const char* key, double low, double high) {
  require_positive(key, low);
  require_positive(key, high);
  if (low > high)
    refuse(quoted(key) + " runs from " + metres(low) + " down to " + metres(high),
           "give the smaller length first");
}

Grid check(const BeadBlastedOptions& o) {
  const Grid grid = make_grid(o.grid.nx, o.grid.ny, o.grid.size_x, o.grid.size_y);
  require_positive("ra", o.ra);
  check_pair("bead", o.bead_low, o.bead_high);
  check_pair("dent", o.dent_low, o.dent_high);
  require_positive("coverage", o.coverage);
  if (o.dent_high > 0.5 * o.bead_low)
    refuse("`dent` allows a radius of " + metres(o.dent_high) + ", and `bead` a bead of radius " +
               metres(0.5 * o.bead_low),
           "give smaller radii as `dent`, or larger diameters as `bead`");
  const double cell = std::max(grid.hx(), grid.hy());
  if (cell > o.dent_low)
    refuse("a cell of " + metres(cell) + " is longer than the radius of the smallest dent, " +
               metres(o.dent_low),
           "give more `cells`");
  if (dent_count(o) > most_dents)
    refuse("the surface would have " + format_short(dent_count(o)) + " dents",
           "at most " + format_short(most_dents) +
               " are made; give a smaller `size` or `coverage`, or larger `dent` radii");
  if (o.fine && !(o.fine->share > 0 && o.fine->share <= 1))
    refuse("`share` of the fine texture is " + format_short(o.fine->share),
           "give a number above 0 and at most 1");
  return grid;
}

struct Dent {
  double x = 0, y = 0;   // m
  double radius = 0;     // m
  double curvature = 0;  // 1/R of the bead, 1/m
};

Dent draw(const Stream& stream, std::uint64_t k, const BeadBlastedOptions& o, const Grid& grid) {
  return {.x = stream.uniform(4 * k) * grid.size_x,
          .y = stream.uniform(4 * k + 1) * grid.size_y,
          .radius = stream.uniform(4 * k + 2, o.dent_low, o.dent_high),
          .curvature = 2 / stream.uniform(4 * k + 3, o.bead_low, o.bead_high)};
}

class Ground {
 public:
  explicit Ground(const Grid& grid) : grid_(grid), heights_(grid.nx, grid.ny) {}

  void strike(const Dent& dent) {
    const double a2 = dent.radius * dent.radius;
    const auto [sum, nodes] = visit(dent, 1, [](double& z, double) { return std::array{z, 1.0}; });
    const double base = sum / nodes - 0.5 * a2 * dent.curvature;
    const double removed = visit(dent, std::sqrt(floor_reach), [&](double& z, double r2) {
      const double floor = base + 0.5 * r2 * dent.curvature;
      const double cut = std::max(z - floor, 0.0);
      z = std::min(z, floor);
      return std::array{cut, 0.0};
    })[0];
    if (removed == 0) return;
    const auto rim = [&](double r2) {
      const double t = (std::sqrt(r2) / dent.radius - rim_radius) / rim_width;
      return elementary::exp(-t * t);
    };
    const double total = visit(dent, rim_reach, [&](double&, double r2) {
      return std::array{rim(r2), 0.0};
    })[0];
    const double crest = rim_share * removed / total;
    visit(dent, rim_reach, [&](double& z, double r2) {
      z += crest * rim(r2);
      return std::array{0.0, 0.0};
    });
  }

  Field take() && { return std::move(heights_); }

 private:
  // Sums act(height, r²) within radii · radius of the centre, by rows, then over the rows.
  template <class Act>
  std::array<double, 2> visit(const Dent& dent, double radii, const Act& act) {
    const double hx = grid_.hx(), hy = grid_.hy(), far = radii * dent.radius;
    const auto first = static_cast<std::int64_t>(std::ceil((dent.y - far) / hy));
    const auto last = static_cast<std::int64_t>(std::floor((dent.y + far) / hy));
    const std::int64_t rows = last - first + 1;
    if (rows <= 0) return {};
    sums_.assign(static_cast<std::size_t>(rows), {});
    const auto one_row = [&](std::int64_t k) {
      const double y = static_cast<double>(first + k) * hy - dent.y;
      const double half = std::sqrt(std::max(far * far - y * y, 0.0));
      const auto from = static_cast<std::int64_t>(std::ceil((dent.x - half) / hx));
      const auto to = static_cast<std::int64_t>(std::floor((dent.x + half) / hx));
      const std::span<double> row = heights_.row(wrapped_index(first + k, grid_.ny));
      std::array<double, 2> sum{};
      int i = wrapped_index(from, grid_.nx);
      for (std::int64_t at = from; at <= to; ++at) {
        const double x = static_cast<double>(at) * hx - dent.x;
        const std::array<double, 2> term = act(row[static_cast<std::size_t>(i)], x * x + y * y);
        sum[0] += term[0];
        sum[1] += term[1];
        if (++i == grid_.nx) i = 0;
      }
      sums_[static_cast<std::size_t>(k)] = sum;
    };
    // Parallel only with enough work and without repeated rows.
    constexpr double worth_sharing = 1 << 16;
    if (rows <= grid_.ny && static_cast<double>(rows) * far / hx > worth_sharing) {
      for_each_row<32>(static_cast<int>(rows), one_row);
    } else {
      for (std::int64_t k = 0; k < rows; ++k) one_row(k);
    }
    std::array<double, 2> total{};
    for (const auto& sum : sums_) {
      total[0] += sum[0];
      total[1] += sum[1];
    }
    return total;
  }

  Grid grid_;
  Field heights_;
  Array<std::array<double, 2>> sums_;
};

struct Scale {
  double average = 0, factor = 1;
};
void apply(Field& heights, const Scale& scale) {
  for (double& z : heights.values()) z = (z - scale.average) * scale.factor;
}

// Mean 0, mean magnitude `ra`.
Scale scale_to(Field& heights, double ra) {
  const double average = mean(heights.values());
  Array<double> magnitudes(heights.size());
  for (std::size_t k = 0; k < heights.size(); ++k) {
    heights[k] -= average;
    magnitudes[k] = std::abs(heights[k]);
  }
  const double now = mean(magnitudes);
  if (now == 0)
    refuse("the dents leave the surface flat on these nodes", "give more `cells` or another `seed`");
  for (double& z : heights.values()) z *= ra / now;
  return {average, ra / now};
}

template <class Use>
auto with_texture(const BeadBlastedOptions& o, const Grid& grid, const Use& use) {
  SelfAffineOptions fine;
  fine.grid = grid;
  fine.hurst = o.fine->hurst;
  fine.ra = o.fine->share * o.ra;
  fine.roll_off = o.fine->roll_off;
  fine.short_wave = o.fine->short_wave;
  fine.seed = Stream(o.seed, "bead_blasted texture").bits(0);
  try {
    return use(fine);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::bad_value) throw;
    throw Error(error.code(), "the fine texture: " + error.sentence(),
                error.hint() + ", or leave the texture out with `fine` = false");
  }
}

Field dented(const BeadBlastedOptions& options, const Grid& grid, Monitor& monitor) {
  const auto dents = static_cast<std::int64_t>(dent_count(options));
  const auto key = [&] {
    Digester digester;
    digester.add(grid.nx).add(grid.ny).add(grid.size_x).add(grid.size_y);
    digester.add(options.bead_low).add(options.bead_high).add(options.dent_low).add(options.dent_high);
    return digester.add(dents).add(static_cast<std::int64_t>(options.seed)).hex();
  };
  const auto strike = [&] {
    const Stream stream(options.seed, "bead_blasted");
    Ground ground(grid);
    Task task(monitor, "bead-blasted surface", dents);
    for (std::int64_t k = 0; k < dents; ++k, task.advance())
      ground.strike(draw(stream, static_cast<std::uint64_t>(k), options, grid));
    return MadeHeights{std::move(ground).take()};
  };
  return recall_or_make("dents of beads", key, monitor, strike).heights;
}

// Scales of the first grid: dents, and dents with texture.
struct Decided {
  std::shared_ptr<const SurfaceRecipe> fine;
  Scale of_ground, of_all;
};

Surface blasted(const BeadBlastedOptions& options, const Decided* decided, Monitor& monitor) {
  const Grid grid = check(options);
  std::optional<Surface> fine;
  if (options.fine)
    fine = decided != nullptr ? (*decided->fine)(grid.nx, grid.ny, monitor)
                              : with_texture(options, grid, [&](const SelfAffineOptions& texture) {
                                  return self_affine_surface(texture, monitor);
                                });

  Field heights = dented(options, grid, monitor);
  Decided now;
  if (decided != nullptr)
    apply(heights, decided->of_ground);
  else
    now.of_ground = scale_to(heights, options.ra);
  if (fine) {
    for (std::size_t k = 0; k < heights.size(); ++k) heights[k] += fine->heights()[k];
    if (decided != nullptr)
      apply(heights, decided->of_all);
    else
      now.of_all = scale_to(heights, options.ra);
  }
  Surface surface(grid, std::move(heights), {.periodic = true});
  if (decided != nullptr) return surface;
  if (fine) now.fine = fine->recipe();
  return surface.made_by([options, now](int nx, int ny, Monitor& watching) {
    BeadBlastedOptions on_other_cells = options;
    on_other_cells.grid.nx = nx;
    on_other_cells.grid.ny = ny;
    return blasted(on_other_cells, &now, watching);
  });
}

}  // namespace

double dent_count(const BeadBlastedOptions& o) {
  const double radius = 0.5 * (o.dent_low + o.dent_high);
  const double count = o.coverage * (o.grid.size_x / radius) * (o.grid.size_y / radius) / std::numbers::pi;
  return std::max(1.0, std::round(count));
}

void require_makeable(const BeadBlastedOptions& options) {
  const Grid grid = check(options);
  if (options.fine)
    with_texture(options, grid, [](const SelfAffineOptions& texture) { require_makeable(texture); });
}

Surface bead_blasted_surface(const BeadBlastedOptions& options, Monitor& monitor) {
  return blasted(options, nullptr, monitor);
}

}  // namespace asperity

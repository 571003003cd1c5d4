// SPDX-License-Identifier: GPL-3.0-or-later
// Mirrored, transposed, shifted (where the boundary permits, and boxes) or exchanged bodies have the same
// mapped pressures: bit for bit for boxes; within 1e-8 of the greatest for half-spaces solved to 1e-12,
// whose sums run in another order. At extreme loads a free tile sinks too deep for 1e-12.
#include <cmath>
#include <functional>

#include "engine/core/arithmetic/random.hpp"
#include "engine/core/error.hpp"
#include "tests/stability/properties/property.hpp"

namespace asperity::stability {

namespace {

constexpr double allowed = 1e-8;  // of the greatest pressure

// Maps node (i, j) of the view to the original.
struct View {
  const char* name;
  int nx, ny;
  double size_x, size_y;
  std::function<std::pair<int, int>(int, int)> node;

  Field of(const Field& field) const {
    Field result(nx, ny);
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const auto [a, b] = node(i, j);
        result(i, j) = field(a, b);
      }
    return result;
  }
};

Scene seen(const Scene& scene, const View& view) {
  const auto* rough = std::get_if<Surface>(&scene.upper);
  return with_heights(scene, make_grid(view.nx, view.ny, view.size_x, view.size_y),
                      view.of(scene.lower.heights()),
                      rough ? turned_over(view.of(turned_over(rough->heights()))) : Field());
}

Scene exchanged(const Scene& scene) {
  Scene result = scene;
  result.lower = std::get<Surface>(scene.upper);
  result.upper = scene.lower;
  return result;
}

Verdict compare(const Trial& trial, const Field& expected, const Field& found, const std::string& what) {
  const double peak = range(expected.values()).max;
  const double most = trial.half_space() ? allowed * peak : 0;
  double worst = 0;
  for (std::size_t k = 0; k < expected.size(); ++k) worst = std::max(worst, std::abs(expected[k] - found[k]));
  if (worst <= most) return {};
  return Broken{what + " bodies give the same pressures", exact(worst / peak) + " of the peak"};
}

Verdict check(const Trial& trial, std::uint64_t salt) {
  const Grid grid = trial.scene.lower.grid();
  const int nx = grid.nx, ny = grid.ny;
  const Stream stream(salt, "shift");
  const int right = static_cast<int>(stream.below(0, static_cast<std::uint64_t>(nx)));
  const int up = static_cast<int>(stream.below(1, static_cast<std::uint64_t>(ny)));
  const View mirrored{"mirrored",  nx,          ny,
                      grid.size_x, grid.size_y, [=](int i, int j) { return std::pair{nx - 1 - i, j}; }};
  const View transposed{"transposed", ny,          nx,
                        grid.size_y,  grid.size_x, [](int i, int j) { return std::pair{j, i}; }};
  const View shifted{"shifted",   nx,
                     ny,          grid.size_x,
                     grid.size_y, [=](int i, int j) { return std::pair{(i + right) % nx, (j + up) % ny}; }};
  const Field pressure = *pressed(trial).field("pressure");
  for (const View* view : {&mirrored, &transposed, &shifted}) {
    if (view == &shifted && trial.half_space() && trial.scene.boundary == Boundary::free) continue;
    const State state = pressed(seen(trial.scene, *view), trial.pressure);
    if (auto broken = compare(trial, view->of(pressure), *state.field("pressure"), view->name)) return broken;
  }
  const auto* rough = std::get_if<Surface>(&trial.scene.upper);
  if (rough && !rough->material()->rigid) {
    const State state = pressed(exchanged(trial.scene), trial.pressure);
    if (auto broken = compare(trial, turned_over(pressure), *state.field("pressure"), "exchanged"))
      return broken;
  }
  return {};
}

}  // namespace

const Family symmetry{"symmetry", {.tolerance = 1e-12, .heaviest = 3}, check, 1000};

}  // namespace asperity::stability

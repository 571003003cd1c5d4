// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/stability/properties/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/contact/bodies/geometry.hpp"
#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "engine/core/constants.hpp"
#include "engine/surface/generators/self_affine.hpp"

namespace asperity::stability {

namespace {

// One stream per scene.
class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t index) : stream_(splitmix64(seed, index), "stability scene") {}
  double uniform(double low, double high) { return stream_.uniform(next_++, low, high); }
  double decades(double low, double high) { return std::pow(10.0, uniform(low, high)); }
  int below(int n) { return static_cast<int>(stream_.below(next_++, static_cast<std::uint64_t>(n))); }
  int between(int low, int high) { return low + below(high - low + 1); }
  bool chance(double share) { return uniform(0, 1) < share; }
  std::uint64_t bits() { return stream_.bits(next_++); }
  double normal() {
    next_ += 2 - next_ % 2;
    return stream_.normal(next_ / 2 - 1);
  }

 private:
  Stream stream_;
  std::uint64_t next_ = 0;
};

Grid draw_grid(Draws& draw, int most, double longest) {
  const int least = std::min(8, most);
  int nx = draw.between(least, most), ny = draw.between(least, most);
  const int shape = draw.below(20);
  if (shape < 4) ny = nx;
  if (shape == 4) nx = draw.between(1, 3);
  if (shape == 5) ny = draw.between(1, 3);
  if (shape > 14) {  // powers of two: other transforms and nested grids
    constexpr std::array sides = {8, 16, 32, 48};
    nx = std::min(most, sides[static_cast<std::size_t>(draw.below(4))]);
    ny = std::min(most, sides[static_cast<std::size_t>(draw.below(4))]);
  }
  const double hx = draw.decades(-9, 2);
  const double aspect = draw.chance(0.6) ? 1 : draw.decades(-longest, longest);
  return make_grid(nx, ny, nx * hx, ny * (hx * aspect));
}

// --- heights, of the order of 1

using Heights = Field (*)(Draws&, const Grid&);

template <class Height>
Field filled(const Grid& grid, Height height) {
  Field z(grid.nx, grid.ny);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) z(i, j) = height(i, j);
  return z;
}

Field self_affine(Draws& draw, const Grid& grid) {
  SelfAffineOptions options;
  options.grid = grid;
  options.hurst = draw.uniform(0.05, 1);
  options.rms_height = 1;
  const double cell = std::max(grid.hx(), grid.hy()), side = std::max(grid.size_x, grid.size_y);
  options.short_wave = std::min(side, draw.uniform(2, 8) * cell);
  if (options.short_wave < 2 * cell) return filled(grid, [&](int, int) { return draw.normal(); });
  options.seed = draw.bits();
  try {
    return self_affine_surface(options).heights();
  } catch (const std::exception&) {  // no wave in the band
    return filled(grid, [&](int, int) { return draw.normal(); });
  }
}

Field white_noise(Draws& draw, const Grid& grid) {
  return filled(grid, [&](int, int) { return draw.normal(); });
}

Field spikes(Draws& draw, const Grid& grid) {
  Field z = self_affine(draw, grid);
  const double height = draw.decades(0, 5) * (draw.chance(0.3) ? -1 : 1);
  for (int n = draw.between(1, 5); n > 0; --n) z(draw.below(grid.nx), draw.below(grid.ny)) += height;
  return z;
}

Field step(Draws& draw, const Grid& grid) {
  const int edge = draw.below(grid.nx);
  const double high = draw.decades(-3, 2), roughness = draw.chance(0.5) ? 0 : draw.decades(-6, 0);
  return filled(grid, [&](int i, int) { return (i < edge ? high : 0.0) + roughness * draw.normal(); });
}

Field terraces(Draws& draw, const Grid& grid) {
  Field z = self_affine(draw, grid);
  const double rise = draw.decades(-1, 0.3);
  for (double& value : z.values()) value = rise * std::floor(value / rise);
  return z;
}

Field few_peaks(Draws& draw, const Grid& grid) {
  Field z(grid.nx, grid.ny);
  const bool equal = draw.chance(0.5);
  for (int n = draw.between(1, 10); n > 0; --n)
    z(draw.below(grid.nx), draw.below(grid.ny)) = equal ? 1 : draw.uniform(0, 1);
  return z;
}

Field flat(Draws& draw, const Grid& grid) {
  const double level = draw.chance(0.5) ? 0 : draw.normal();
  return filled(grid, [&](int, int) { return level; });
}

Field cosine(Draws& draw, const Grid& grid) {
  const int x = draw.between(0, 3), y = draw.between(0, 3);
  return filled(grid, [&](int i, int j) {
    return std::cos(2 * std::numbers::pi * x * i / grid.nx) *
           std::cos(2 * std::numbers::pi * y * j / grid.ny);
  });
}

Field dome(Draws& draw, const Grid& grid) {
  const double x0 = draw.uniform(0, grid.nx), y0 = draw.uniform(0, grid.ny);
  return filled(grid, [&](int i, int j) {
    const double x = (i - x0) / grid.nx, y = (j - y0) / grid.ny;
    return -x * x - y * y;
  });
}

struct Kind {
  const char* name;
  Heights heights;
};
constexpr Kind kinds[] = {
    {"self-affine", self_affine},
    {"self-affine", self_affine},
    {"self-affine", self_affine},
    {"white noise", white_noise},
    {"spikes", spikes},
    {"step", step},
    {"terraces", terraces},
    {"few peaks", few_peaks},
    {"flat", flat},
    {"cosine", cosine},
    {"dome", dome},
};

Field draw_heights(Draws& draw, const Grid& grid, double amplitude, std::string& name) {
  const Kind& kind = kinds[draw.below(static_cast<int>(std::size(kinds)))];
  name += (name.empty() ? "" : " on ") + std::string(kind.name);
  Field z = kind.heights(draw, grid);
  for (double& value : z.values()) value *= amplitude;
  return z;
}

// --- bodies and effects

Material draw_material(Draws& draw) {
  Material material;
  material.young = draw.decades(2, 13);
  material.poisson = draw.chance(0.2) ? 0 : draw.uniform(-0.3, 0.5);
  return material;
}

Surface surface(const Grid& grid, Field heights, const std::optional<Material>& material) {
  SurfaceTraits traits;
  traits.material = material;
  traits.periodic = true;  // no warning about a step at the rim
  return Surface(grid, std::move(heights), std::move(traits));
}

ContactGeometry geometry_of(const Scene& scene) {
  return ContactGeometry(scene, LatticeIsometry(scene.lower.grid().nx, scene.lower.grid().ny));
}

double rms_slope(const Grid& grid, const Field& h) {
  double sum = 0;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      const double x = (h((i + 1) % grid.nx, j) - h(i, j)) / grid.hx();
      const double y = (h(i, (j + 1) % grid.ny) - h(i, j)) / grid.hy();
      sum += x * x + y * y;
    }
  return std::sqrt(sum / static_cast<double>(grid.nodes()));
}

void set_hardness(Scene& scene, double lower, double upper) {
  Material material = *scene.lower.material();
  material.hardness = lower;
  if (!material.rigid) scene.lower = scene.lower.with_material(material);
  if (const auto* rough = std::get_if<Surface>(&scene.upper)) {
    material = *rough->material();
    material.hardness = upper;
    if (!material.rigid) scene.upper = rough->with_material(material);
  }
}

void draw_yield(Draws& draw, Trial& trial, double modulus) {
  Scene& scene = trial.scene;
  PlasticityOptions options;
  const Grid& grid = scene.lower.grid();
  const bool hardens = draw.chance(0.35);
  if (hardens) options.hardening = modulus / grid.hx() * draw.decades(-3, 3);
  const double hardness = trial.pressure * (hardens ? draw.decades(-2, 2) : 1 + draw.decades(-4, 2.5));
  if (draw.chance(0.3)) {
    options.hardness = hardness;
  } else {
    const double other = draw.chance(0.3) ? hardness : hardness * draw.decades(0, 1.5);
    draw.chance(0.5) && trial.rough_pair() ? set_hardness(scene, other, hardness)
                                           : set_hardness(scene, hardness, other);
  }
  scene.effects.set(options);
}

}  // namespace

double Trial::hardness() const {
  if (!scene.effects.find<PlasticityOptions>()) return infinity;
  const auto of = [&](const Material* material) {
    if (material == nullptr || material->rigid) return infinity;
    return scene.effects.find<PlasticityOptions>()->hardness.value_or(material->hardness.value_or(infinity));
  };
  const auto* rough = std::get_if<Surface>(&scene.upper);
  return std::min(of(lower_material(scene.lower)), rough ? of(&*rough->material()) : infinity);
}
bool Trial::hardens() const {
  return scene.effects.find<PlasticityOptions>() &&
         std::isfinite(scene.effects.find<PlasticityOptions>()->hardening);
}
double Trial::cap() const { return hardens() ? infinity : hardness(); }

Trial draw_trial(std::uint64_t seed, std::uint64_t index, const Wanted& wanted) {
  Draws draw(seed, index);
  const Grid grid = draw_grid(draw, wanted.most_cells, wanted.longest);
  const double amplitude = grid.hx() * draw.decades(-5, 0.5);
  std::string names;
  Field lower = draw_heights(draw, grid, amplitude, names);
  Trial trial{Scene{surface(grid, std::move(lower), draw_material(draw)), rigid_material()}, 0, {}};
  Scene& scene = trial.scene;
  if (wanted.pair || draw.chance(0.35)) {
    const double other = draw.chance(0.5) ? amplitude : amplitude * draw.decades(-3, 3);
    Field upper = draw_heights(draw, grid, other, names);
    scene.upper = surface(grid, std::move(upper), draw.chance(0.15) ? rigid_material() : draw_material(draw));
  } else if (draw.chance(0.4)) {
    scene.upper = draw_material(draw);
  }
  trial.heights = names;
  scene.boundary = draw.chance(0.5) ? Boundary::periodic : Boundary::free;
  const bool half_space =
      wanted.model == Wanted::Model::any ? draw.chance(0.75) : wanted.model == Wanted::Model::half_space;
  constexpr std::array tolerances = {1e-4, 1e-6, 1e-6, 1e-8, 1e-10};
  scene.accuracy.tolerance =
      wanted.tolerance.value_or(tolerances[static_cast<std::size_t>(draw.below(tolerances.size()))]);

  const ContactGeometry geometry = geometry_of(scene);
  const double modulus = contact_modulus(geometry, {}, {}, {});
  const double share = draw.chance(0.75)
                           ? draw.decades(-3.5, 0.7)
                           : draw.decades(std::log10(wanted.lightest), std::log10(wanted.heaviest));
  if (half_space) {
    scene.elasticity = HalfSpaceOptions{};
    const double slope = rms_slope(grid, geometry.combined());
    trial.pressure = modulus * (slope > 0 ? slope : amplitude / grid.hx()) * share;
    if (wanted.yields || draw.chance(0.45)) draw_yield(draw, trial, modulus);
  } else {
    const double span = geometry.peak_to_valley();
    BoxOptions box;
    if (!(span > 0) || draw.chance(0.5)) box.stiffness = modulus / amplitude * draw.decades(-2, 2);
    scene.elasticity = box;
    trial.pressure = box.stiffness.value_or(modulus / span) * (span > 0 ? span : amplitude) * share;
    if (wanted.yields || draw.chance(0.45)) {
      draw_yield(draw, trial, modulus);
      // Doubles cannot hold gaps beyond a thousand times the elements' heights.
      scene.effects.find<PlasticityOptions>()->hardening *=
          trial.pressure / (span > 0 ? span : amplitude) / (modulus / grid.hx());
      if (draw.chance(0.4)) scene.elasticity = RigidOptions{};
    }
  }
  return trial;
}

Scene with_heights(const Scene& scene, const Grid& grid, Field lower, Field upper) {
  Scene result = scene;
  result.lower = surface(grid, std::move(lower), scene.lower.material());
  if (const auto* rough = std::get_if<Surface>(&scene.upper))
    result.upper = surface(grid, std::move(upper), rough->material());
  return result;
}

}  // namespace asperity::stability

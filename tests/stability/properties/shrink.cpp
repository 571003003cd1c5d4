// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/core/constants.hpp"
#include "tests/stability/properties/scene.hpp"

namespace asperity::stability {

namespace {

Field upper_heights(const Scene& scene) {
  const auto* rough = std::get_if<Surface>(&scene.upper);
  return rough ? rough->heights() : Field();
}

Field window(const Field& field, int x, int y, int nx, int ny) {
  Field result(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) result(i, j) = field(x + i, y + j);
  return result;
}

// Both bodies, with the same cell size.
Trial cropped(const Trial& trial, int x, int y, int nx, int ny) {
  const Grid& old = trial.scene.lower.grid();
  const Grid grid = make_grid(nx, ny, nx * old.hx(), ny * old.hy());
  const Field& lower = trial.scene.lower.heights();
  const Field upper = upper_heights(trial.scene);
  Trial result = trial;
  result.scene = with_heights(trial.scene, grid, window(lower, x, y, nx, ny),
                              upper.empty() ? Field() : window(upper, old.nx - x - nx, y, nx, ny));
  return result;
}

Trial with_each_height(const Trial& trial, const std::function<double(double)>& change) {
  Field lower = trial.scene.lower.heights(), upper = upper_heights(trial.scene);
  for (Field* field : {&lower, &upper})
    for (double& z : field->values()) z = change(z);
  Trial result = trial;
  result.scene = with_heights(trial.scene, trial.scene.lower.grid(), std::move(lower), std::move(upper));
  return result;
}

bool same(const Trial& a, const Trial& b) { return script(a, "", "") == script(b, "", ""); }

void crop_cells(const Trial& trial, std::vector<Trial>& found) {
  const int nx = trial.scene.lower.grid().nx, ny = trial.scene.lower.grid().ny;
  for (const int x : {nx / 2, nx / 4, 1})
    if (x > 0 && nx > x) {
      found.push_back(cropped(trial, x, 0, nx - x, ny));
      found.push_back(cropped(trial, 0, 0, nx - x, ny));
    }
  for (const int y : {ny / 2, ny / 4, 1})
    if (y > 0 && ny > y) {
      found.push_back(cropped(trial, 0, y, nx, ny - y));
      found.push_back(cropped(trial, 0, 0, nx, ny - y));
    }
}

void fewer_bodies_and_effects(const Trial& trial, std::vector<Trial>& found) {
  const auto add = [&](auto change) {
    Trial next = trial;
    change(next.scene);
    found.push_back(std::move(next));
  };
  add([](Scene& s) { s.upper = rigid_material(); });
  add([](Scene& s) { s.effects.remove<PlasticityOptions>(); });
  if (trial.scene.effects.find<PlasticityOptions>()) {
    add([](Scene& s) { s.effects.find<PlasticityOptions>()->hardening = infinity; });
    add([&](Scene& s) {
      if (std::isfinite(trial.hardness())) s.effects.find<PlasticityOptions>()->hardness = trial.hardness();
    });
  }
}

// Rounds to at most `bits` bits of `greatest`.
double rounded(double value, double greatest, int bits) {
  const double unit = std::ldexp(1.0, std::ilogb(greatest) - bits + 1);
  return unit * std::round(value / unit);
}

void plainer_heights(const Trial& trial, std::vector<Trial>& found) {
  const Range lower = trial.scene.lower.height_range();
  const Field upper = upper_heights(trial.scene);
  const double greatest = std::max({std::abs(lower.min), std::abs(lower.max),
                                    upper.empty() ? 0.0 : std::abs(range(upper.values()).min),
                                    upper.empty() ? 0.0 : std::abs(range(upper.values()).max)});
  if (!(greatest > 0)) return;
  found.push_back(with_each_height(trial, [](double) { return 0.0; }));
  for (const int bits : {1, 3, 6, 12, 24})
    found.push_back(with_each_height(trial, [=](double z) { return rounded(z, greatest, bits); }));
  const double middle = 0.5 * (lower.min + lower.max);
  found.push_back(with_each_height(trial, [=](double z) { return z < middle ? lower.min : z; }));
}

// Changes units, then reduces digits.
void rounder_numbers(const Trial& trial, std::vector<Trial>& found) {
  const Grid& grid = trial.scene.lower.grid();
  const auto rescaled = [&](double length, double stress) {
    Trial next = with_each_height(trial, [=](double z) { return z * length; });
    Scene& s = next.scene;
    s = with_heights(s, make_grid(grid.nx, grid.ny, grid.size_x * length, grid.size_y * length),
                     s.lower.heights(), upper_heights(s));
    next.pressure *= stress;
    const auto material = [&](Material m) {
      if (m.young) *m.young *= stress;
      if (m.hardness) *m.hardness *= stress;
      return m;
    };
    s.lower = s.lower.with_material(material(*s.lower.material()));
    if (const auto* rough = std::get_if<Surface>(&s.upper))
      s.upper = rough->with_material(material(*rough->material()));
    else
      s.upper = material(std::get<Material>(s.upper));
    if (auto* box = s.elasticity.find<BoxOptions>(); box && box->stiffness)
      *box->stiffness *= stress / length;
    if (s.effects.find<PlasticityOptions>()) {
      if (s.effects.find<PlasticityOptions>()->hardness)
        *s.effects.find<PlasticityOptions>()->hardness *= stress;
      s.effects.find<PlasticityOptions>()->hardening *= stress / length;
    }
    return next;
  };
  if (grid.hx() != 1) found.push_back(rescaled(1 / grid.hx(), 1));
  if (const Material& m = *trial.scene.lower.material(); m.young && *m.young != 1)
    found.push_back(rescaled(1, 1 / *m.young));
  const auto add = [&](auto change) {
    Trial next = trial;
    change(next);
    found.push_back(std::move(next));
  };
  add([](Trial& t) {
    Material m = *t.scene.lower.material();
    if (m.poisson) m.poisson = 0;
    t.scene.lower = t.scene.lower.with_material(m);
  });
  add([&](Trial& t) {
    t.scene = with_heights(t.scene, make_grid(grid.nx, grid.ny, grid.nx, grid.ny), t.scene.lower.heights(),
                           upper_heights(t.scene));
  });
  for (const int bits : {1, 4, 10}) {
    add([=](Trial& t) { t.pressure = rounded(t.pressure, t.pressure, bits); });
    add([=](Trial& t) {
      auto* plasticity = t.scene.effects.find<PlasticityOptions>();
      if (plasticity && plasticity->hardness)
        plasticity->hardness = rounded(*plasticity->hardness, *plasticity->hardness, bits);
    });
    add([=](Trial& t) {
      auto* plasticity = t.scene.effects.find<PlasticityOptions>();
      if (plasticity && std::isfinite(plasticity->hardening))
        plasticity->hardening = rounded(plasticity->hardening, plasticity->hardening, bits);
    });
  }
}

}  // namespace

std::vector<Trial> simpler(const Trial& trial) {
  std::vector<Trial> found;
  crop_cells(trial, found);
  fewer_bodies_and_effects(trial, found);
  plainer_heights(trial, found);
  rounder_numbers(trial, found);
  std::erase_if(found, [&](const Trial& next) { return same(next, trial) || next.pressure >= next.cap(); });
  return found;
}

}  // namespace asperity::stability

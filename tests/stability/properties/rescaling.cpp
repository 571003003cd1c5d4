// SPDX-License-Identifier: GPL-3.0-or-later
// Powers of two in lengths, moduli and loads change only exponents.
#include <cmath>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/core/arithmetic/random.hpp"
#include "tests/stability/properties/property.hpp"

namespace asperity::stability {

namespace {

Material rescaled(Material material, double stress) {
  if (material.young) *material.young *= stress;
  if (material.hardness) *material.hardness *= stress;
  return material;
}

Field rescaled(Field heights, double length) {
  for (double& z : heights.values()) z *= length;
  return heights;
}

Scene rescaled(const Scene& scene, double length, double stress) {
  const Grid& old = scene.lower.grid();
  const auto* rough = std::get_if<Surface>(&scene.upper);
  Scene result = with_heights(scene, make_grid(old.nx, old.ny, length * old.size_x, length * old.size_y),
                              rescaled(scene.lower.heights(), length),
                              rough ? rescaled(rough->heights(), length) : Field());
  result.lower = result.lower.with_material(rescaled(*scene.lower.material(), stress));
  if (rough)
    result.upper = std::get<Surface>(result.upper).with_material(rescaled(*rough->material(), stress));
  else
    result.upper = rescaled(std::get<Material>(scene.upper), stress);
  if (auto* box = result.elasticity.find<BoxOptions>(); box && box->stiffness)
    *box->stiffness *= stress / length;
  if (result.effects.find<PlasticityOptions>()) {
    if (result.effects.find<PlasticityOptions>()->hardness)
      *result.effects.find<PlasticityOptions>()->hardness *= stress;
    result.effects.find<PlasticityOptions>()->hardening *= stress / length;
  }
  return result;
}

struct Scalar {
  const char* name;
  double (*value)(const State&);
  int lengths, stresses;  // exponents of the scaling
};
const Scalar scalars[] = {
    {"load", [](const State& s) { return s.load(); }, 2, 1},
    {"approach", [](const State& s) { return s.approach(); }, 1, 0},
    {"separation", [](const State& s) { return s.separation(); }, 1, 0},
    {"flatten", [](const State& s) { return s.flatten(); }, 0, 0},
    {"area", [](const State& s) { return s.area(); }, 2, 0},
    {"peak_pressure", [](const State& s) { return s.peak_pressure(); }, 0, 1},
    {"mean_gap", [](const State& s) { return s.mean_gap(); }, 1, 0},
    {"stiffness", [](const State& s) { return s.stiffness(); }, -1, 1},
    {"energy", [](const State& s) { return s.energy(); }, 3, 1},
    {"residual", [](const State& s) { return s.residual(); }, 0, 0},
    {"iterations", [](const State& s) { return static_cast<double>(s.iterations()); }, 0, 0},
};

Verdict check(const Trial& trial, std::uint64_t salt) {
  const Stream stream(salt, "powers of two");
  const int length = static_cast<int>(stream.below(0, 81)) - 40,
            stress = static_cast<int>(stream.below(1, 81)) - 40;
  const auto scale = [&](double value, int lengths, int stresses) {
    return std::ldexp(value, lengths * length + stresses * stress);
  };
  const State one = pressed(trial);
  const State two = pressed(rescaled(trial.scene, std::ldexp(1, length), std::ldexp(1, stress)),
                            scale(trial.pressure, 0, 1));
  const std::string units =
      " with lengths by 2^" + std::to_string(length) + ", stresses by 2^" + std::to_string(stress);
  for (const auto& [name, lengths, stresses] :
       {std::tuple{"pressure", 0, 1}, {"gap", 1, 0}, {"displacement", 1, 0}, {"plastic", 1, 0}}) {
    if (std::string(name) == "plastic" && !trial.scene.effects.find<PlasticityOptions>()) continue;
    const auto a = one.field(name), b = two.field(name);
    for (std::size_t k = 0; k < a->size(); ++k)
      if (scale((*a)[k], lengths, stresses) != (*b)[k])
        return Broken{"powers of two change no bit of the field " + std::string(name),
                      exact((*a)[k]) + " became " + exact(scale((*b)[k], -lengths, -stresses)) + units};
  }
  for (const Scalar& scalar : scalars) {
    const double a = scalar.value(one), b = scalar.value(two);
    if (scale(a, scalar.lengths, scalar.stresses) != b)
      return Broken{"powers of two change no bit of " + std::string(scalar.name),
                    exact(a) + " became " + exact(scale(b, -scalar.lengths, -scalar.stresses)) + units};
  }
  return {};
}

}  // namespace

const Family rescaling{"rescaling", {}, check, 1000};

}  // namespace asperity::stability

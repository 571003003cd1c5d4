// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <charconv>
#include <cmath>

#include "engine/contact/effects/plasticity.hpp"
#include "engine/contact/elasticity/box/box_plan.hpp"
#include "tests/stability/properties/scene.hpp"

namespace asperity::stability {

std::string exact(double value) {
  if (std::isinf(value)) return value > 0 ? "math.huge" : "-math.huge";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

namespace {

std::string material_text(const Material& material) {
  if (material.rigid) return "lab.rigid";
  std::string text = "lab.material{";
  const char* comma = " ";
  const auto add = [&](const char* key, const std::optional<double>& value) {
    if (!value) return;
    text += comma + std::string(key) + "=" + exact(*value);
    comma = ", ";
  };
  add("young", material.young);
  add("poisson", material.poisson);
  add("hardness", material.hardness);
  return text + " }";
}

std::string surface_text(const Surface& surface) {
  const Grid& grid = surface.grid();
  std::string text = "lab.surface.from_table{ size={ " + exact(grid.size_x) + ", " + exact(grid.size_y) +
                     " }, material=" + material_text(*surface.material()) + ", heights={\n";
  for (int j = 0; j < grid.ny; ++j) {
    text += "  { ";
    for (int i = 0; i < grid.nx; ++i) text += (i > 0 ? ", " : "") + exact(surface.heights()(i, j));
    text += " },\n";
  }
  return text + "} }";
}

std::string effects_text(const Scene& scene) {
  std::string text = "effects={ elasticity=";
  const auto* box = scene.elasticity.find<BoxOptions>();
  if (scene.elasticity.is<RigidOptions>())
    text += "\"rigid\"";
  else if (box == nullptr)
    text += "\"half_space\"";
  else if (box->stiffness)
    text += "{ model=\"box\", stiffness=" + exact(*box->stiffness) + " }";
  else
    text += "\"box\"";
  if (const auto* yield = scene.effects.find<PlasticityOptions>()) {
    text += ", plasticity={ hardening=" + exact(yield->hardening);
    if (yield->hardness) text += ", hardness=" + exact(*yield->hardness);
    text += " }";
  }
  return text + " }";
}

}  // namespace

std::string script(const Trial& trial, const std::string& comment, const std::string& lines) {
  const Scene& scene = trial.scene;
  std::string text = "local lab = require \"asperity\"\n";
  if (!comment.empty()) text = "-- " + comment + "\n" + text;
  text += "local lower = " + surface_text(scene.lower) + "\n";
  const auto* rough = std::get_if<Surface>(&scene.upper);
  text += "local upper = " + (rough ? surface_text(*rough) : material_text(std::get<Material>(scene.upper))) +
          "\n";
  text += "local c = lab.contact{ lower=lower, upper=upper, boundary=\"" + std::string(name(scene.boundary)) +
          "\",\n  " + effects_text(scene) + ", accuracy={ tolerance=" + exact(scene.accuracy.tolerance) +
          " } }\n";
  text += "local st = c:press{ pressure=" + exact(trial.pressure) + " }\nprint(st)\n";
  return text + lines;
}

}  // namespace asperity::stability

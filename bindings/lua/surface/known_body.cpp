// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/surface/known_body.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>
#include <utility>

#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/surface/surface.hpp"
#include "engine/core/arithmetic/elementary_functions.hpp"
#include "engine/core/error.hpp"

namespace asperity::lua {

namespace {

// Methods of a surface that preserve its grid.
constexpr std::array<std::string_view, 11> keeps_grid = {"scaled", "shifted",  "mirrored", "plus",
                                                         "minus",  "levelled", "filtered", "cut",
                                                         "with",   "masked",   "filled"};

// Reads `cells` and `size`; ignores other keys.
std::optional<Grid> grid_in(const Argument& table) {
  GridKeys keys;
  Problems problems;
  bool cells = false, size = false;
  const std::vector<Option<GridKeys>> options = {cells_key(), size_key()};
  for (const Option<GridKeys>& option : options)
    with_key(table, option.info.name, [&](const Argument& value) {
      if (value.is_nil() || value.is_unknown()) return;
      option.read(value, option.info, keys, problems);
      (option.info.name == "cells" ? cells : size) = true;
    });
  if (!cells || !size || !problems.empty()) return {};
  try {
    return keys.make();
  } catch (const Error&) {
    return {};  // the call reports the error
  }
}

}  // namespace

std::shared_ptr<const KnownBody> known_body(const Argument& value) {
  const Object* object = value.as_any_object();
  if (object == nullptr || object->type != &class_of<Surface>()) return nullptr;
  if (object->pointer == nullptr) return object->known;
  const auto& surface = *static_cast<const Surface*>(object->pointer.get());
  return std::make_shared<const KnownBody>(KnownBody{surface.material(), surface.grid()});
}

std::shared_ptr<const KnownBody> known_result(const Call& call, const Function& function) {
  const Argument self(call.L, 1);
  const bool is_method = call.function_name().starts_with("surface:");
  KnownBody result;
  if (is_method) {
    const auto before = known_body(self);
    if (before == nullptr) return nullptr;
    result = *before;
    if (std::find(keeps_grid.begin(), keeps_grid.end(), function.name) == keeps_grid.end())
      result.grid.reset();
  } else if (!call.function_name().starts_with("lab.surface.")) {
    return nullptr;
  }
  if (function.options == nullptr) return std::make_shared<const KnownBody>(std::move(result));
  const int k = static_cast<int>(function.parameters.size()) + 1;
  const Argument table = call.argument(k);
  if (k > call.count() || table.is_nil()) return std::make_shared<const KnownBody>(std::move(result));
  if (!table.is_table()) return nullptr;
  bool known = true;
  with_key(table, "material", [&](const Argument& value) {
    if (value.is_nil()) return;
    if (const auto* material = value.as<Material>())
      result.material = *material;
    else
      known = false;
  });
  if (!known) return nullptr;
  if (!is_method) result.grid = grid_in(table);
  return std::make_shared<const KnownBody>(std::move(result));
}

Surface stand_in(const KnownBody& body) {
  constexpr int cells = 16;
  const double size_x = body.grid ? body.grid->size_x : 1e-3, size_y = body.grid ? body.grid->size_y : 1e-3;
  Field heights(cells, cells);
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      heights(i, j) = 1e-3 * std::min(size_x, size_y) * elementary::cos(2 * std::numbers::pi * i / cells) *
                      elementary::cos(2 * std::numbers::pi * j / cells);
  SurfaceTraits traits;
  traits.material = body.material;
  traits.periodic = true;
  return Surface(make_grid(cells, cells, size_x, size_y), std::move(heights), std::move(traits));
}

}  // namespace asperity::lua

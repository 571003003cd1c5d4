// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/elasticity/list.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

// NAME_model() is defined in the model's folder.
// clang-format off
#define ASPERITY_ELASTIC_MODELS(model) \
  model(half_space) \
  model(box)        \
  model(rigid)      \
  model(layer)      \
  /* end of the list */
// clang-format on

namespace asperity {

#define ASPERITY_DECLARED(name) const ElasticModel& name##_model();
ASPERITY_ELASTIC_MODELS(ASPERITY_DECLARED)
#undef ASPERITY_DECLARED

std::span<const ElasticModel* const> elastic_models() {
#define ASPERITY_LISTED(name) &name##_model(),
  static const std::vector<const ElasticModel*> models{ASPERITY_ELASTIC_MODELS(ASPERITY_LISTED)};
#undef ASPERITY_LISTED
  return models;
}

const ElasticModel& require_elastic_model(std::string_view name) {
  const auto all = elastic_models();
  if (const auto known = std::ranges::find(all, name, &ElasticModel::name); known != all.end())
    return **known;
  std::vector<std::string> names;
  for (const ElasticModel* model : all) names.emplace_back(model->name);
  throw Error(ErrorCode::unknown_name,
              "there is no model of elasticity " + quoted(name) + did_you_mean(name, names),
              "known are " + joined(names, " and "));
}

Elasticity::Elasticity() : Elasticity(BoxOptions{}) {}

}  // namespace asperity

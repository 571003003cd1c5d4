// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/contact/scene/elastic_model.hpp"

#include <algorithm>
#include <array>

#include "engine/contact/elasticity/box/box_plan.hpp"
#include "engine/contact/elasticity/half_space/half_space_plan.hpp"
#include "engine/contact/elasticity/layer/elastic_layer.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

std::span<const ElasticModel* const> elastic_models() {
  static const std::array models{&HalfSpaceOptions::model(), &BoxOptions::model(), &RigidOptions::model(),
                                 &LayerOptions::model()};
  return models;
}

const ElasticModel& require_elastic_model(std::string_view name) {
  const auto all = elastic_models();
  if (const auto known = std::ranges::find(all, name, &ElasticModel::name); known != all.end())
    return **known;
  std::vector<std::string> names;
  for (const ElasticModel* model : all) names.emplace_back(model->name);
  refuse_name("there is no model of elasticity " + quoted(name) + did_you_mean(name, names),
              "known are " + joined(names, " and "));
}

Elasticity::Elasticity() : Elasticity(BoxOptions{}) {}

}  // namespace asperity

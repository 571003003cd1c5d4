// SPDX-License-Identifier: GPL-3.0-or-later
// Every model of elasticity that a scene can name.
#pragma once

#include <span>
#include <string_view>

#include "engine/contact/scene/elastic_model.hpp"

namespace asperity {

// In the order of the documents.
std::span<const ElasticModel* const> elastic_models();

// Throws Error{unknown_name} with the nearest known name.
const ElasticModel& require_elastic_model(std::string_view name);

}  // namespace asperity

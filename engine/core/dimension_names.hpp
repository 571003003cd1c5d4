// SPDX-License-Identifier: GPL-3.0-or-later
// What the dimensions of quantities are called, "length", "energy per area", for those who choose one by
// name.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/quantity.hpp"

namespace asperity {

// The dimension of that name, as describe() gives it without its article.
std::optional<Dimension> dimension_named(std::string_view name);
std::vector<std::string> dimension_names();

}  // namespace asperity

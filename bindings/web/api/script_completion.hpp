// SPDX-License-Identifier: GPL-3.0-or-later
// Completion for the page, whose places in the text are counted as a browser counts.
#pragma once

#include <cstddef>
#include <string>

#include "engine/core/files/json.hpp"

namespace asperity::web {

// {from, candidates: [{text, kind, detail, help}]}.
Json completion_of(const std::string& text, std::size_t unit);

}  // namespace asperity::web

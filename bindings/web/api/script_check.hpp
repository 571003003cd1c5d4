// SPDX-License-Identifier: GPL-3.0-or-later
// `asperity check` for the page: a dry run in a confined process, and what it found as marks in the text.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/files/json.hpp"

namespace asperity::web {

// {marks: [{line, severity, message}], checked_to?, knobs?}; `knobs`, as in a manifest, are those that the
// script made as far as it could be followed. `scratch`: a folder in which one for this is made.
Json check_script(const std::string& script, const std::filesystem::path& scratch,
                  const std::vector<std::string>& barriers);

}  // namespace asperity::web

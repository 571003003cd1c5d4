// SPDX-License-Identifier: GPL-3.0-or-later
// Keys that describe a table in a file, for lab.table.read and lab.protocol.read.
#pragma once

#include <vector>

#include "bindings/lua/registry/options.hpp"
#include "engine/statistics/table_form.hpp"

namespace asperity::lua {

// For structs that extend TableForm.
const std::vector<Option<TableForm>>& table_form_keys();

void read_texts(const Argument& value, const OptionInfo& info, std::vector<std::string>& texts,
                Problems& problems);

}  // namespace asperity::lua

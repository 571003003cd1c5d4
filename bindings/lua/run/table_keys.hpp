// SPDX-License-Identifier: GPL-3.0-or-later
// The keys by which a script says of a table in a file what the file does not: of lab.table.read and of
// lab.protocol.read alike.
#pragma once

#include <vector>

#include "bindings/lua/registry/options.hpp"
#include "engine/statistics/table_form.hpp"

namespace asperity::lua {

// For a struct that extends TableForm.
const std::vector<Option<TableForm>>& table_form_keys();

// Lists of texts: names of columns.
void read_texts(const Argument& value, const OptionInfo& info, std::vector<std::string>& texts,
                Problems& problems);

}  // namespace asperity::lua

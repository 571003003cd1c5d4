// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/option_row.hpp"

#include <cmath>

#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

void check_options(std::span<const OptionRow> rows, const std::any& options, const std::string& of) {
  for (const OptionRow& row : rows) {
    if (!row.words.empty()) continue;
    const std::optional<double> value = row.get(options);
    if (!value || row.range.contains(*value)) continue;
    const std::string unit = si_unit(row.dimension);
    throw Error(
        ErrorCode::bad_value,
        quoted(row.name) + " of " + of + " is " + format_short(*value) + (unit.empty() ? "" : " " + unit),
        "give " + row.range.wanted(row.dimension, std::isinf(*value)));
  }
}

}  // namespace asperity

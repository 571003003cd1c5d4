// SPDX-License-Identifier: GPL-3.0-or-later
// Units of length in instruments' spelling: "um", "\xB5m" of old code pages, "Micrometer".
#pragma once

#include <optional>
#include <string_view>

namespace asperity {

// Metres per unit at the end of a text, such as "Lateral um" or "Height (nm)"; none if unknown.
std::optional<double> length_unit(std::string_view text);

}  // namespace asperity

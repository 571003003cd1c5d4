// SPDX-License-Identifier: GPL-3.0-or-later
// Units of length as the files of instruments spell them: "um", "\xB5m" of old code pages, "Micrometer".
#pragma once

#include <optional>
#include <string_view>

namespace asperity {

// Metres in the unit that ends a text ("Lateral um", "Raw Micrometers", "Height (nm)"); none if it is no unit
// of length.
std::optional<double> length_unit(std::string_view text);

}  // namespace asperity

// SPDX-License-Identifier: GPL-3.0-or-later
// Recognises unsupported files of instruments and office programs, so that an error can name the format and
// its export. By content; by extension only for binary formats without a mark.
#pragma once

#include <optional>
#include <string>

#include "engine/core/files/source_file.hpp"

namespace asperity {

// read.cpp reads such a text if it holds a table.
inline constexpr const char* utf16_text = "UTF-16 text";

struct ForeignFormat {
  std::string what;  // "an Excel workbook (.xlsx)"
  std::string cure;  // "save the sheet as CSV (UTF-8)"
};

// Throws only for a stop or lack of memory. O(1), plus the zip directory.
std::optional<ForeignFormat> foreign_format(const SourceFile& file);

}  // namespace asperity

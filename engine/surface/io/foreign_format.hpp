// SPDX-License-Identifier: GPL-3.0-or-later
// Files that instruments and offices write and that are not read here: known so that an error can say what a
// file is and how its heights get into one that is read. Known by content; by extension only where the format
// has no mark of its own, and then only for files that are no text.
#pragma once

#include <optional>
#include <string>

#include "engine/core/files/source_file.hpp"

namespace asperity {

// What a text in UTF-16 is called: read.cpp reads it where it holds a table.
inline constexpr const char* utf16_text = "UTF-16 text";

struct ForeignFormat {
  std::string what;  // "an Excel workbook (.xlsx)"
  std::string cure;  // "save the sheet as CSV (UTF-8)"
};

// Never throws but for a stop or lack of memory. O(1), and the directory of a zip archive.
std::optional<ForeignFormat> foreign_format(const SourceFile& file);

}  // namespace asperity

// SPDX-License-Identifier: GPL-3.0-or-later
// Recognises unsupported files of instruments and office programs by content; binary formats without a mark
// by extension.
#pragma once

#include <optional>
#include <string>

#include "engine/core/files/source_file.hpp"

namespace asperity {

struct ForeignFormat {
  std::string what;  // "an Excel workbook (.xlsx)"
  std::string cure;  // "save the sheet as CSV (UTF-8)"
};

// Throws only for a stop or lack of memory. O(1), plus the zip directory.
std::optional<ForeignFormat> foreign_format(const SourceFile& file);

}  // namespace asperity

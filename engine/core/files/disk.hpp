// SPDX-License-Identifier: GPL-3.0-or-later
// Writing whole, and waiting for the disk. A file that was written and renamed survives a kill at once, a
// power cut only when the disk has its content, and the folder its name.
#pragma once

#include <filesystem>
#include <string_view>

namespace asperity {

// All of the bytes into an open file, socket or pipe: a call of the system may take fewer than asked. Returns
// 0 or the error number.
int write_all(int descriptor, std::string_view bytes);

// Until the disk has what was written to this file, or the names in this folder. Milliseconds. Throws
// Error{bad_file} where it cannot be opened or the disk fails.
void wait_for_disk(const std::filesystem::path& file_or_folder);

}  // namespace asperity

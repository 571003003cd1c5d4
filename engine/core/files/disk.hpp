// SPDX-License-Identifier: GPL-3.0-or-later
// Writing in one piece, waiting for the disk, and what the system's refusals say: one sentence with the
// file's name and the reason ("no space left on device"). A file that was written and renamed
// (core/files/atomic_file.hpp) survives a kill at once, a power cut only when the disk has its content, and
// the folder its name.
#pragma once

#include <filesystem>
#include <string_view>

namespace asperity {

// "cannot write `path`: <reason>", for the error number `reason` of a system call.
[[noreturn]] void throw_file_error(std::string_view action, const std::filesystem::path& path, int reason);

// All of the bytes into an open file, socket or pipe: a call of the system may take fewer than asked. Returns
// 0 or the error number.
int write_all(int descriptor, std::string_view bytes);

// Appends to an open file in one piece; what could not be written whole is cut off again, so that
// the file ends with a whole line. Throws Error{bad_file} naming `path`.
void append_whole(int descriptor, std::string_view content, const std::filesystem::path& path);

// Appends in one piece to a file that exists; returns false if it does not, is a link or has another name (a
// hard link). Throws as append_whole.
bool append_to_existing(const std::filesystem::path& path, std::string_view content);

// Until the disk has what was written to this file, or the names in this folder. Milliseconds. Throws
// Error{bad_file} where it cannot be opened or the disk fails.
void wait_for_disk(const std::filesystem::path& file_or_folder);

}  // namespace asperity

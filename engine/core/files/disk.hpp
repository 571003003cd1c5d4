// SPDX-License-Identifier: GPL-3.0-or-later
// Complete writes, waiting for the disk, and system errors as sentences. A file survives a kill at once, a
// power cut only after the disk has its content and the folder's names.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace asperity {

// "cannot write `path`: no space left on device"; `reason` is an errno value.
[[noreturn]] void throw_file_error(std::string_view action, const std::filesystem::path& path, int reason);

struct ScopedFile {
  explicit ScopedFile(int descriptor) : number(descriptor) {}
  ~ScopedFile();
  ScopedFile(const ScopedFile&) = delete;
  ScopedFile& operator=(const ScopedFile&) = delete;
  const int number;
};

// 16 hexadecimal digits.
std::string random_name();

// Repeats partial writes. Returns 0 or the error number.
int write_all(int descriptor, std::string_view bytes);

// Appends all bytes or restores the old length. Throws Error{bad_file}.
void append_whole(int descriptor, std::string_view content, const std::filesystem::path& path);

// False if the file is missing, a link, or has several hard links. Throws as append_whole.
bool append_to_existing(const std::filesystem::path& path, std::string_view content);

// For a file's content or a folder's names; milliseconds. Throws Error{bad_file}.
void wait_for_disk(const std::filesystem::path& file_or_folder);

}  // namespace asperity

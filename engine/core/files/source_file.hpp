// SPDX-License-Identifier: GPL-3.0-or-later
// A measured file, read once into counted memory; its size bounds all allocations.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

class SourceFile {
 public:
  // Throws Error{bad_file} if missing, unreadable, empty or no plain file, Error{out_of_memory} if too large.
  SourceFile(std::string path, Monitor& monitor);
  // Copies bytes; throws Error{bad_file} if empty.
  SourceFile(std::string name, std::string_view bytes);
  // Takes over bytes; throws Error{bad_file} if empty.
  SourceFile(std::string name, Array<char> bytes, std::string extension);

  const std::string& path() const { return path_; }
  // Lower case, without the dot: "x3p"; may be empty.
  const std::string& extension() const { return extension_; }
  std::string_view bytes() const { return {bytes_.data(), bytes_.size()}; }
  // Without a UTF-8 byte-order mark; UTF-16 as UTF-8. Not thread-safe.
  std::string_view text() const;
  // UTF-16, or no zero in the first few thousand bytes.
  bool looks_like_text() const;

 private:
  void refuse_empty() const;
  std::string path_;
  std::string extension_;
  Array<char> bytes_;
  mutable std::string decoded_;  // UTF-16 as UTF-8
};

// Scripts and run files; empty, a pipe or a device, too. Throws Error{bad_file}, Error{out_of_memory}.
std::string text_of_file(const std::string& path);
// Throws Error{out_of_memory} beyond the memory limit or, without a limit, a quarter of the machine's memory.
void require_room_for(const std::string& path, std::uintmax_t bytes);

// Lower case, without the dot.
std::string file_extension(const std::string& path);
// "\"path\"".
std::string file_name(const std::string& path);
// Throws Error{bad_file}: file name, `finding`, hint.
[[noreturn]] void refuse_file(const SourceFile& file, const std::string& finding,
                              const std::string& hint = {});

}  // namespace asperity

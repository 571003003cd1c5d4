// SPDX-License-Identifier: GPL-3.0-or-later
// Files written aside and renamed: a reader sees the old file or the whole new one, never a torn one.
// Errors of the system come back as one sentence with the file's name and the reason ("no space left
// on device"). Does not wait for the disk unless asked to: a power cut may lose the last moments, a kill does
// not. Names aside are those of core/files/part_file.hpp.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace asperity {

// A name beside `target` that is written first and renamed by commit(); removed if never committed.
// For writers that need a file name. Not thread-safe; two objects of one target do not disturb
// each other, the last commit wins.
class AsideFile {
 public:
  // Throws Error{bad_file} for a device or a pipe, in whose place the rename would put a file.
  explicit AsideFile(std::filesystem::path target);
  ~AsideFile();
  AsideFile(const AsideFile&) = delete;
  AsideFile& operator=(const AsideFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  // Throws Error{bad_file}.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

// The whole content at once. `durable`: the disk has the content before the name stands for it; the name
// itself is on the disk once the folder is (core/files/disk.hpp). Throws Error{bad_file} and leaves an
// earlier file as it was.
enum class Durable { no, yes };
void write_aside(const std::filesystem::path& target, std::string_view content,
                 Durable durable = Durable::no);

// Appends to an open file in one piece; what could not be written whole is cut off again, so that
// the file ends with a whole line. Throws Error{bad_file} naming `path`.
void append_whole(int descriptor, std::string_view content, const std::filesystem::path& path);

// Appends in one piece to a file that exists; returns false if it does not, or is a link. Throws as
// append_whole.
bool append_to_existing(const std::filesystem::path& path, std::string_view content);

// "cannot write `path`: <reason>", for the error number `reason` of a system call.
[[noreturn]] void throw_file_error(std::string_view action, const std::filesystem::path& path, int reason);

// A file name for any text: letters, digits, `_`, `.` and characters beyond ASCII stay, each run of others
// becomes one `-`; no dot or `-` in front, no `-` at the end, at most 120 bytes, never empty.
std::string safe_file_name(std::string_view text);

}  // namespace asperity

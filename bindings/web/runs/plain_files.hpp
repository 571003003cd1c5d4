// SPDX-License-Identifier: GPL-3.0-or-later
// Files of a folder with untrusted contents. A name is followed part by part below the folder: no link, no
// "..", and only to an ordinary file, never to a device, pipe or folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::web {

// A descriptor for reading and its size; none if there is no such file. The caller closes the descriptor.
struct OpenFile {
  int descriptor = -1;
  std::int64_t bytes = 0;
};
std::optional<OpenFile> open_plain_file(const std::filesystem::path& folder, std::string_view name);
// The whole file, if it has at most `most_bytes`.
std::optional<std::string> read_plain_file(const std::filesystem::path& folder, std::string_view name,
                                           std::size_t most_bytes);

struct PlainFile {
  std::string name;  // "a/b.csv"
  std::int64_t bytes = 0;
  std::int64_t changed = 0;  // nanoseconds since 1970
};
// Every ordinary file below the folder, including hidden files and folders. `bytes` gets the total size on
// disk with the folders. Beyond `most_files` the listing stops and `bytes` is too_many.
inline constexpr std::int64_t too_many = INT64_MAX;
std::vector<PlainFile> plain_files(const std::filesystem::path& folder, std::size_t most_files,
                                   std::int64_t& bytes);

// The type by the ending, such as "text/csv; charset=utf-8"; unknown endings give plain bytes.
std::string media_type(std::string_view name);

}  // namespace asperity::web

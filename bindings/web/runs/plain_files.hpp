// SPDX-License-Identifier: GPL-3.0-or-later
// Files of a folder that somebody else fills. A name is followed part by part below the folder, through no
// link and no "..", to an ordinary file and nothing else: no device, pipe or folder.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::web {

// A descriptor for reading, and its bytes; none where there is no such file. The caller closes it.
struct OpenFile {
  int descriptor = -1;
  std::int64_t bytes = 0;
};
std::optional<OpenFile> open_plain_file(const std::filesystem::path& folder, std::string_view name);
// The whole of one that has at most so many bytes.
std::optional<std::string> read_plain_file(const std::filesystem::path& folder, std::string_view name,
                                           std::size_t most_bytes);

struct PlainFile {
  std::string name;  // "a/b.csv"
  std::int64_t bytes = 0;
  std::int64_t changed = 0;  // nanoseconds since 1970
};
// Every ordinary file below the folder, hidden ones and those of hidden folders included. `bytes` gets what
// they take together, with the folders; where there are more than `most_files` it stops there, and `bytes`
// gets too_many.
inline constexpr std::int64_t too_many = INT64_MAX;
std::vector<PlainFile> plain_files(const std::filesystem::path& folder, std::size_t most_files,
                                   std::int64_t& bytes);

// "text/csv; charset=utf-8" by the ending; bytes without a meaning for what is not known.
std::string media_type(std::string_view name);

}  // namespace asperity::web

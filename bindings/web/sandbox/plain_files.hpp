// SPDX-License-Identifier: GPL-3.0-or-later
// Open files, and ordinary files of an untrusted folder. Names are resolved part by part, without links and
// "..".
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace asperity::web {

// Owns an open file; -1: none. Keeps errno.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { reset(); }
  Descriptor(Descriptor&& other) noexcept : number_(other.number_) { other.number_ = -1; }
  Descriptor& operator=(Descriptor&& other) noexcept;
  int get() const { return number_; }
  void reset();

 private:
  int number_ = -1;
};

struct OpenFile {
  Descriptor file;
  std::int64_t bytes = 0;
};
std::optional<OpenFile> open_plain_file(const std::filesystem::path& folder, std::string_view name);
// None beyond `most_bytes`.
std::optional<std::string> read_plain_file(const std::filesystem::path& folder, std::string_view name,
                                           std::size_t most_bytes);

struct PlainFile {
  std::string name;  // "a/b.csv"
  std::int64_t bytes = 0;
  std::int64_t changed = 0;  // nanoseconds since 1970
};
// All ordinary files below the folder, including hidden ones. `bytes`: total on disk with folders; too_many
// beyond `most_files`, where the listing stops.
inline constexpr std::int64_t too_many = INT64_MAX;
std::vector<PlainFile> plain_files(const std::filesystem::path& folder, std::size_t most_files,
                                   std::int64_t& bytes);

// By ending, "text/csv; charset=utf-8"; else plain bytes.
std::string media_type(std::string_view name);

}  // namespace asperity::web

// SPDX-License-Identifier: GPL-3.0-or-later
// Sequential, bounds-checked reader of an instrument's little-endian numbers and texts.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "engine/core/files/source_file.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/monitor.hpp"

namespace asperity {

template <class T>
T little_endian(const char* at) {
  static_assert(std::endian::native == std::endian::little, "bytes are taken as they lie");
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), at, sizeof(T));
  return std::bit_cast<T>(raw);
}

template <class T>
T big_endian(const char* at) {
  std::array<char, sizeof(T)> raw;
  for (std::size_t k = 0; k < sizeof(T); ++k) raw[k] = at[sizeof(T) - 1 - k];
  return std::bit_cast<T>(raw);
}

class BinaryCursor {
 public:
  // `what` names the piece in errors: "its header".
  BinaryCursor(const SourceFile& file, std::string_view bytes, std::string what)
      : file_(file), bytes_(bytes), what_(std::move(what)) {}

  template <class T>
  T number() {
    return little_endian<T>(take(sizeof(T)).data());
  }
  // Throws Error{bad_file} past the end.
  std::string_view take(std::size_t count);
  void skip(std::size_t count) { take(count); }
  // Up to the first zero byte, without trailing blanks.
  std::string_view text(std::size_t width);
  // Skips the zero byte.
  std::string_view ended_text();
  std::size_t left() const { return bytes_.size() - at_; }
  std::size_t position() const { return at_; }

 private:
  const SourceFile& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::string what_;
};

// Throws Error{bad_file} unless nx, ny > 0 and all numbers of `width` bytes are present.
void require_numbers(const SourceFile& file, std::uint64_t nx, std::uint64_t ny, std::uint64_t width,
                     std::uint64_t present);

// Also throws on surplus bytes: with a header wrong by a column, every line would be shifted.
void require_exactly(const SourceFile& file, std::uint64_t nx, std::uint64_t ny, std::uint64_t width,
                     std::uint64_t present);

// For files with a stated end; the heights are complete.
void warn_of_bytes_over(const SourceFile& file, std::uint64_t over, Monitor& monitor);

struct NoHoles {
  bool operator()(auto) const { return false; }
};
// ny rows, checked before by require_numbers(). `is_hole` selects the numbers of missing points.
template <class T, T (*read)(const char* at) = little_endian<T>, class IsHole = NoHoles>
Field field_of_numbers(std::string_view bytes, int nx, int ny, Monitor& monitor, const IsHole& is_hole = {}) {
  Field heights(nx, ny);
  Task task(monitor, "reading", ny);
  for (int j = 0; j < ny; ++j) {
    const char* at = bytes.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) * sizeof(T);
    for (double& height : heights.row(j)) {
      const T value = read(at);
      height = is_hole(value) ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(value);
      at += sizeof(T);
    }
    task.advance();
  }
  return heights;
}

}  // namespace asperity

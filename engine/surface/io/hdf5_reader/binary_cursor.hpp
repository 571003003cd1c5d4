// SPDX-License-Identifier: GPL-3.0-or-later
// A bounds-checked cursor, types of number, shared checks.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/files/source_file.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/memory.hpp"
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

template <class T>
std::string raw_bytes(T value) {
  static_assert(std::endian::native == std::endian::little, "files are little-endian");
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

// A number of a file as a double.
struct NumberType {
  std::size_t width = 0;  // bytes
  double (*read)(const char* at) = nullptr;
};
template <class T, T (*from)(const char* at) = little_endian<T>>
inline constexpr NumberType number_type{sizeof(T),
                                        [](const char* at) { return static_cast<double>(from(at)); }};

// Little-endian.
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
  std::string_view rest() const { return bytes_.substr(at_); }
  std::size_t left() const { return bytes_.size() - at_; }
  std::size_t position() const { return at_; }

 private:
  const SourceFile& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::string what_;
};

// Throws Error{bad_file} past the end.
std::string_view bytes_at(const SourceFile& file, std::uint64_t at, std::uint64_t length,
                          const std::string& what);

// Throws Error{bad_file} unless nx, ny > 0 and all numbers of `width` bytes are present.
void require_numbers(const SourceFile& file, std::uint64_t nx, std::uint64_t ny, std::uint64_t width,
                     std::uint64_t present);

// Also throws on surplus bytes: the header may be wrong.
void require_exactly(const SourceFile& file, std::uint64_t nx, std::uint64_t ny, std::uint64_t width,
                     std::uint64_t present);

// Returns `value`. Throws Error{bad_file} unless finite and above zero.
double above_zero(const SourceFile& file, double value, const std::string& unit_and_place);

// "a, b and 3 more".
std::string listed_up_to(std::size_t most, std::vector<std::string> names);

// For files with a stated end; the heights are complete.
void warn_of_bytes_over(const SourceFile& file, std::uint64_t over, Monitor& monitor);

// Greatest expansion of deflate.
constexpr std::uint64_t most_of_deflate = 1032;

// From a zlib stream (RFC 1950). Throws Error{bad_file} for damage or another size.
Array<char> inflated(const SourceFile& file, std::string_view packed, std::uint64_t wanted,
                     std::string_view what);

inline constexpr auto never_missing = [](double) { return false; };
inline constexpr auto not_finite = [](double value) { return !std::isfinite(value); };
// ny lines, checked before by require_numbers(). `is_missing` selects missing points.
template <class IsMissing = decltype(never_missing)>
Field field_of_numbers(NumberType type, std::string_view bytes, std::uint64_t nx, std::uint64_t ny,
                       Monitor& monitor, const IsMissing& is_missing = never_missing,
                       std::uint64_t padding_of_line = 0) {
  Field heights(static_cast<int>(nx), static_cast<int>(ny));
  Task task(monitor, "reading", heights.ny());
  const char* at = bytes.data();
  for (int j = 0; j < heights.ny(); ++j, at += padding_of_line) {
    for (double& height : heights.row(j)) {
      const double value = type.read(at);
      height = is_missing(value) ? std::numeric_limits<double>::quiet_NaN() : value;
      at += type.width;
    }
    task.advance();
  }
  return heights;
}

// Checks by require_exactly().
template <class IsMissing = decltype(never_missing)>
Field exact_field(const SourceFile& file, NumberType type, std::string_view bytes, std::uint64_t nx,
                  std::uint64_t ny, Monitor& monitor, const IsMissing& is_missing = never_missing) {
  require_exactly(file, nx, ny, type.width, bytes.size());
  return field_of_numbers(type, bytes, nx, ny, monitor, is_missing);
}

}  // namespace asperity

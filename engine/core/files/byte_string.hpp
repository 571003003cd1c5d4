// SPDX-License-Identifier: GPL-3.0-or-later
// Values in memory representation, between processes of one build and machine type. The reader checks all
// lengths.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "engine/core/error.hpp"

namespace asperity {

class ByteWriter {
 public:
  // bool, integers and double.
  template <class T>
  ByteWriter& number(T value) {
    static_assert(std::is_arithmetic_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  ByteWriter& count(std::size_t value) { return number(static_cast<std::uint64_t>(value)); }
  ByteWriter& text(std::string_view value) {
    count(value.size());
    bytes_.append(value);
    return *this;
  }
  void numbers(std::span<const double> values) {
    count(values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
  }
  std::string take() { return std::exchange(bytes_, {}); }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  // All throw Error{bad_file} for truncated or invalid bytes.
  template <class T>
  T number() {
    static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
    T value;
    std::memcpy(&value, next(sizeof value).data(), sizeof value);
    return value;
  }
  bool truth() {
    const auto value = number<std::uint8_t>();
    if (value > 1) damaged();
    return value == 1;
  }
  // Number of following items, each at least `least` bytes long.
  std::size_t count(std::size_t least = 1) {
    const auto value = number<std::uint64_t>();
    if (value > left_.size() / least) damaged();
    return static_cast<std::size_t>(value);
  }
  std::string text() { return std::string(next(count())); }
  template <class Make>
  auto numbers(Make make) {
    const std::size_t length = count(sizeof(double));
    auto values = make(length);
    const std::string_view bytes = next(length * sizeof(double));
    if (length > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  bool at_end() const { return left_.empty(); }

  [[noreturn]] static void damaged() {
    throw Error(ErrorCode::bad_file, "a stored string of bytes is cut short or altered");
  }

 private:
  std::string_view next(std::size_t length) {
    if (length > left_.size()) damaged();
    const std::string_view bytes = left_.substr(0, length);
    left_.remove_prefix(length);
    return bytes;
  }

  std::string_view left_;
};

}  // namespace asperity

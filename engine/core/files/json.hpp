// SPDX-License-Identifier: GPL-3.0-or-later
// JSON for journal lines and manifests. Members keep their order: equal records have equal bytes. Doubles
// survive exactly; nan and infinities become strings. Not for bulk data.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace asperity {

class Json {
 public:
  using List = std::vector<Json>;
  using Member = std::pair<std::string, Json>;
  using Members = std::vector<Member>;

  Json() = default;  // null
  Json(bool value) : value_(value) {}
  Json(double value) : value_(value) {}
  Json(const char* value) : value_(std::string(value)) {}
  Json(std::string_view value) : value_(std::string(value)) {}
  Json(std::string value) : value_(std::move(value)) {}
  Json(List value) : value_(std::move(value)) {}
  // Integers above 2^63-1 become text, without rounding.
  template <std::integral T>
  requires(!std::same_as<T, bool>) Json(T value) {
    if (std::in_range<std::int64_t>(value)) {
      value_ = static_cast<std::int64_t>(value);
    } else {
      value_ = std::to_string(value);
    }
  }
  static Json object(Members members = {});
  static Json strings(const std::vector<std::string>& items);

  bool is_null() const { return std::holds_alternative<std::monostate>(value_); }
  bool is_object() const { return std::holds_alternative<Members>(value_); }
  bool is_list() const { return std::holds_alternative<List>(value_); }
  bool is_string() const { return std::holds_alternative<std::string>(value_); }
  // False for the strings "nan", "inf" and "-inf".
  bool is_number() const {
    return std::holds_alternative<std::int64_t>(value_) || std::holds_alternative<double>(value_);
  }

  // Replaces or appends; null becomes an object. Others throw Error{internal}.
  Json& set(std::string_view name, Json value);
  // Null if absent. Linear.
  const Json* find(std::string_view name) const;
  // A null value if absent.
  const Json& operator[](std::string_view name) const;

  // Throw Error{bad_file} for another type. number() also reads "nan", "inf" and "-inf".
  double number() const;
  bool boolean() const;
  const std::string& string() const;
  const List& list() const;
  const Members& members() const;

  // One line, or `indent` spaces per level. Invalid UTF-8 becomes U+FFFD.
  std::string text(int indent = -1) const;
  // Throws Error{bad_file} naming `what`: syntax error, number beyond double, or nesting above 256.
  static Json parse(std::string_view text, std::string_view what);

  bool operator==(const Json&) const = default;

 private:
  friend struct JsonCodec;
  template <class T>
  const T& as(std::string_view wanted) const;
  std::variant<std::monostate, bool, std::int64_t, double, std::string, List, Members> value_;
};

}  // namespace asperity

// SPDX-License-Identifier: GPL-3.0-or-later
// A small JSON value for journal lines and manifests. Members keep the order in which they were set,
// so that equal records are equal bytes. Numbers read back as the same double; nan and the infinities,
// which JSON lacks, are written as the strings "nan", "inf" and "-inf". Not meant for bulk data.
// A value: no shared state, as thread-safe as an int.
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
  // Whole numbers past 2^63-1 are kept as text, never rounded.
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
  // Of JSON: not the strings "nan", "inf" and "-inf".
  bool is_number() const {
    return std::holds_alternative<std::int64_t>(value_) || std::holds_alternative<double>(value_);
  }

  // Replaces the member of that name or adds it last; a null becomes an object first. Throws
  // Error{internal} on anything else.
  Json& set(std::string_view name, Json value);
  // The member of that name, or nullptr. Linear in the number of members.
  const Json* find(std::string_view name) const;

  // What the value holds. Throw Error{bad_file} naming what was wanted and what was found; number()
  // reads "nan", "inf" and "-inf" too.
  double number() const;
  bool boolean() const;
  const std::string& string() const;
  const List& list() const;
  const Members& members() const;

  // On one line, or with `indent` spaces a level. Bytes that are not UTF-8 become U+FFFD.
  std::string text(int indent = -1) const;
  // Throws Error{bad_file} naming `what` and the byte where the text stops being JSON, or for a number
  // beyond any double, or lists in lists more than 256 deep.
  static Json parse(std::string_view text, std::string_view what);

  bool operator==(const Json&) const = default;

 private:
  friend struct JsonCodec;  // translates to and from the library's value, which no header shows
  std::variant<std::monostate, bool, std::int64_t, double, std::string, List, Members> value_;
};

}  // namespace asperity

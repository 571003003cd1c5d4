// SPDX-License-Identifier: GPL-3.0-or-later
// Types of results: name, unit, sentence and source of each field. They drive records, help, completion,
// editor types, reference and placeholders.
#pragma once

#include <array>
#include <concepts>
#include <functional>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings/lua/registry/held.hpp"
#include "bindings/lua/registry/registry.hpp"

namespace asperity::lua {

template <class T>
class RecordType;

namespace detail {

template <class V>
inline constexpr bool is_optional = false;
template <class V>
inline constexpr bool is_optional<std::optional<V>> = true;

// "number", "integer[]", "string?"
template <class V>
std::string type_of_held() {
  if constexpr (is_optional<V>)
    return type_of_held<typename V::value_type>() + "?";
  else if constexpr (std::same_as<V, bool>)
    return "boolean";
  else if constexpr (std::integral<V>)
    return "integer";
  else if constexpr (std::floating_point<V>)
    return "number";
  else if constexpr (std::convertible_to<V, std::string_view>)
    return "string";
  else
    return type_of_held<typename V::value_type>() + "[]";
}

template <class V>
Value value_of_held(const V& held) {
  if constexpr (is_optional<V>)
    return held ? value_of_held(*held) : Value();
  else if constexpr (std::same_as<V, bool> || std::floating_point<V>)
    return Value(held);
  else if constexpr (std::integral<V>)
    return Value(static_cast<std::int64_t>(held));
  else if constexpr (std::convertible_to<V, std::string_view>)
    return Value(std::string(held));
  else if constexpr (std::constructible_from<Value, const V&>)
    return Value(held);
  else if constexpr (!std::ranges::range<V>)
    return object(held);
  else if constexpr (std::same_as<std::ranges::range_value_t<V>, double>)
    return number_list(held);
  else {
    List list;
    for (const auto& item : held) list.items.push_back(value_of_held(item));
    return list;
  }
}

template <class T, class V>
T class_of_member(V T::*);
template <class T, class V>
T class_of_member(V (*)(const T&));
template <auto read, auto... further>
auto follow(const auto& of) {
  if constexpr (sizeof...(further) == 0)
    return std::invoke(read, of);
  else
    return follow<further...>(std::invoke(read, of));
}
template <class Run, class V, class T, class... Others>
T value_read_by(V (Run::*)(const T&, Others...) const);
// The lambda's first parameter.
template <class Run>
using Read = decltype(value_read_by(&Run::operator()));
template <class Run>
requires requires { &Run::operator(); }
Read<Run> class_of_member(Run);

}  // namespace detail

// A list of two values.
template <class V>
std::array<V, 2> along_axes(V x, V y) {
  return {x, y};
}

// For a Class whose values provide description and digest. `read` is a member or a function of the value.
template <auto read, class T = decltype(detail::class_of_member(read))>
std::string text_of(const void* self) {
  return std::invoke(read, *static_cast<const T*>(self));
}
// For other functions of a Class: a captureless lambda.
template <class Run>
auto from_value(Run) {
  return [](const void* self) { return Run{}(*static_cast<const detail::Read<Run>*>(self)); };
}
// Text without its last line break.
template <class T>
std::string lines_of(const void* self) {
  std::string text = static_cast<const T*>(self)->text();
  text.pop_back();
  return text;
}
template <class T>
bool have_one_digest(const void* a, const void* b) {
  return static_cast<const T*>(a)->digest() == static_cast<const T*>(b)->digest();
}

// A method's body with one result. `run`: a captureless lambda of the value, and of the call if it has
// arguments.
template <class Run>
Body method(Run) {
  return [](Call& call) -> Values {
    const auto& self = call.self<detail::Read<Run>>();
    if constexpr (std::invocable<Run, decltype(self)>)
      return {detail::value_of_held(Run{}(self))};
    else
      return {detail::value_of_held(Run{}(self, call))};
  };
}

// A field of a native value. `read`: a member or a member function without arguments; each of `further` the
// same for the result.
template <auto read, auto... further>
Getter getter(StaticText name, StaticText type, StaticText sentence, Dimension dimension = {}) {
  return {name, type, sentence, dimension, [](Call& call) -> Values {
            using T = decltype(detail::class_of_member(read));
            return {detail::value_of_held(detail::follow<read, further...>(std::as_const(call.self<T>())))};
          }};
}
// `read`: a captureless lambda.
template <class T, std::invocable<const T&> Read>
Getter getter(StaticText name, StaticText type, StaticText sentence, Read read, Dimension dimension = {}) {
  return {name, type, sentence, dimension, method(read)};
}

// A field of a record made from a T. `read`: a member, a member function or a function of T; its result
// determines the field's type: numbers, texts, optionals (nil if empty) and lists.
template <class T>
class RecordField {
 public:
  template <std::invocable<const T&> Read>
  RecordField(StaticText name, Read read, Dimension dimension, StaticText sentence)
      : info{name, detail::type_of_held<Result<Read>>(), sentence, dimension},
        read_([read](const T& of) { return detail::value_of_held(std::invoke(read, of)); }) {}
  template <std::invocable<const T&> Read>
  RecordField(StaticText name, Read read, StaticText sentence)
      : RecordField(name, read, dimension::number, sentence) {}
  // A record or a list of records.
  template <std::invocable<const T&> Read, class U>
  RecordField(StaticText name, Read read, const RecordType<U>& type, StaticText sentence)
      : info{name, type.name + (std::same_as<Result<Read>, U> ? "" : "[]"), sentence, {}},
        read_([read, &type](const T& of) -> Value {
          if constexpr (std::same_as<Result<Read>, U>)
            return type(std::invoke(read, of));
          else
            return type.list(std::invoke(read, of));
        }) {}
  template <std::invocable<const T&> Read>
  RecordField(StaticText name, StaticText type, Read read, StaticText sentence)
      : info{name, type, sentence, {}},
        read_([read](const T& of) -> Value { return std::invoke(read, of); }) {}

  // Without the effect, reading the field is an error that names it.
  RecordField& needs(StaticText effect) {
    where_known();
    info.sentence = info.sentence + "; needs " + effect;
    effect_ = effect;
    return *this;
  }
  // Without a value, the field is missing instead of nil.
  RecordField& where_known() {
    where_known_ = true;
    if (info.type.ends_with('?')) info.type = std::string(info.type, 0, info.type.size() - 1);
    return *this;
  }
  // Varies between records; the sentence must say so.
  RecordField& in(Dimension (*unit)(const T&)) {
    unit_ = unit;
    return *this;
  }

  void add_to(Record& record, const T& of) const {
    Value value = read_(of);
    const Dimension unit = unit_ != nullptr ? unit_(of) : info.dimension;
    if (!effect_.empty())
      record.add_if(effect_, info.name, std::move(value), unit);
    else if (!where_known_ || !value.is_nil())
      record.add(info.name, std::move(value), unit);
  }

  Getter info;

 private:
  template <class Read>
  using Result = std::remove_cvref_t<std::invoke_result_t<Read, const T&>>;

  Held<Value(const T&)> read_;
  StaticText effect_{};
  bool where_known_ = false;
  Dimension (*unit_)(const T&) = nullptr;
};

// Never destroyed: records store its address.
template <class T>
class RecordType : public RecordInfo {
 public:
  using Field = RecordField<T>;

  RecordType(StaticText type_name, StaticText print_title, StaticText meaning, std::vector<Field> entries)
      : RecordInfo{type_name, print_title, meaning, {}}, entries_(std::move(entries)) {
    for (const Field& entry : entries_) fields.push_back(entry.info);
  }
  RecordType& titled(std::string (*title_of)(const T&)) {
    title_of_ = title_of;
    return *this;
  }

  Record operator()(const T& of) const {
    Record record;
    record.name = title_of_ != nullptr ? title_of_(of) : std::string(title);
    record.type = this;
    for (const Field& entry : entries_) entry.add_to(record, of);
    return record;
  }
  List list(const std::vector<T>& items) const {
    List records;
    records.rows = true;
    for (const T& item : items) records.items.emplace_back((*this)(item));
    return records;
  }

 private:
  std::vector<Field> entries_;
  std::string (*title_of_)(const T&) = nullptr;
};

}  // namespace asperity::lua

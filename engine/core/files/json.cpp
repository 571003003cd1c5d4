// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/files/json.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "engine/core/constants.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity {

using Library = nlohmann::ordered_json;

struct JsonCodec {
  static Library encode(const Json& value) { return std::visit(JsonCodec(), value.value_); }
  static Json decode(const Library& value);

  Library operator()(std::monostate) const { return nullptr; }
  Library operator()(bool value) const { return value; }
  Library operator()(std::int64_t value) const { return value; }
  Library operator()(double value) const {
    if (!std::isfinite(value)) return format_exact(value);
    return value;
  }
  Library operator()(const std::string& value) const { return value; }
  Library operator()(const Json::List& items) const {
    Library list = Library::array();
    for (const Json& item : items) list.push_back(encode(item));
    return list;
  }
  Library operator()(const Json::Members& members) const {
    Library object = Library::object();
    for (const auto& [name, value] : members) object[name] = encode(value);
    return object;
  }
};

Json Json::object(Members members) {
  Json result;
  result.value_ = std::move(members);
  return result;
}

Json Json::strings(const std::vector<std::string>& items) { return List(items.begin(), items.end()); }

Json& Json::set(std::string_view name, Json value) {
  if (is_null()) value_ = Members();
  Members* members = std::get_if<Members>(&value_);
  if (members == nullptr)
    throw Error(ErrorCode::internal, "member " + quoted(name) + " set on a value that is no object");
  for (Member& member : *members)
    if (member.first == name) {
      member.second = std::move(value);
      return *this;
    }
  members->emplace_back(name, std::move(value));
  return *this;
}

const Json* Json::find(std::string_view name) const {
  const Members* members = std::get_if<Members>(&value_);
  if (members == nullptr) return nullptr;
  for (const Member& member : *members)
    if (member.first == name) return &member.second;
  return nullptr;
}

const Json& Json::operator[](std::string_view name) const {
  static const Json null;
  const Json* found = find(name);
  return found != nullptr ? *found : null;
}

namespace {
[[noreturn]] void wrong_kind(std::string_view wanted, std::size_t found) {
  constexpr std::array<std::string_view, 7> kinds = {"nothing",  "a boolean", "a whole number", "a number",
                                                     "a string", "a list",    "an object"};
  refuse_bad_file("a record holds " + std::string(kinds[found]) + " instead of " + std::string(wanted),
                  "the file was written by another program or damaged");
}
}  // namespace

double Json::number() const {
  if (const auto* whole = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value_)) return *real;
  if (const auto* text = std::get_if<std::string>(&value_)) {
    if (*text == "nan") return std::numeric_limits<double>::quiet_NaN();
    if (*text == "inf") return infinity;
    if (*text == "-inf") return -infinity;
  }
  wrong_kind("a number", value_.index());
}

template <class T>
const T& Json::as(std::string_view wanted) const {
  if (const T* value = std::get_if<T>(&value_)) return *value;
  wrong_kind(wanted, value_.index());
}

bool Json::boolean() const { return as<bool>("a boolean"); }
const std::string& Json::string() const { return as<std::string>("a string"); }
const Json::List& Json::list() const { return as<List>("a list"); }
const Json::Members& Json::members() const { return as<Members>("an object"); }

std::string Json::text(int indent) const {
  return JsonCodec::encode(*this).dump(indent, ' ', false, Library::error_handler_t::replace);
}

Json Json::parse(std::string_view text, std::string_view what) {
  // Destruction of nested lists is recursive, so the depth is limited.
  constexpr int deepest = 256;
  const auto refuse = [&](const std::string& finding) {
    refuse_bad_file(std::string(what) + " " + finding, "the file was cut short or damaged");
  };
  const auto look = [&](int depth, Library::parse_event_t, Library&) {
    if (depth > deepest) refuse("holds lists in lists deeper than " + std::to_string(deepest));
    return true;
  };
  try {
    return JsonCodec::decode(Library::parse(text, look));
  } catch (const Library::parse_error& error) {
    refuse("is not JSON past byte " + std::to_string(error.byte));
  } catch (const Library::out_of_range&) {
    refuse("holds a number beyond any double");
  }
  return {};
}

Json JsonCodec::decode(const Library& value) {
  switch (value.type()) {
    case Library::value_t::boolean:
      return value.get<bool>();
    case Library::value_t::number_integer:
      return value.get<std::int64_t>();
    case Library::value_t::number_unsigned:
      return value.get<std::uint64_t>();
    case Library::value_t::number_float:
      return value.get<double>();
    case Library::value_t::string:
      return value.get<std::string>();
    case Library::value_t::array: {
      Json::List items;
      for (const Library& item : value) items.push_back(decode(item));
      return items;
    }
    case Library::value_t::object: {
      Json::Members members;
      for (const auto& [name, item] : value.items()) members.emplace_back(name, decode(item));
      return Json::object(std::move(members));
    }
    default:
      return {};
  }
}

}  // namespace asperity

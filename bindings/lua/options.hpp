// SPDX-License-Identifier: GPL-3.0-or-later
// A block of named options, described once: name, dimension, default, range and a sentence for each
// key. The block reads a Lua table into a plain C++ struct, reports every problem of the table in
// one Error (unknown keys with the nearest name, missing ones, wrong types, units and ranges),
// and tells help(), the editor's types, the reference page and the journal what it knows.
//
//   const Block<SineOptions> block{"lab.surface.sine", {
//       quantity("amplitude", &SineOptions::amplitude, dimension::length, any(), "height of a
//       crest").required(),
//       ...}};
#pragma once

#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings/lua/argument.hpp"
#include "engine/core/error.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

// The numbers an option accepts. NaN never passes; an infinity only where `never` allows it.
struct NumberRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false, high_open = false;
  bool never = false;
  // math.huge is accepted and means "never".
  constexpr NumberRange or_never() const {
    NumberRange r = *this;
    r.never = true;
    return r;
  }
  bool contains(double value) const;
  // "above 0", "from 2 to 3"; "" for any.
  std::string text(Dimension dimension) const;
};
constexpr NumberRange any() { return {}; }
constexpr NumberRange above(double low) {
  return {low, std::numeric_limits<double>::infinity(), true, false, false};
}
constexpr NumberRange at_least(double low) {
  return {low, std::numeric_limits<double>::infinity(), false, false, false};
}
constexpr NumberRange between(double low, double high) { return {low, high, false, false, false}; }
constexpr NumberRange inside(double low, double high) { return {low, high, true, true, false}; }

class BlockInfo;

struct OptionInfo {
  std::string name;
  std::string type;  // "length", "number", "integer", "string", "boolean", "Surface", "\"all\"|\"resolved\""
  Dimension dimension{};
  std::string default_text;  // as a script would write it; "" if there is none
  std::string range_text;    // "above 0"; may be empty
  std::string sentence;
  bool required = false;
  const BlockInfo* inner = nullptr;  // of a table inside the table
};

template <class O>
class Block;

// What is known of a block without its struct.
class BlockInfo {
 public:
  virtual ~BlockInfo() = default;
  virtual const std::string& name() const = 0;
  virtual std::vector<const OptionInfo*> options() const = 0;
  // Reads and throws away: what a dry run does. Throws like read().
  virtual void check(const Argument& table, const std::string& caller) const = 0;
};

// The keys of a call with the values that were in force, as text.
using Resolved = std::vector<std::pair<std::string, std::string>>;

// A problem is a sentence about one key, without its line.
using Problems = std::vector<std::string>;

namespace detail {
// Reads a number or a quantity; appends a problem and returns nothing if it cannot be had.
std::optional<double> read_quantity(const Argument& value, const OptionInfo& info, const NumberRange& range,
                                    Problems& problems);
std::optional<std::int64_t> read_integer(const Argument& value, const OptionInfo& info,
                                         const NumberRange& range, Problems& problems);
void wrong_type(const Argument& value, const OptionInfo& info, std::string_view wanted, Problems& problems);
// Walks the table: calls read(option index, value) for known keys; reports unknown and missing ones.
void read_table(const Argument& table, const std::string& caller,
                const std::vector<const OptionInfo*>& options,
                const std::function<void(std::size_t, const Argument&, Problems&)>& read,
                const std::function<void(Problems&)>& finish);
template <class T>
void assign(std::optional<T>& member, T value) {
  member = std::move(value);
}
template <class T, class U>
void assign(T& member, U value) {
  member = static_cast<T>(value);
}
inline std::optional<double> shown(double v) { return v; }
inline std::optional<double> shown(int v) { return v; }
inline std::optional<double> shown(std::int64_t v) { return static_cast<double>(v); }
inline std::optional<double> shown(std::uint64_t v) { return static_cast<double>(v); }
template <class T>
std::optional<double> shown(const std::optional<T>& v) {
  return v ? std::optional<double>(static_cast<double>(*v)) : std::nullopt;
}
}  // namespace detail

// One key of a block that fills a struct O.
template <class O>
struct Option {
  OptionInfo info;
  std::function<void(const Argument&, const OptionInfo&, O&, Problems&)> read;
  // The value as a script would write it, "" for none; may be null. Gives defaults and the record.
  std::function<std::string(const O&)> show;

  Option() = default;
  // An option of a base struct serves the struct that extends it.
  template <class Base>
  requires(std::derived_from<O, Base> && !std::same_as<O, Base>) Option(Option<Base> base)
      : info(std::move(base.info)), read(std::move(base.read)), show(std::move(base.show)) {}

  Option required() && {
    info.required = true;
    return std::move(*this);
  }
  // How a value reads in the record, for options made with custom().
  Option shown_by(std::function<std::string(const O&)> text) && {
    show = std::move(text);
    return std::move(*this);
  }
  // How the default reads where the struct cannot tell ("size", "roll_off = long_wave").
  Option defaults_to(std::string text) && {
    info.default_text = std::move(text);
    return std::move(*this);
  }
};

// A quantity of one dimension, or a plain number for dimension::number. Member: double or optional<double>.
template <class O, class M>
Option<O> quantity(std::string name, M O::*member, Dimension dimension, NumberRange range,
                   std::string sentence) {
  Option<O> option;
  option.info = {std::move(name),
                 dimension == dimension::number ? "number" : describe(dimension),
                 dimension,
                 "",
                 range.text(dimension),
                 std::move(sentence),
                 false};
  option.read = [member, range](const Argument& value, const OptionInfo& info, O& options,
                                Problems& problems) {
    if (auto number = detail::read_quantity(value, info, range, problems))
      detail::assign(options.*member, *number);
  };
  option.show = [member, dimension](const O& options) -> std::string {
    const auto value = detail::shown(options.*member);
    if (!value) return "";
    if (std::isinf(*value)) return "math.huge";
    if (dimension == dimension::number || *value == 0) return format_exact(*value);
    return "\"" + format_quantity(*value, dimension, 10) + "\"";
  };
  return option;
}

template <class O, class M>
Option<O> number(std::string name, M O::*member, NumberRange range, std::string sentence) {
  return quantity<O>(std::move(name), member, dimension::number, range, std::move(sentence));
}

template <class O, class M>
Option<O> integer(std::string name, M O::*member, NumberRange range, std::string sentence) {
  Option<O> option;
  option.info = {std::move(name), "integer", {}, "", range.text({}), std::move(sentence), false};
  option.read = [member, range](const Argument& value, const OptionInfo& info, O& options,
                                Problems& problems) {
    if (auto number = detail::read_integer(value, info, range, problems))
      detail::assign(options.*member, *number);
  };
  option.show = [member](const O& options) -> std::string {
    const auto value = detail::shown(options.*member);
    return value ? format_exact(*value) : "";
  };
  return option;
}

template <class O>
Option<O> flag(std::string name, bool O::*member, std::string sentence) {
  Option<O> option;
  option.info = {std::move(name), "boolean", {}, "", "", std::move(sentence), false};
  option.read = [member](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
    if (value.is_boolean())
      options.*member = value.boolean();
    else
      detail::wrong_type(value, info, "true or false", problems);
  };
  option.show = [member](const O& options) { return std::string(options.*member ? "true" : "false"); };
  return option;
}

// A string. Member: std::string or optional<std::string>.
template <class O, class M>
Option<O> text(std::string name, M O::*member, std::string sentence) {
  Option<O> option;
  option.info = {std::move(name), "string", {}, "", "", std::move(sentence), false};
  option.read = [member](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
    if (value.is_text())
      options.*member = std::string(value.text());
    else
      detail::wrong_type(value, info, "a string", problems);
  };
  return option;
}

// One of a closed set of words.
template <class O, class M>
Option<O> choice(std::string name, M O::*member,
                 std::vector<std::pair<std::string, std::type_identity_t<M>>> words, std::string sentence) {
  Option<O> option;
  std::string type;
  std::vector<std::string> names;
  for (const auto& [word, value] : words) {
    type += (type.empty() ? "" : "|") + ("\"" + word + "\"");
    names.push_back(word);
  }
  option.info = {std::move(name), type, {}, "", "", std::move(sentence), false};
  option.read = [member, words, names](const Argument& value, const OptionInfo& info, O& options,
                                       Problems& problems) {
    if (value.is_text()) {
      for (const auto& [word, meaning] : words) {
        if (word == value.text()) {
          options.*member = meaning;
          return;
        }
      }
      std::vector<std::string> accepted;
      for (const std::string& word : names) accepted.push_back("\"" + word + "\"");
      problems.push_back(quoted(info.name) + " is \"" + std::string(value.text().substr(0, 40)) + "\"" +
                         did_you_mean(value.text(), names) + "; give " + joined(accepted));
      return;
    }
    detail::wrong_type(value, info, "one of " + info.type, problems);
  };
  option.show = [member, words](const O& options) -> std::string {
    for (const auto& [word, value] : words)
      if (value == options.*member) return "\"" + word + "\"";
    return "";
  };
  return option;
}

// How a native value reads in the record: by its digest, or its name.
template <class T>
std::string digest_text(const T& value) {
  if constexpr (requires { value.digest(); })
    return std::string(value.digest());
  else if constexpr (requires { value.name; })
    return value.name;
  else
    return "";
}

// A native value. Member: T, std::optional<T> or std::shared_ptr<const T>.
template <class T, class O, class M>
Option<O> native(std::string name, M O::*member, std::string type, std::string wanted, std::string sentence) {
  Option<O> option;
  option.info = {std::move(name), std::move(type), {}, "", "", std::move(sentence), false};
  option.read = [member, wanted](const Argument& value, const OptionInfo& info, O& options,
                                 Problems& problems) {
    Object* object = value.as_object(class_of<T>());
    if (object == nullptr) return detail::wrong_type(value, info, wanted, problems);
    if (object->closed) {
      problems.push_back(quoted(info.name) + " was closed");
      return;
    }
    if (object->pointer == nullptr) return;  // a placeholder of a dry run
    if constexpr (requires(const M& m) { m.get(); })
      options.*member = std::static_pointer_cast<T>(object->pointer);
    else
      options.*member = *static_cast<const T*>(object->pointer.get());
  };
  option.show = [member](const O& options) -> std::string {
    if constexpr (requires { (options.*member).has_value(); }) {
      return (options.*member).has_value() ? digest_text(*(options.*member)) : std::string();
    } else if constexpr (requires(const M& m) { m.get(); }) {
      return options.*member ? digest_text(*(options.*member)) : std::string();
    } else {
      return "";
    }
  };
  return option;
}

// Anything else: `read` appends to the problems itself, beginning with quoted(info.name).
template <class O, class Read>
Option<O> custom(std::string name, std::string type, std::string sentence, Read read) {
  Option<O> option;
  option.info = {std::move(name), std::move(type), {}, "", "", std::move(sentence), false};
  option.read = std::move(read);
  return option;
}

// A table of named keys inside another, read by its own block; its problems join the outer ones.
template <class O, class Inner, class M>
Option<O> table_of(std::string name, M O::*member, const Block<Inner>& inner, std::string sentence) {
  Option<O> option;
  option.info = {std::move(name), "table", {}, "", "", std::move(sentence), false};
  option.info.inner = &inner;
  option.read = [member, &inner](const Argument& value, const OptionInfo& info, O& options,
                                 Problems& problems) {
    if (!value.is_table()) return detail::wrong_type(value, info, "a table of named keys", problems);
    try {
      options.*member = inner.read(value, quoted(info.name));
    } catch (const Error& error) {
      problems.push_back(error.what());
    }
  };
  return option;
}

// `cells`: a number or {nx, ny}.
template <class O>
Option<O> cells_option(int O::*nx, int O::*ny) {
  auto option =
      custom<O>("cells", "integer|{integer, integer}", "cells along x and y: a number, or {nx, ny}",
                [nx, ny](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
                  constexpr NumberRange range = between(1, max_cells);
                  if (value.is_table() && value.length() == 2) {
                    for (int k = 1; k <= 2; ++k)
                      value.element(k, [&](const Argument& part) {
                        if (auto n = detail::read_integer(part, info, range, problems))
                          options.*(k == 1 ? nx : ny) = static_cast<int>(*n);
                      });
                  } else if (value.is_table()) {
                    detail::wrong_type(value, info, "a whole number or {nx, ny}", problems);
                  } else if (auto n = detail::read_integer(value, info, range, problems)) {
                    options.*nx = options.*ny = static_cast<int>(*n);
                  }
                });
  option.info.range_text = "from 1 to " + std::to_string(max_cells);
  option.show = [nx, ny](const O& o) -> std::string {
    return o.*nx == 0 ? "" : "{" + std::to_string(o.*nx) + ", " + std::to_string(o.*ny) + "}";
  };
  return option;
}

// A length, or {along x, along y}; members double or optional<double>.
template <class O, class M>
Option<O> pair_option(std::string name, M O::*x, M O::*y, Dimension dimension, NumberRange range,
                      std::string sentence) {
  const std::string kind = describe(dimension);
  Option<O> option =
      custom<O>(std::move(name), kind + "|{" + kind + ", " + kind + "}", std::move(sentence),
                [x, y, range](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
                  if (value.is_table()) {
                    if (value.length() != 2)
                      return detail::wrong_type(value, info, "one value or two in a list", problems);
                    for (int k = 1; k <= 2; ++k)
                      value.element(k, [&](const Argument& part) {
                        if (auto v = detail::read_quantity(part, info, range, problems))
                          detail::assign(options.*(k == 1 ? x : y), *v);
                      });
                  } else if (auto v = detail::read_quantity(value, info, range, problems)) {
                    detail::assign(options.*x, *v);
                    detail::assign(options.*y, *v);
                  }
                });
  option.info.dimension = dimension;
  option.info.range_text = range.text(dimension);
  option.show = [x, y](const O& o) -> std::string {
    const auto a = detail::shown(o.*x), b = detail::shown(o.*y);
    return !a || !b || (*a == 0 && *b == 0) ? "" : "{" + format_exact(*a) + ", " + format_exact(*b) + "}";
  };
  return option;
}

template <class O>
class Block final : public BlockInfo {
 public:
  // `whole` sees the whole struct after all keys were read without a problem, and may add some.
  using Check = void (*)(O&, Problems&);

  Block(std::string name, std::vector<Option<O>> options, Check whole = nullptr)
      : name_(std::move(name)), options_(std::move(options)), check_(whole) {
    const O defaults{};
    for (Option<O>& option : options_)
      if (!option.info.required && option.info.default_text.empty() && option.show)
        option.info.default_text = option.show(defaults);
  }

  const std::string& name() const override { return name_; }

  std::vector<const OptionInfo*> options() const override {
    std::vector<const OptionInfo*> infos;
    for (const Option<O>& option : options_) infos.push_back(&option.info);
    return infos;
  }

  // Throws Error with all problems of the table. No argument at all reads as an empty table.
  // `resolved`, if given, receives every key with the value in force, as text.
  O read(const Argument& table, const std::string& caller, Resolved* resolved = nullptr) const {
    O result{};
    bool placeholders = false;
    detail::read_table(
        table, caller, options(),
        [&](std::size_t k, const Argument& value, Problems& problems) {
          if (value.is_unknown()) {
            // A native placeholder still has a class to check.
            placeholders = true;
            if (value.as_any_object() == nullptr) return;
          }
          options_[k].read(value, options_[k].info, result, problems);
        },
        [&](Problems& problems) {
          if (check_ != nullptr && !placeholders) check_(result, problems);
        });
    if (resolved != nullptr)
      for (const Option<O>& option : options_)
        if (option.show)
          if (std::string text = option.show(result); !text.empty())
            resolved->emplace_back(option.info.name, text);
    return result;
  }

  void check(const Argument& table, const std::string& caller) const override { (void)read(table, caller); }

 private:
  std::string name_;
  std::vector<Option<O>> options_;
  Check check_;
};

}  // namespace asperity::lua

// SPDX-License-Identifier: GPL-3.0-or-later
// A block of named options: name, dimension, default, range and sentence of each key. The block reads a Lua
// table into a plain C++ struct and reports all problems in one Error: unknown keys with the nearest name,
// missing keys, wrong types, units and ranges. help(), editor types, reference and journal use the same
// description. Constant blocks are made before main().
//
// Block<CutKeys>{{number("fraction", &CutKeys::fraction, between(0, 1), "of the height")}};
#pragma once

#include <any>
#include <cmath>
#include <concepts>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/held.hpp"
#include "engine/core/error.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/options.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

class BlockInfo;

struct OptionInfo {
  StaticText name;
  StaticText type;  // "length", "number", "integer", "string", "boolean", "Surface", "\"all\"|\"resolved\""
  Dimension dimension{};
  std::string default_text;  // as written in a script; "" if none
  std::string range_text;    // "above 0"; may be empty
  StaticText sentence;
  bool required = false;
  const BlockInfo* inner = nullptr;  // block of a nested table
};

class BlockInfo {
 public:
  virtual ~BlockInfo() = default;
  virtual std::vector<const OptionInfo*> options() const = 0;
  virtual bool is_list() const { return false; }
  // For a dry run. Throws as read().
  virtual void check(const Argument& table, const std::string& caller) const = 0;
};

inline std::vector<const OptionInfo*> pointers_to(const std::vector<OptionInfo>& infos) {
  std::vector<const OptionInfo*> pointers;
  for (const OptionInfo& info : infos) pointers.push_back(&info);
  return pointers;
}

using Resolved = std::vector<std::pair<std::string, std::string>>;

using Problems = std::vector<std::string>;

// The new name of a renamed key, else the nearest of `names`, else "".
std::string meant_by(std::string_view name, std::span<const std::string> names);

namespace detail {
// On failure they append a problem and return nothing.
std::optional<double> read_quantity(const Argument& value, const OptionInfo& info, const NumberRange& range,
                                    Problems& problems);
std::optional<std::int64_t> read_integer(const Argument& value, const OptionInfo& info,
                                         const NumberRange& range, Problems& problems);
// Scaled during an accuracy study (variation.hpp).
std::optional<std::int64_t> read_cells(const Argument& value, const OptionInfo& info,
                                       const NumberRange& range, Problems& problems);
void wrong_type(const Argument& value, std::string_view name, std::string_view wanted, Problems& problems);
inline void wrong_type(const Argument& value, const OptionInfo& info, std::string_view wanted,
                       Problems& problems) {
  wrong_type(value, info.name, wanted, problems);
}
// A number, or a quantity of any kind.
std::optional<Quantity> read_any_quantity(const Argument& value, const std::string& name,
                                          std::string_view wanted, Problems& problems);
// An error of `act` becomes a problem, which begins with the key if one is given.
template <class Act>
void collect(Problems& problems, Act act, const std::string& key = "") {
  try {
    act();
  } catch (const Error& error) {
    problems.push_back((key.empty() ? "" : quoted(key) + ": ") + error.what());
  }
}
// Returns the index of the word.
std::optional<std::size_t> read_word(const Argument& value, const OptionInfo& info,
                                     const std::vector<std::string>& words, Problems& problems);
// Reads {a, b}: calls read(part, first) for both.
template <class Read>
void read_pair(const Argument& value, const OptionInfo& info, std::string_view wanted, Problems& problems,
               Read read) {
  if (!value.is_table() || value.length() != 2) return wrong_type(value, info, wanted, problems);
  value.elements([&](const Argument& part, std::int64_t k) { read(part, k == 1); });
}
// Script text: "250 um", 0.02, math.huge.
std::string number_text(double value, Dimension dimension);
// Calls read(index, value) for known keys; reports unknown and missing keys.
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

template <class O>
struct Option {
  OptionInfo info;
  Held<void(const Argument&, const OptionInfo&, O&, Problems&)> read;
  // Script text, "" for none; may be null. For defaults and record.
  Held<std::string(const O&)> show;

  Option() = default;
  template <class Base>
  requires(std::derived_from<O, Base> && !std::same_as<O, Base>) Option(Option<Base> base)
      : info(std::move(base.info)), read(std::move(base.read)) {
    if (base.show) show = std::move(base.show);
  }

  Option required() && {
    info.required = true;
    return std::move(*this);
  }
  Option shown_by(Held<std::string(const O&)> text) && {
    show = std::move(text);
    return std::move(*this);
  }
  // For a default outside the struct ("size", "roll_off = long_wave").
  Option defaults_to(std::string text) && {
    info.default_text = std::move(text);
    return std::move(*this);
  }
};

template <class O>
class Block final : public BlockInfo {
 public:
  // `whole` checks the struct after reading without problems.
  using Check = void (*)(O&, Problems&);

  Block(std::vector<Option<O>> options, Check whole = nullptr) : options_(std::move(options)), check_(whole) {
    const O defaults{};
    for (Option<O>& option : options_)
      if (!option.info.required && option.info.default_text.empty() && option.show)
        option.info.default_text = option.show(defaults);
  }

  std::vector<const OptionInfo*> options() const override {
    std::vector<const OptionInfo*> infos;
    for (const Option<O>& option : options_) infos.push_back(&option.info);
    return infos;
  }

  // Throws one Error with all problems. Nil reads as an empty table. `resolved` receives all effective
  // values.
  O read(const Argument& table, const std::string& caller, Resolved* resolved = nullptr) const {
    O result{};
    bool placeholders = false;
    detail::read_table(
        table, caller, options(),
        [&](std::size_t k, const Argument& value, Problems& problems) {
          if (value.is_unknown()) {
            placeholders = true;
            if (value.as_any_object() == nullptr) return;
          }
          options_[k].read(value, options_[k].info, result, problems);
        },
        [&](Problems& problems) {
          if (check_ != nullptr && !placeholders) check_(result, problems);
        });
    if (resolved != nullptr) {
      const Resolved values = this->resolved(result);
      resolved->insert(resolved->end(), values.begin(), values.end());
    }
    return result;
  }

  Resolved resolved(const O& values) const {
    Resolved all;
    for (const Option<O>& option : options_)
      if (option.show)
        if (std::string text = option.show(values); !text.empty()) all.emplace_back(option.info.name, text);
    return all;
  }

  void check(const Argument& table, const std::string& caller) const override { (void)read(table, caller); }

 private:
  std::vector<Option<O>> options_;
  Check check_;
};

// `read` appends problems that begin with quoted(info.name).
template <class O, class Read>
Option<O> custom(StaticText name, StaticText type, StaticText sentence, Read read) {
  Option<O> option;
  option.info = {name, type, {}, "", "", sentence, false};
  option.read = std::move(read);
  return option;
}

// `read` takes the member in place of the struct.
template <class O, class M, class Read>
Option<O> custom(StaticText name, StaticText type, StaticText sentence, M O::*member, Read read) {
  return custom<O>(name, type, sentence,
                   [member, read](const Argument& value, const OptionInfo& info, O& options,
                                  Problems& problems) { read(value, info, options.*member, problems); });
}

// A plain number for dimension::number. Member: double or optional<double>.
template <class O, class M>
Option<O> quantity(StaticText name, M O::*member, Dimension dimension, NumberRange range,
                   StaticText sentence) {
  auto option = custom<O>(
      name, dimension == dimension::number ? "number" : describe(dimension), sentence,
      [member, range](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
        if (auto number = detail::read_quantity(value, info, range, problems))
          detail::assign(options.*member, *number);
      });
  option.info.dimension = dimension;
  option.info.range_text = range.text(dimension);
  option.show = [member, dimension](const O& options) -> std::string {
    const auto value = detail::shown(options.*member);
    return value ? detail::number_text(*value, dimension) : "";
  };
  return option;
}

template <class O, class M>
Option<O> number(StaticText name, M O::*member, NumberRange range, StaticText sentence) {
  return quantity<O>(name, member, dimension::number, range, sentence);
}

template <class O, class M>
Option<O> integer(StaticText name, M O::*member, NumberRange range, StaticText sentence) {
  auto option = custom<O>(
      name, "integer", sentence,
      [member, range](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
        if (auto number = detail::read_integer(value, info, range, problems))
          detail::assign(options.*member, *number);
      });
  option.info.range_text = range.text({});
  option.show = [member](const O& options) -> std::string {
    const auto value = detail::shown(options.*member);
    return value ? format_exact(*value) : "";
  };
  return option;
}

// Member: bool, or optional<bool>, which stays unrecorded.
template <class O, class M>
Option<O> flag(StaticText name, M O::*member, StaticText sentence) {
  auto option =
      custom<O>(name, "boolean", sentence,
                [member](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
                  if (value.is_boolean())
                    options.*member = value.boolean();
                  else
                    detail::wrong_type(value, info, "true or false", problems);
                });
  if constexpr (std::same_as<M, bool>)
    option.show = [member](const O& options) { return std::string(options.*member ? "true" : "false"); };
  return option;
}

// Member: std::string or optional<std::string>.
template <class O, class M>
Option<O> text(StaticText name, M O::*member, StaticText sentence) {
  return custom<O>(name, "string", sentence,
                   [member](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
                     if (value.is_text())
                       options.*member = std::string(value.text());
                     else
                       detail::wrong_type(value, info, "a string", problems);
                   });
}

template <class O, class M>
Option<O> choice(StaticText name, M O::*member,
                 std::vector<std::pair<std::string, std::type_identity_t<M>>> words, StaticText sentence) {
  std::string type;
  std::vector<std::string> names;
  for (const auto& [word, value] : words) {
    type += (type.empty() ? "" : "|") + ("\"" + word + "\"");
    names.push_back(word);
  }
  auto option = custom<O>(
      name, type, sentence,
      [member, words, names](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
        if (const auto place = detail::read_word(value, info, names, problems))
          options.*member = words[*place].second;
      });
  option.show = [member, words](const O& options) -> std::string {
    for (const auto& [word, value] : words)
      if (value == options.*member) return "\"" + word + "\"";
    return "";
  };
  return option;
}

// In the record: digest or name.
template <class T>
std::string digest_text(const T& value) {
  if constexpr (requires { value.digest(); })
    return std::string(value.digest());
  else if constexpr (requires { value.name; })
    return value.name;
  else
    return "";
}

// Member: std::optional<T> or std::shared_ptr<const T>.
template <class T, class O, class M>
Option<O> native(StaticText name, M O::*member, StaticText type, StaticText wanted, StaticText sentence) {
  auto option = custom<O>(
      name, type, sentence,
      [member, wanted](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
        Object* object = value.as_object(class_of<T>());
        if (object == nullptr) return detail::wrong_type(value, info, wanted, problems);
        if (object->closed) return problems.push_back(quoted(info.name) + " was closed");
        if (object->pointer == nullptr) return;  // of a dry run
        if constexpr (requires(const M& m) { m.get(); })
          options.*member = std::static_pointer_cast<T>(object->pointer);
        else
          options.*member = *static_cast<const T*>(object->pointer.get());
      });
  option.show = [member](const O& options) -> std::string {
    return options.*member ? digest_text(*(options.*member)) : "";
  };
  return option;
}

// A list of at least `least` whole numbers from 1 to `most`.
template <class O>
Option<O> integers(StaticText name, std::vector<int> O::*member, std::int64_t least, double most,
                   StaticText sentence) {
  return custom<O>(name, "integer[]", sentence,
                   [=](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
                     if (!value.is_table() || value.length() < least)
                       return detail::wrong_type(
                           value, info,
                           least > 1 ? "a list of two or more whole numbers" : "a list of whole numbers",
                           problems);
                     value.elements([&](const Argument& item) {
                       if (auto n = detail::read_integer(item, info, between(1, most), problems))
                         (options.*member).push_back(static_cast<int>(*n));
                     });
                   });
}

// The caller reads the function. `wanted`: "a function(x)".
template <class O>
Option<O> function(StaticText name, StaticText wanted, StaticText sentence) {
  return custom<O>(name, "function", sentence,
                   [wanted](const Argument& value, const OptionInfo& info, O&, Problems& problems) {
                     if (!value.is_function()) detail::wrong_type(value, info, wanted, problems);
                   });
}

// A nested table; its problems join the outer list.
template <class O, class Inner, class M>
Option<O> table_of(StaticText name, M O::*member, const Block<Inner>& inner, StaticText sentence) {
  auto option = custom<O>(
      name, "table", sentence,
      [member, &inner](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
        if (!value.is_table()) return detail::wrong_type(value, info, "a table of named keys", problems);
        detail::collect(problems, [&] { options.*member = inner.read(value, quoted(info.name)); });
      });
  option.info.inner = &inner;
  return option;
}

template <class O>
Option<O> cells_option(int O::*nx, int O::*ny) {
  auto option =
      custom<O>("cells", "integer|{integer, integer}", "cells along x and y: a number, or {nx, ny}",
                [nx, ny](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
                  constexpr NumberRange range = between(1, max_cells);
                  if (value.is_table()) {
                    detail::read_pair(value, info, "a whole number or {nx, ny}", problems,
                                      [&](const Argument& part, bool first) {
                                        if (auto n = detail::read_cells(part, info, range, problems))
                                          options.*(first ? nx : ny) = static_cast<int>(*n);
                                      });
                  } else if (auto n = detail::read_cells(value, info, range, problems)) {
                    options.*nx = options.*ny = static_cast<int>(*n);
                  }
                });
  option.info.range_text = "from 1 to " + std::to_string(max_cells);
  option.show = [nx, ny](const O& o) -> std::string {
    return o.*nx == 0 ? "" : "{" + std::to_string(o.*nx) + ", " + std::to_string(o.*ny) + "}";
  };
  return option;
}

// A length, or {along x, along y}. Members: double or optional<double>.
template <class O, class M>
Option<O> pair_option(StaticText name, M O::*x, M O::*y, Dimension dimension, NumberRange range,
                      StaticText sentence) {
  const std::string kind = describe(dimension);
  Option<O> option =
      custom<O>(name, kind + "|{" + kind + ", " + kind + "}", sentence,
                [x, y, range](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
                  if (value.is_table()) {
                    detail::read_pair(value, info, "one value or two in a list", problems,
                                      [&](const Argument& part, bool first) {
                                        if (auto v = detail::read_quantity(part, info, range, problems))
                                          detail::assign(options.*(first ? x : y), *v);
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

// For options described by the engine (core/options.hpp).
OptionInfo row_info(const OptionRow& row, const std::any& defaults);
void read_row(const OptionRow& row, const OptionInfo& info, const Argument& value, std::any& options,
              Problems& problems);

class RowBlock final : public BlockInfo {
 public:
  // `rows` must outlive the block. `defaults`: the struct without options.
  RowBlock(std::span<const OptionRow> rows, std::any defaults);

  std::vector<const OptionInfo*> options() const override { return pointers_to(infos_); }
  std::any read(const Argument& table, const std::string& caller) const;
  void check(const Argument& table, const std::string& caller) const override { (void)read(table, caller); }

 private:
  std::span<const OptionRow> rows_;
  std::any defaults_;
  std::vector<OptionInfo> infos_;
};

}  // namespace asperity::lua

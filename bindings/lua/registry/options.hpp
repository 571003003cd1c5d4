// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds of options for a block (block.hpp). Each kind reads one key into one member of a plain struct.
#pragma once

#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings/lua/registry/block.hpp"
#include "engine/core/error.hpp"
#include "engine/core/grid.hpp"
#include "engine/core/options.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

// A quantity, or a plain number for dimension::number. Member: double or optional<double>.
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
    return detail::number_text(*value, dimension);
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

// Member: std::string or optional<std::string>.
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
    if (const auto place = detail::read_word(value, info, names, problems))
      options.*member = words[*place].second;
  };
  option.show = [member, words](const O& options) -> std::string {
    for (const auto& [word, value] : words)
      if (value == options.*member) return "\"" + word + "\"";
    return "";
  };
  return option;
}

// Text of a native value in the record: digest or name.
template <class T>
std::string digest_text(const T& value) {
  if constexpr (requires { value.digest(); })
    return std::string(value.digest());
  else if constexpr (requires { value.name; })
    return value.name;
  else
    return "";
}

// Member: T, std::optional<T> or std::shared_ptr<const T>.
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
    if (object->pointer == nullptr) return;  // of a dry run
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

// Any option: `read` appends problems that begin with quoted(info.name).
template <class O, class Read>
Option<O> custom(std::string name, std::string type, std::string sentence, Read read) {
  Option<O> option;
  option.info = {std::move(name), std::move(type), {}, "", "", std::move(sentence), false};
  option.read = std::move(read);
  return option;
}

// A nested table with its own block; its problems join the outer list.
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

template <class O>
Option<O> cells_option(int O::*nx, int O::*ny) {
  auto option =
      custom<O>("cells", "integer|{integer, integer}", "cells along x and y: a number, or {nx, ny}",
                [nx, ny](const Argument& value, const OptionInfo& info, O& options, Problems& problems) {
                  constexpr NumberRange range = between(1, max_cells);
                  if (value.is_table() && value.length() == 2) {
                    for (int k = 1; k <= 2; ++k)
                      value.element(k, [&](const Argument& part) {
                        if (auto n = detail::read_cells(part, info, range, problems))
                          options.*(k == 1 ? nx : ny) = static_cast<int>(*n);
                      });
                  } else if (value.is_table()) {
                    detail::wrong_type(value, info, "a whole number or {nx, ny}", problems);
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

}  // namespace asperity::lua

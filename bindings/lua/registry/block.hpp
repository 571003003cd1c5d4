// SPDX-License-Identifier: GPL-3.0-or-later
// A block of named options: name, dimension, default, range and sentence of each key. The block reads a Lua
// table into a plain C++ struct and reports all problems in one Error: unknown keys with the nearest name,
// missing keys, wrong types, units and ranges. help(), editor types, reference and journal use the same
// description. options.hpp has the kinds of options.
//
//   Block<CutKeys>{"cut", {number("fraction", &CutKeys::fraction, between(0, 1), "of the height")}};
#pragma once

#include <concepts>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/registry/argument.hpp"
#include "engine/core/error.hpp"
#include "engine/core/options.hpp"
#include "engine/core/quantity.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

class BlockInfo;

struct OptionInfo {
  std::string name;
  std::string type;  // "length", "number", "integer", "string", "boolean", "Surface", "\"all\"|\"resolved\""
  Dimension dimension{};
  std::string default_text;  // as written in a script; "" if none
  std::string range_text;    // "above 0"; may be empty
  std::string sentence;
  bool required = false;
  const BlockInfo* inner = nullptr;  // block of a nested table
};

class BlockInfo {
 public:
  virtual ~BlockInfo() = default;
  virtual const std::string& name() const = 0;
  virtual std::vector<const OptionInfo*> options() const = 0;
  // Whether the argument is a list of such tables.
  virtual bool is_list() const { return false; }
  // Reads and discards the options, for a dry run. Throws like read().
  virtual void check(const Argument& table, const std::string& caller) const = 0;
};

using Resolved = std::vector<std::pair<std::string, std::string>>;

using Problems = std::vector<std::string>;

// The new name after a renaming, else the nearest of `names`, else "".
std::string meant_by(std::string_view name, std::span<const std::string> names);

namespace detail {
// On failure, these append a problem and return nothing.
std::optional<double> read_quantity(const Argument& value, const OptionInfo& info, const NumberRange& range,
                                    Problems& problems);
std::optional<std::int64_t> read_integer(const Argument& value, const OptionInfo& info,
                                         const NumberRange& range, Problems& problems);
// Scaled during an accuracy study (refinement.hpp).
std::optional<std::int64_t> read_cells(const Argument& value, const OptionInfo& info,
                                       const NumberRange& range, Problems& problems);
void wrong_type(const Argument& value, const OptionInfo& info, std::string_view wanted, Problems& problems);
// Returns the index of the word.
std::optional<std::size_t> read_word(const Argument& value, const OptionInfo& info,
                                     const std::vector<std::string>& words, Problems& problems);
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
  std::function<void(const Argument&, const OptionInfo&, O&, Problems&)> read;
  // Script text of the value, "" for none; may be null. For defaults and the record.
  std::function<std::string(const O&)> show;

  Option() = default;
  template <class Base>
  requires(std::derived_from<O, Base> && !std::same_as<O, Base>) Option(Option<Base> base)
      : info(std::move(base.info)), read(std::move(base.read)), show(std::move(base.show)) {}

  Option required() && {
    info.required = true;
    return std::move(*this);
  }
  Option shown_by(std::function<std::string(const O&)> text) && {
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
  // `whole` checks the struct if all keys were read without a problem.
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
  std::string name_;
  std::vector<Option<O>> options_;
  Check check_;
};

}  // namespace asperity::lua

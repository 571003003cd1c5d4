// SPDX-License-Identifier: GPL-3.0-or-later
// Declarations of the language: all functions, classes, modules and types of results. They drive calls, "did
// you mean", help(), editor types, the reference page and the dry run.
#pragma once

#include <concepts>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bindings/lua/registry/value.hpp"
#include "engine/core/text.hpp"

namespace asperity {
class Ledger;
}

namespace asperity::lua {

class BlockInfo;

using Body = Values (*)(Call&);

struct Parameter {
  StaticText name{};
  StaticText type{};  // "number", "Surface", "function"; a trailing "?": optional
  StaticText sentence{};
};

// A table below a function in help and reference; a row begins with its name.
struct Listing {
  StaticText title{};
  std::vector<std::string> columns{};
  std::vector<std::vector<std::string>> rows{};
};

// The last argument, a table of named keys; none if null.
struct OptionTable {
  OptionTable(const BlockInfo* keys = nullptr, bool may_be_missing = false)
      : block(keys), optional(may_be_missing) {}
  operator const BlockInfo*() const { return block; }
  const BlockInfo* operator->() const { return block; }
  const BlockInfo* block;
  bool optional;
};
inline OptionTable optional(const BlockInfo& keys) { return {&keys, true}; }

struct Function {
  StaticText name{};
  Body body = nullptr;
  StaticText sentence{};
  std::vector<Parameter> parameters{};
  OptionTable options{};
  // "State", "number", "Profile[]", "Roughness" (a record), "iterator<State>", "number, string", "" for none
  StaticText returns{};
  StaticText example{};  // required; runs after example_preamble()
  bool heavy = false;    // skipped by `asperity check`
  // Skipped by `asperity check` because the result depends on rows unknown to a dry run. Not in the journal.
  bool unknown_when_dry = false;
  Listing (*listing)() = nullptr;
  // In a dry run, for arguments with placeholders, after the options; may be null.
  void (*look)(const Call& call) = nullptr;
  // In a dry run, checks the columns given to :table of the returned iterator; null without :table.
  void (*look_at_table)(const Call& call) = nullptr;
};

// "a, b" as "a" and "b".
std::vector<std::string_view> parts_of(std::string_view text, std::string_view separator);
std::vector<std::string> result_types(const Function& function);
// "Profile[] with tip_effect: TipEffect and lines: Traverse[]".
std::vector<std::pair<std::string_view, std::string_view>> named_fields(std::string_view type);

struct Getter {
  StaticText name{};
  StaticText type{};
  StaticText sentence{};
  Dimension dimension{};
  Body body = nullptr;
};

struct RecordInfo {
  StaticText name{};   // "ArealRoughness": in declared types
  StaticText title{};  // "roughness": in print() and errors
  StaticText sentence{};
  std::vector<Getter> fields{};
};

struct Operator {
  StaticText event{};    // "__sub"
  StaticText form{};     // "a - b", for errors and help
  StaticText operand{};  // "Surface|number"; "" if unary
  StaticText sentence{};
  StaticText returns{};
  StaticText example{};
  Body body = nullptr;  // both operands; a unary operand twice
};

struct Class {
  StaticText name{};          // "Surface"
  StaticText article_name{};  // "a surface"
  StaticText sentence{};
  std::vector<Getter> fields{};
  StaticText drawing{};  // text drawing in the reference
  std::vector<Function> methods{};
  std::vector<Operator> operators{};
  std::vector<const RecordInfo*> results{};
  bool iterates_numbers = false;                              // pairs() gives number fields
  bool shareable = true;                                      // immutable; cases may share the value
  std::int64_t (*length)(const void* self) = nullptr;         // may be null
  Value (*item)(const void* self, std::int64_t k) = nullptr;  // t[k], nil beyond the end; may be null
  std::string (*describe)(const void* self) = nullptr;
  std::size_t (*native_bytes)(const void* self) = nullptr;  // memory invisible to Lua
  bool (*equal)(const void* a, const void* b) = nullptr;
  std::string (*digest)(const void* self) = nullptr;  // of the content, for the journal
  // Adds costs to the ledger by effect, for results and turns. May be null.
  void (*enter)(const void* self, Ledger& ledger) = nullptr;
  void (*closing)(void* self) = nullptr;  // called before :close() and <close>
  // For a dry run; may be null.
  std::shared_ptr<const KnownBody> (*known)(const Call& call, const Function& function) = nullptr;
  std::vector<std::string> names() const;
};

// Appends elements and whole lists to a list of a class or module.
template <class T, class... More>
void append(std::vector<T>& list, const More&... more) {
  const auto add = [&](const auto& one) {
    if constexpr (std::convertible_to<decltype(one), T>)
      list.push_back(one);
    else
      list.insert(list.end(), one.begin(), one.end());
  };
  (add(more), ...);
}

template <class T>
const Class& class_of() {
  static const Class type = make_class(For<T>{});
  return type;
}

struct Constant {
  StaticText name{};
  StaticText type{};
  StaticText sentence{};
  Value (*value)() = nullptr;
};

struct Module {
  StaticText path{};  // "lab.surface"
  StaticText sentence{};
  std::vector<Function> functions{};
  std::vector<Constant> constants{};
  std::vector<const RecordInfo*> results{};
  // For lab.protocol{...} itself.
  std::optional<Function> call{};
};

// Last part of a submodule's path, or "".
std::string_view name_within(const Module& outer, const Module& inner);
// "lab" first, parents before children.
const std::vector<const Module*>& modules();
const std::vector<const Class*>& classes();
const Class* find_class(std::string_view name);

// With any class, and full name: "lab.surface.sine", "surface:scaled".
struct NamedFunction {
  const Function* function = nullptr;
  const Class* owner = nullptr;
  std::string name;
};
const NamedFunction& entry_of(const Function& function);
const std::string& qualified_name(const Function& function);
// The name of the function whose closures have this upvalue; null if none.
const std::string* name_of_entry(const void* pointer);

// In the results of modules and classes, each once.
const std::vector<const RecordInfo*>& record_types();
const RecordInfo* find_record_type(std::string_view name);
// "iterator<ProtocolEvent and State?>", "table<string, Cost>".
std::vector<const RecordInfo*> record_types_in(std::string_view type);

// Throws Error{internal} unless the record, or a list's first record, has the declared type.
void check_declared(std::string_view giver, std::string_view declared, const Value& given);

// As print: a record on one line, with units.
std::string show(const Value& value);
std::string show(const Record::Entry& entry);

}  // namespace asperity::lua

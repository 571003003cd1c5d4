// SPDX-License-Identifier: GPL-3.0-or-later
// A Lua value outside any state: a graph of tables, functions and native values. States get fresh copies with
// shared tables, upvalues and cycles preserved; native values are shared. Filled by pack() (transfer.hpp),
// then immutable and thread-safe.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/registry/value.hpp"
#include "bindings/lua/runtime/base_library.hpp"
#include "engine/core/memory.hpp"

namespace asperity::lua {

struct Module;

// For errors: ".bench", "[\"two words\"]".
std::string step_text(std::string_view key);

class PackedValue final : public StoredValue {
 public:
  // Leaves a copy on the stack and adds the script's globals and changes to Lua's tables. Functions need a
  // state of make_state. Linear. Raises if out of memory: call inside protect().
  void push(lua_State* L) const override;

  // Data only: equal for equal values, in any order of keys.
  std::string digest() const;

  // Data as bytes, restored bit for bit by any process of this build; native values in `given` become
  // references. Includes profiles, materials, and surfaces without a generator. Linear. bytes() throws
  // Error{not_permitted} for other values, with the path from `name`; from_bytes() throws Error{bad_file}.
  std::string bytes(const std::string& name, const std::vector<Value>& given = {}) const;
  static std::shared_ptr<const PackedValue> from_bytes(std::string_view bytes,
                                                       const std::vector<Value>& given = {});
  // Null unless a native value.
  const Value* native() const;

  // Identifies data and function behaviour in all processes of this build: code without file names and lines,
  // upvalues, globals. Excluded if equal to `spelling`: the `require` folder, and the script's name in
  // `arg[0]` unless a function uses `arg`.
  struct Content {
    std::string digest;
    std::string lines;  // with line numbers
    bool whole = true;  // false: values without a digest
  };
  Content content(const ScriptSpelling& spelling = {}) const;

  // Globals that cannot be packed: name -> "`app.bench` is a contact".
  const std::map<std::string, std::string>& left_behind() const { return left_behind_; }

 private:
  friend class Packer;

  struct NodeId {
    std::uint32_t index;
  };
  struct BaseId {
    std::uint32_t index;
  };
  using Item = std::variant<std::monostate, bool, std::int64_t, double, std::string, NodeId, BaseId,
                            const Module*, lua_CFunction, void*, Unknown>;

  struct Entry {
    Item key, value;
  };
  struct Table {
    std::uint32_t length = 0;  // of the part 1..n
    Array<Entry> entries;
    Item metatable;
  };
  // Code as dumped by Lua.
  struct ScriptFunction {
    std::string code;
    std::vector<std::uint32_t> cells;
  };
  struct HostFunction {
    lua_CFunction function;
    std::vector<Item> upvalues;
  };
  using Node = std::variant<Table, ScriptFunction, HostFunction, Value>;
  // Its first function's node and upvalue index.
  struct Cell {
    Item value;
    std::uint32_t node;
    int upvalue;
  };
  struct Addition {
    BaseId table;
    Entry entry;
  };

  // Numbers in order, then strings, then the rest.
  static bool before(const Entry& a, const Entry& b);
  static Array<Entry> in_order(Array<Entry> entries);

  struct Pusher;
  struct Writer;
  struct Reader;
  struct ContentDigest;

  Item root_;
  std::vector<Node> nodes_;
  std::vector<Cell> cells_;
  std::vector<BasePath> bases_;
  std::vector<Addition> additions_;
  bool strict_globals_ = true;
  std::map<std::string, std::string> left_behind_;
};

}  // namespace asperity::lua

// SPDX-License-Identifier: GPL-3.0-or-later
// A Lua value outside any Lua state: a graph of tables, functions and native values that can be put
// into other states, as often as wanted, each time as a fresh copy. Identity is kept within one
// packed value: a table met twice is one table, local functions that share an upvalue go on sharing it,
// cycles stay cycles. Native values are shared, never copied. Packed values are filled by pack() of
// transfer.hpp and are immutable from then on; any number of threads may put one into their states.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "bindings/lua/registry/lua_api.hpp"
#include "bindings/lua/registry/script_spelling.hpp"
#include "bindings/lua/registry/value.hpp"
#include "bindings/lua/runtime/base_library.hpp"
#include "engine/core/memory.hpp"

namespace asperity::lua {

struct Module;

// How a table leads on to what it holds under a text, in the words of an error: ".bench", "[\"two words\"]".
std::string step_text(std::string_view key);

class PackedValue final : public StoredValue {
 public:
  // Makes the value in a state and leaves it on the stack; one made by make_state if functions came
  // along. What the script added to the globals and to Lua's own tables is made there too. Cost: linear
  // in the packed value. Raises on lack of memory: call inside protect().
  void push(lua_State* L) const override;

  // Of the content of data: the same for equal values, whatever the order of keys in memory.
  std::string digest() const;

  // Data as bytes, and out of them again bit for bit, in any process of this build. `given` are values that
  // both sides have at hand: a native value that is one of them is not written but named. Surfaces that are
  // no longer, or never were, those of a generator go by their heights, profiles and materials likewise.
  // Cost: linear. bytes() throws Error{not_permitted} for what bytes cannot carry, saying how it is reached
  // from `name`; from_bytes() Error{bad_file} for anything that bytes() did not write.
  std::string bytes(const std::string& name, const std::vector<Value>& given = {}) const;
  static std::shared_ptr<const PackedValue> from_bytes(std::string_view bytes,
                                                       const std::vector<Value>& given = {});
  // The native value that is the whole of it; null where it is something else.
  const Value* native() const;

  // What the value is and, of functions, what they do, the same in every process of this build: code without
  // the names of its files and lines, upvalues, globals. The folder in which `require` looks, and the
  // script's own name in `arg[0]` unless a function names `arg`, are left out where they are as `spelling`
  // says.
  struct Content {
    std::string digest;
    std::string lines;  // of the same with the numbers of its lines
    bool whole = true;  // false where it holds values that a digest does not tell from all others
  };
  Content content(const ScriptSpelling& spelling = {}) const;

  // Globals that could not come along: name -> "`app.bench` is a contact".
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
  // A function of the script: its code as Lua dumps it, and the cells its upvalues share.
  struct ScriptFunction {
    std::string code;
    std::vector<std::uint32_t> cells;
  };
  struct HostFunction {
    lua_CFunction function;
    std::vector<Item> upvalues;
  };
  using Node = std::variant<Table, ScriptFunction, HostFunction, Value>;
  // One upvalue, and the first function that has it: its node, and which of its upvalues it is.
  struct Cell {
    Item value;
    std::uint32_t node;
    int upvalue;
  };
  struct Addition {
    BaseId table;
    Entry entry;
  };

  // Numbers in their order, then strings, then the rest.
  static bool before(const Entry& a, const Entry& b);
  static Array<Entry> in_order(Array<Entry> entries);

  struct Pusher;
  struct RowDigest;
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

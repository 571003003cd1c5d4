// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/ensemble/transfer.hpp"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/embedded.hpp"
#include "bindings/lua/registry/library.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/value.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"

namespace asperity::lua {

namespace {

// Whether other threads may read a value.
struct Shareable : ValueVisitor {
  bool all = true;
  void leaf(const Object& object) { all = all && object.type->shareable && !object.closed; }
  void leaf(const std::shared_ptr<Iterator>&) { all = false; }
  void leaf(const auto&) {}
};

std::string step_of(const Argument& key) {
  if (key.is_text()) return step_text(key.text());
  if (key.is_number())
    return "[" + (key.integer() ? std::to_string(*key.integer()) : format_short(key.number())) + "]";
  return "[" + key.describe() + "]";
}

// "an open file", "an iterator": foreign userdata.
std::string kind_of_userdata(const Argument& value) {
  lua_State* L = value.state();
  const Argument::StackGuard guard(L);
  std::string name;
  if (lua_getmetatable(L, value.index()) != 0)
    with_key(Argument(L, -1), "__name", [&](const Argument& text) { name = text.text(); });
  if (name.empty()) return "state that cannot be copied";
  if (name == LUA_FILEHANDLE) return "an open file";
  const bool vowel = std::string_view("aeiou").find(name[0]) != std::string_view::npos;
  return (vowel ? "an " : "a ") + name;
}

}  // namespace

// Depth first, without recursion: a table or function in progress is a frame, with its value on the Lua
// stack.
class Packer {
 public:
  Packer(lua_State* state, PackedValue& packed, Cargo cargo, std::string name, std::string hint)
      : L(state), packed_(packed), cargo_(cargo), name_(std::move(name)), hint_(std::move(hint)) {}

  void pack_root(int index) { packed_.root_ = pack(index); }

  PackedValue::Item pack(int index) {
    const Argument::StackGuard guard(L);
    lua_pushvalue(L, index);
    PackedValue::Item root = take();
    while (!frames_.empty()) advance();
    return root;
  }

  void pack_additions() {
    with_globals([&](const Argument& globals) {
      const Argument::StackGuard guard(L);
      packed_.strict_globals_ = lua_getmetatable(L, globals.index()) != 0;
      pack_additions(globals, {"_G", ""});
      for (const std::string_view library : base_libraries)
        with_key(globals, library, [&](const Argument& table) {
          const BasePath path{std::string(library), ""};
          const BasePath* found = table.is_table() ? base_library().find(L, table.index()) : nullptr;
          if (found != nullptr && *found == path && library != "_G") pack_additions(table, path);
        });
    });
  }

 private:
  struct Frame {
    enum class Phase { begin, metatable, entries, value } phase = Phase::begin;  // of a table
    std::uint32_t node = 0;
    int index = 0;    // on the Lua stack
    int upvalue = 0;  // last read
  };

  // Pops the top of the stack as an item; a new frame pops it later.
  PackedValue::Item take() {
    if (lua_checkstack(L, 16) == 0) throw Error(ErrorCode::out_of_memory, "the Lua stack is full");
    const Argument value(L, -1);
    PackedValue::Item item;
    if (value.is_boolean())
      item = value.boolean();
    else if (lua_isinteger(L, -1) != 0)
      item = static_cast<std::int64_t>(lua_tointeger(L, -1));
    else if (value.is_number())
      item = value.number();
    else if (value.is_text())
      item = std::string(value.text());
    else if (lua_islightuserdata(L, -1))
      item = lua_touserdata(L, -1);
    else if (!value.is_nil())
      return take_object(value);
    lua_pop(L, 1);
    return item;
  }

  PackedValue::Item take_object(const Argument& value) {
    const void* identity = lua_topointer(L, -1);
    if (const auto known = seen_.find(identity); known != seen_.end())
      return popped(PackedValue::NodeId{known->second});
    if (const BasePath* path = base_library().find(L, -1)) {
      if (cargo_ == Cargo::data) refuse("a part of Lua's library");
      return popped(base(*path));
    }
    if (value.is_table()) {
      const Module* module = module_at(L, -1);
      if (module != nullptr && cargo_ == Cargo::data) refuse("a part of the laboratory");
      if (module != nullptr) return popped(module);
      const auto length = std::min<lua_Unsigned>(lua_rawlen(L, -1), lua_Unsigned{1} << 26);
      return open(identity, PackedValue::Table{static_cast<std::uint32_t>(length), {}, {}});
    }
    if (value.is_function()) {
      if (cargo_ == Cargo::data) refuse("a function");
      return lua_iscfunction(L, -1) != 0 ? take_host_function(identity) : take_function(identity);
    }
    if (lua_type(L, -1) == LUA_TUSERDATA) return take_userdata(identity, value);
    refuse(value.describe());
  }

  PackedValue::Item take_function(const void* identity) {
    PackedValue::ScriptFunction function;
    if (lua_dump(L, append_code, &function.code, 0) != 0)
      throw Error(ErrorCode::out_of_memory, "there is no memory for the code of a function");
    return open(identity, std::move(function));
  }

  PackedValue::Item take_host_function(const void* identity) {
    const lua_CFunction function = lua_tocfunction(L, -1);
    const bool has_state = lua_getupvalue(L, -1, 1) != nullptr;
    if (has_state) lua_pop(L, 1);
    // A case has its own print for ordered output, and its own loops in fixed order.
    const BasePath* path = base_function(function);
    const auto own = [path](const char* name) { return *path == BasePath{"_G", name}; };
    if (path != nullptr && (has_state || own("print") || own("pairs") || own("next")))
      return popped(base(*path));
    if (!has_state) return popped(function);
    return open(identity, PackedValue::HostFunction{function, {}});
  }

  PackedValue::Item take_userdata(const void* identity, const Argument& value) {
    if (const Object* object = value.as_any_object()) {
      if (object->closed) refuse(object->type->article_name + " that was closed");
      if (!object->type->shareable) refuse(object->type->article_name);
      return popped(add_node(identity, Value(*object)));
    }
    if (value.is_unknown()) return popped(Unknown{});
    if (auto record = record_at(L, -1)) {
      Value whole;
      whole.data = std::move(record);
      Shareable shareable;
      visit_value(whole, shareable);
      if (!shareable.all) refuse("a result that holds something of its own state");
      return popped(add_node(identity, std::move(whole)));
    }
    refuse(kind_of_userdata(value));
  }

  // On demand: most packed values are numbers.
  const BaseLibrary& base_library() {
    if (!base_library_) base_library_.emplace(L);
    return *base_library_;
  }

  template <class T>
  PackedValue::Item popped(T item) {
    lua_pop(L, 1);
    return PackedValue::Item(std::move(item));
  }

  PackedValue::NodeId add_node(const void* identity, PackedValue::Node node) {
    const auto index = static_cast<std::uint32_t>(packed_.nodes_.size());
    packed_.nodes_.push_back(std::move(node));
    seen_.emplace(identity, index);
    order_.push_back(identity);
    return {index};
  }

  PackedValue::Item open(const void* identity, PackedValue::Node node) {
    const PackedValue::NodeId id = add_node(identity, std::move(node));
    frames_.push_back({Frame::Phase::begin, id.index, lua_gettop(L), 0});
    return id;
  }

  void close() {
    lua_settop(L, frames_.back().index - 1);
    frames_.pop_back();
  }

  PackedValue::BaseId base(const BasePath& path) {
    const auto found = std::find(packed_.bases_.begin(), packed_.bases_.end(), path);
    const auto index = static_cast<std::uint32_t>(found - packed_.bases_.begin());
    if (found == packed_.bases_.end()) packed_.bases_.push_back(path);
    return {index};
  }

  // Reads the next part of the innermost frame. take() may invalidate references by adding a frame.
  void advance() {
    const std::uint32_t node = frames_.back().node;
    if (std::holds_alternative<PackedValue::Table>(packed_.nodes_[node]))
      advance_table(node);
    else
      advance_function(node);
  }

  void advance_table(std::uint32_t node) {
    const auto table = [&]() -> PackedValue::Table& {
      return std::get<PackedValue::Table>(packed_.nodes_[node]);
    };
    const std::size_t depth = frames_.size();
    const int index = frames_.back().index;
    PackedValue::Item item;
    switch (frames_.back().phase) {
      case Frame::Phase::begin:
        frames_.back().phase = Frame::Phase::entries;
        if (lua_getmetatable(L, index) == 0) {
          lua_pushnil(L);
          return;
        }
        if (cargo_ == Cargo::data) refuse("a table with a metatable", true);
        frames_.back().phase = Frame::Phase::metatable;
        item = take();
        table().metatable = std::move(item);
        return;
      case Frame::Phase::metatable:
        frames_.back().phase = Frame::Phase::entries;
        lua_pushnil(L);
        return;
      case Frame::Phase::entries:
        while (lua_next(L, index) != 0) {
          if (cargo_ == Cargo::data && lua_type(L, -2) != LUA_TNUMBER && lua_type(L, -2) != LUA_TSTRING &&
              lua_type(L, -2) != LUA_TBOOLEAN)
            refuse("under a key that is " + Argument(L, -2).describe());
          lua_pushvalue(L, -2);
          item = take();
          table().entries.push_back({std::move(item), {}});
          if (frames_.size() != depth) {
            frames_[depth - 1].phase = Frame::Phase::value;
            return;
          }
          item = take();
          table().entries.back().value = std::move(item);
          if (frames_.size() != depth) return;
        }
        close();
        return;
      case Frame::Phase::value:
        frames_.back().phase = Frame::Phase::entries;
        item = take();
        table().entries.back().value = std::move(item);
        return;
    }
  }

  void advance_function(std::uint32_t node) {
    const std::size_t depth = frames_.size();
    const bool script = std::holds_alternative<PackedValue::ScriptFunction>(packed_.nodes_[node]);
    while (frames_.size() == depth) {
      const int index = frames_.back().index;
      const int upvalue = ++frames_.back().upvalue;
      if (lua_getupvalue(L, index, upvalue) == nullptr) return close();
      if (!script) {
        PackedValue::Item item = take();
        std::get<PackedValue::HostFunction>(packed_.nodes_[node]).upvalues.push_back(std::move(item));
        continue;
      }
      const void* identity = lua_upvalueid(L, index, upvalue);
      const auto [known, is_new] =
          cell_of_.try_emplace(identity, static_cast<std::uint32_t>(packed_.cells_.size()));
      const std::uint32_t cell = known->second;
      std::get<PackedValue::ScriptFunction>(packed_.nodes_[node]).cells.push_back(cell);
      if (!is_new) {
        lua_pop(L, 1);
        continue;
      }
      cell_order_.push_back(identity);
      packed_.cells_.push_back({{}, node, upvalue});
      PackedValue::Item item = take();
      packed_.cells_[cell].value = std::move(item);
    }
  }

  // "`run` uses the upvalue `app.bench`, which is a contact"
  [[noreturn]] void refuse(const std::string& kind, bool the_table_itself = false) const {
    std::vector<std::string> chain = {name_};
    bool held_by_host = false;
    const std::size_t steps = frames_.size() - (the_table_itself ? 1 : 0);
    for (std::size_t k = 0; k < steps; ++k) {
      const Frame& frame = frames_[k];
      held_by_host = false;
      if (!lua_isfunction(L, frame.index)) {
        chain.back() += frame.phase == Frame::Phase::metatable ? std::string("'s metatable")
                                                               : step_of(Argument(L, frame.index + 1));
        continue;
      }
      held_by_host = lua_iscfunction(L, frame.index) != 0;
      if (held_by_host) continue;
      const Argument::StackGuard guard(L);
      chain.emplace_back(lua_getupvalue(L, frame.index, frame.upvalue));
    }
    std::string text = quoted(chain[0]);
    for (std::size_t k = 1; k < chain.size(); ++k)
      text += (k == 1 ? " uses the upvalue " : ", which uses the upvalue ") + quoted(chain[k]);
    const std::string verb = held_by_host ? "holds " : "is ";
    throw Error(ErrorCode::not_permitted, text + (chain.size() > 1 ? ", which " : " ") + verb + kind, hint_);
  }

  template <class Use>
  void with_globals(Use&& use) {
    const Argument::StackGuard guard(L);
    lua_rawgeti(L, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
    use(Argument(L, -1));
  }

  void pack_additions(const Argument& table, const BasePath& path) {
    table.each([&](const Argument& key, const Argument& value) {
      if (!key.is_text() && !key.is_number()) return;
      if (is_original(value, path.library, key)) return;
      const std::size_t nodes = packed_.nodes_.size(), cells = packed_.cells_.size();
      name_ = path.library + step_of(key);
      if (path.library == "_G") name_.erase(0, name_.starts_with("_G.") ? 3 : 2);
      try {
        PackedValue::Item item = pack(value.index());
        PackedValue::Item name = key.is_text()   ? PackedValue::Item(std::string(key.text()))
                                 : key.integer() ? PackedValue::Item(*key.integer())
                                                 : PackedValue::Item(key.number());
        packed_.additions_.push_back({base(path), {std::move(name), std::move(item)}});
      } catch (const Error& error) {
        if (error.code() != ErrorCode::not_permitted) throw;
        forget(nodes, cells);
        if (path.library == "_G" && key.is_text()) packed_.left_behind_.emplace(key.text(), error.sentence());
      }
    });
  }

  // As in a fresh state.
  bool is_original(const Argument& value, const std::string& library, const Argument& key) {
    if (!key.is_text()) return false;
    const BasePath own{library, std::string(key.text())};
    if (value.is_function()) {
      if (is_sandbox_function(L, value.index())) return true;
      const BasePath* path = base_function(lua_tocfunction(L, value.index()));
      return path != nullptr && *path == own;
    }
    const BasePath* path = base_library().find(L, value.index());
    return path != nullptr && (*path == own || (library == "_G" && *path == BasePath{own.key, ""}));
  }

  // Removes nodes and cells beyond these numbers.
  void forget(std::size_t nodes, std::size_t cells) {
    frames_.clear();
    for (; order_.size() > nodes; order_.pop_back()) seen_.erase(order_.back());
    for (; cell_order_.size() > cells; cell_order_.pop_back()) cell_of_.erase(cell_order_.back());
    packed_.nodes_.resize(nodes, PackedValue::Node(Value()));
    packed_.cells_.resize(cells);
  }

  lua_State* L;
  PackedValue& packed_;
  Cargo cargo_;
  std::string name_, hint_;
  std::optional<BaseLibrary> base_library_;
  std::vector<Frame> frames_;
  std::unordered_map<const void*, std::uint32_t> seen_, cell_of_;
  std::vector<const void*> order_, cell_order_;
};

std::shared_ptr<const PackedValue> pack(lua_State* L, int index, Cargo cargo, const std::string& name,
                                        const std::string& hint) {
  auto packed = std::make_shared<PackedValue>();
  Packer packer(L, *packed, cargo, name, hint);
  packer.pack_root(index);
  if (cargo == Cargo::functions) packer.pack_additions();
  return packed;
}

}  // namespace asperity::lua

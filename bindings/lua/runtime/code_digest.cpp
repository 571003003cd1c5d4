// SPDX-License-Identifier: GPL-3.0-or-later
// Layout of ldump.c of Lua 5.4: a header, then nested functions, each with debug information at its end.
#include "bindings/lua/runtime/code_digest.hpp"

#include <cstddef>
#include <cstdint>

#include "bindings/lua/registry/lua_api.hpp"
#include "engine/core/digest.hpp"

namespace asperity::lua {

namespace {

struct NotUnderstood {};

class Code {
 public:
  Code(std::string_view dump, CodeLines lines, Digester& digester)
      : left_(dump), counted_(lines == CodeLines::counted), digester_(digester) {}

  void all() {
    // signature, version, format, check of conversions, sizes of three types, an integer, a number
    constexpr std::size_t header = 4 + 1 + 1 + 6 + 3 + sizeof(lua_Integer) + sizeof(lua_Number);
    keep(header + 1);  // the number of upvalues
    function(0);
    if (!left_.empty()) throw NotUnderstood{};
  }

 private:
  static constexpr std::size_t instruction = 4;
  static constexpr int deepest = 200;  // of nested functions: Lua's limit

  std::string_view bytes(std::size_t length) {
    if (length > left_.size()) throw NotUnderstood{};
    const std::string_view result = left_.substr(0, length);
    left_.remove_prefix(length);
    return result;
  }
  void keep(std::size_t length) { digester_.add(bytes(length)); }
  // Seven bits per byte, highest first; the last byte is marked.
  std::size_t size() {
    std::size_t value = 0;
    for (;;) {
      const auto byte = static_cast<unsigned char>(bytes(1)[0]);
      if (value > (std::size_t{1} << 48)) throw NotUnderstood{};
      value = (value << 7) | (byte & 0x7fU);
      if ((byte & 0x80U) != 0) return value;
    }
  }
  std::size_t count() {
    const std::size_t value = size();
    digester_.add(static_cast<std::int64_t>(value));
    return value;
  }
  std::string_view text() {
    const std::size_t length = size();
    return length == 0 ? std::string_view() : bytes(length - 1);
  }

  void line() {
    const std::size_t value = size();
    if (counted_) digester_.add(static_cast<std::int64_t>(value));
  }

  void constant() {
    const std::string_view kind = bytes(1);
    digester_.add(kind);
    switch (kind[0]) {
      case LUA_TNIL:
      case LUA_TBOOLEAN:
      case LUA_TBOOLEAN | 0x10:
        return;
      case LUA_TNUMBER:
        return keep(sizeof(lua_Integer));
      case LUA_TNUMBER | 0x10:
        return keep(sizeof(lua_Number));
      case LUA_TSTRING:
      case LUA_TSTRING | 0x10:
        digester_.add(text());
        return;
      default:
        throw NotUnderstood{};
    }
  }

  void function(int depth) {
    if (depth > deepest) throw NotUnderstood{};
    text();  // file
    line();  // first and last line
    line();
    keep(3);  // parameters, varargs, stack size
    const std::size_t instructions = count();
    if (instructions > left_.size() / instruction) throw NotUnderstood{};
    keep(instructions * instruction);
    for (std::size_t left = count(); left > 0; --left) constant();
    for (std::size_t left = count(); left > 0; --left) keep(3);  // sources of upvalues
    for (std::size_t left = count(); left > 0; --left) function(depth + 1);
    const std::string_view steps = bytes(size());  // lines of instructions
    if (counted_) digester_.add(steps);
    for (std::size_t left = size(); left > 0; --left) {
      line();
      line();
    }
    for (std::size_t left = size(); left > 0; --left) {  // local variables
      text();
      size();
      size();
    }
    for (std::size_t left = size(); left > 0; --left) text();  // names of upvalues
  }

  std::string_view left_;
  bool counted_;
  Digester& digester_;
};

}  // namespace

std::string code_digest(std::string_view dump, CodeLines lines) {
  Digester digester;
  try {
    Code(dump, lines, digester).all();
  } catch (const NotUnderstood&) {
    return Digester().add("as it is").add(dump).hex();
  }
  return digester.hex();
}

}  // namespace asperity::lua

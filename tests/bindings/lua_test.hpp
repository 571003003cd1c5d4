// SPDX-License-Identifier: GPL-3.0-or-later
// A run in its own folder, a session and a Lua state. The tests are linked with both builds of Lua, whose
// errors unwind differently.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/session.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/memory.hpp"
#include "engine/core/monitor.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

class LuaTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "asperity-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder = pattern;
    open();
  }
  void TearDown() override {
    state.reset();
    session.run.reset();
    memory::set_limit(0);
    stop_flag().clear();
    std::filesystem::remove_all(folder);
  }

  // Replaces the state.
  void open() {
    state.reset();
    if (session.dry_run) {
      session.run = std::make_shared<RunDirectory>(RunDirectory::Without::dry);
    } else if (session.run == nullptr) {
      RunSetup setup;
      setup.script_name = "script.lua";
      setup.out = folder / "run";
      setup.trusted = session.trusted;
      session.run = std::make_shared<RunDirectory>(setup);
    }
    state = make_state(session, folder.string());
    L = state.get();
    ASSERT_EQ(run("lab = require \"asperity\""), "");
  }
  void open_trusted() {
    session.run.reset();
    std::filesystem::remove_all(folder / "run");
    session.trusted = true;
    open();
  }
  void open_dry() {
    session.dry_run = true;
    open();
  }

  // Runs script.lua; returns "" or the error's text.
  std::string run(const std::string& code) { return execute(code, 0); }
  // tostring() of an expression, or "error: " and the text.
  std::string value(const std::string& expression) {
    const std::string failure = execute("return tostring(" + expression + ")", 1);
    if (!failure.empty()) return "error: " + failure;
    std::string text(Argument(L, -1).text());
    lua_pop(L, 1);
    return text;
  }
  bool holds(const std::string& condition) { return value(condition) == "true"; }
  void collect() { lua_gc(L, LUA_GCCOLLECT); }

  std::filesystem::path run_folder() const { return folder / "run"; }
  void write_file(const std::string& name, const std::string& content) const {
    std::ofstream(folder / name, std::ios::binary) << content;
  }
  static std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path folder;
  Session session{Monitor::silent()};
  State state;
  lua_State* L = nullptr;

 private:
  std::string execute(const std::string& code, int results) {
    const int top = lua_gettop(L);
    int status = luaL_loadbufferx(L, code.data(), code.size(), "@script.lua", "t");
    if (status == LUA_OK) status = lua_pcall(L, 0, results, 0);
    if (status == LUA_OK) return "";
    std::string text = error_text(L, -1);
    lua_settop(L, top);
    return text;
  }
};

}  // namespace asperity::lua

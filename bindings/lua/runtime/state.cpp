// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/runtime/state.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <utility>

#include "bindings/lua/registry/case_input.hpp"
#include "bindings/lua/registry/embedded.hpp"
#include "bindings/lua/registry/mistakes.hpp"
#include "bindings/lua/registry/placeholder.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/core/error.hpp"
#include "engine/core/text.hpp"
#include "engine/run/run_directory.hpp"

namespace asperity::lua {

namespace {

int open_library(lua_State* L) {
  push_library(L);
  return 1;
}

// Reading a pipe waits for whoever writes into it, perhaps for ever.
void refuse_pipe(const std::string& name, const std::string& place) {
  std::error_code none;
  const auto status = std::filesystem::status(place, none);
  if (std::filesystem::is_fifo(status) || std::filesystem::is_socket(status))
    throw Error(ErrorCode::bad_file, quoted(name) + " is no regular file, but a pipe or a socket",
                "write what it gives into a file first");
}

// host.output_path(name) and host.input_path(name, is_module) -> path, or nil and why not.
int path_body(lua_State* L, bool to_write) {
  std::string result;
  bool good = true;
  try {
    const Session& session = Session::of(L);
    const std::string name(Argument(L, 1).text());
    if (!to_write) {
      result = session.run == nullptr ? name : session.run->place_to_read(name).string();
      refuse_pipe(name, result);
      if (session.notes != nullptr) {
        CaseInput input = input_of_case(result);
        const std::string folder = session.script.folder + "/";
        if (lua_toboolean(L, 2) != 0 && folder.size() > 1 && result.starts_with(folder))
          input.beside_script = result.substr(folder.size());
        session.notes->inputs.push_back(std::move(input));
      }
    } else {
      if (session.is_case)
        throw Error(ErrorCode::not_permitted, "a case of an ensemble writes no files",
                    "return what it found, and write after the loop");
      result = session.run == nullptr ? name : session.run->path_for(name).string();
    }
  } catch (const std::exception& error) {
    result = error.what();
    good = false;
  }
  auto action = [&](lua_State* state) {
    if (!good) lua_pushnil(state);
    lua_pushlstring(state, result.data(), result.size());
    return good ? 1 : 2;
  };
  const int results = good ? 1 : 2;
  return protect(L, 0, results, action) == LUA_OK ? results : -1;
}

int output_path(lua_State* L) {
  const int results = path_body(L, true);
  return results < 0 ? lua_error(L) : results;
}

int input_path(lua_State* L) {
  const int results = path_body(L, false);
  return results < 0 ? lua_error(L) : results;
}

// host.unknown_global(name, _G) -> message
int unknown_global_body(lua_State* L) {
  std::string message;
  try {
    const Argument name(L, 1);
    std::vector<std::string> names;
    Argument(L, 2).each([&](const Argument& key, const Argument&) {
      if (key.is_text()) names.emplace_back(key.text());
    });
    const std::string shown(name.is_text() ? name.text().substr(0, 60) : std::string_view("?"));
    message = "the global " + quoted(shown) + " was never set";
    message += shown == "lab" ? "; a script begins with local lab = require \"asperity\""
                              : did_you_mean(shown, names);
    if (const auto* stayed = Session::of(L).left_behind; stayed != nullptr && stayed->contains(shown))
      message = "the global " + quoted(shown) + " stays with the script: " + stayed->at(shown) +
                "; make it inside `run`, or use it on the rows that come back";
  } catch (const std::exception& error) {
    message = error.what();
  }
  auto action = [&](lua_State* state) {
    lua_pushlstring(state, message.data(), message.size());
    return 1;
  };
  return protect(L, 0, 1, action) == LUA_OK ? 1 : -1;
}

int unknown_global(lua_State* L) { return unknown_global_body(L) < 0 ? lua_error(L) : 1; }

// host.mistaken(message) -> true and a placeholder in a dry run that goes on past mistakes; else false
int mistaken(lua_State* L) {
  const bool noted = noted_as_mistake(L);
  lua_pushboolean(L, noted ? 1 : 0);
  if (!noted) return 1;
  push_unknown(L);
  return 2;
}

// Ends the process; where it must not, or the hook ends the script alone, why.
const char* exit_body(lua_State* L, int code) {
  const Session& session = Session::of(L);
  if (session.is_case) return "a case of an ensemble cannot end the run";
  if (session.with_other_ranks)
    return "this function cannot end the run: other ranks wait for what it gives; raise an error in it";
  try {
    if (session.exit_hook) session.exit_hook(code);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::interrupted) return "interrupted";
    std::fprintf(stderr, "asperity: %s\n", error.what());
    if (code == 0) code = 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "asperity: %s\n", error.what());
    if (code == 0) code = 1;
  }
  std::fflush(nullptr);
  std::_Exit(code);
}

// os.exit([code]): ends the run properly; true and nothing mean success.
int exit_run(lua_State* L) {
  int code = 0;
  if (lua_isboolean(L, 1))
    code = lua_toboolean(L, 1) != 0 ? 0 : 1;
  else if (!Argument(L, 1).is_unknown())
    code = static_cast<int>(luaL_optinteger(L, 1, 0));
  return luaL_error(L, "%s", exit_body(L, code));
}

struct Setup {
  Session* session;
  const char* search_path;  // "" leaves Lua's own
};

// Raises Lua errors; runs under lua_pcall.
int set_up(lua_State* L) {
  const auto& setup = *static_cast<const Setup*>(lua_touserdata(L, 1));
  Session& session = *setup.session;
  // What is made here stays: collecting meanwhile finds nothing.
  lua_gc(L, LUA_GCSTOP);
  luaL_openlibs(L);
  // Here, and not in the loadable module, where `pairs` is the host's: the states of the program and of
  // cases.
  lua_register(L, "pairs", ordered_pairs);
  lua_register(L, "next", ordered_next);
  Session::attach(L, session);
  if (session.dry_run) open_dry_run_library(L);

  lua_getglobal(L, "math");
  lua_getfield(L, -1, "randomseed");
  lua_pushinteger(L, static_cast<lua_Integer>(session.seed));
  lua_pushinteger(L, 0);
  lua_call(L, 2, 0);
  lua_pop(L, 1);

  luaL_requiref(L, "asperity", open_library, 0);
  lua_pop(L, 1);
  preload_embedded_scripts(L);

  if (setup.search_path[0] != '\0') {
    lua_getglobal(L, "package");
    lua_pushstring(L, setup.search_path);
    lua_setfield(L, -2, "path");
    lua_pop(L, 1);
  }

  const std::string_view sandbox = embedded_script("sandbox");
  load_embedded_text(L, sandbox, "=sandbox");
  lua_createtable(L, 0, 4);
  lua_pushboolean(L, session.dry_run ? 1 : 0);
  lua_setfield(L, -2, "dry");
  lua_pushcfunction(L, exit_run);
  lua_setfield(L, -2, "exit");
  lua_pushcfunction(L, output_path);
  lua_setfield(L, -2, "output_path");
  lua_pushcfunction(L, input_path);
  lua_setfield(L, -2, "input_path");
  lua_pushcfunction(L, unknown_global);
  lua_setfield(L, -2, "unknown_global");
  lua_pushcfunction(L, mistaken);
  lua_setfield(L, -2, "mistaken");
  lua_pushboolean(L, session.trusted ? 1 : 0);
  lua_call(L, 2, 0);
  lua_gc(L, LUA_GCRESTART);
  // As after a collection, the next one begins once there is twice as much.
  lua_gc(L, LUA_GCSTEP, -lua_gc(L, LUA_GCCOUNT));
  return 0;
}

}  // namespace

void StateCloser::operator()(lua_State* L) const {
  const std::unique_ptr<StateHeap> heap(StateHeap::of(L));
  lua_close(L);
}

std::string search_path(const std::string& script_folder) {
  return script_folder + "/?.lua;" + script_folder + "/?/init.lua";
}

State make_state(Session& session, const std::string& script_folder) {
  auto heap = std::make_unique<StateHeap>();
  State state(lua_newstate(StateHeap::allocate, heap.get()));
  if (state == nullptr) throw Error(ErrorCode::out_of_memory, "there is no memory for a Lua state");
  lua_State* L = state.get();
  heap.release()->main = L;  // the state's own from here on
  const std::string path = script_folder.empty() ? std::string() : search_path(script_folder);
  Setup setup{&session, path.c_str()};
  lua_pushcfunction(L, set_up);
  lua_pushlightuserdata(L, &setup);
  if (lua_pcall(L, 1, 0, 0) != LUA_OK) {
    const std::string message = error_text(L, -1);
    throw Error(ErrorCode::internal, "the Lua state could not be set up: " + message);
  }
  return state;
}

namespace {
const char* stop_sentence(StopReason reason) {
  switch (reason) {
    case StopReason::none:
      break;
    case StopReason::interrupt:
      return "interrupted";
    case StopReason::time_limit:
      return "the time limit of the run is reached";
    case StopReason::memory_limit:
      return "the memory limit of the run is reached";
  }
  return nullptr;
}

// Whether the hook was called for the handler that is about to write the traceback of a stop: stopped in its
// turn, it could write none.
bool calls_the_handler(lua_State* L, lua_Debug* frame) {
  if (frame->event != LUA_HOOKCALL && frame->event != LUA_HOOKTAILCALL) return false;
  lua_getinfo(L, "f", frame);
  const bool same = lua_tocfunction(L, -1) == traceback_handler;
  lua_pop(L, 1);
  return same;
}

void stop_hook(lua_State* L, lua_Debug* frame) {
  const char* sentence = stop_sentence(stop_flag().reason());
  if (sentence == nullptr || calls_the_handler(L, frame)) return;
  // The line that was running; of a C function that of its caller.
  lua_Debug running;
  for (int level = 0; level < 16 && lua_getstack(L, level, &running) != 0; ++level) {
    lua_getinfo(L, "Sl", &running);
    if (running.currentline <= 0) continue;
    lua_pushfstring(L, "%s:%d: %s", running.short_src, running.currentline, sentence);
    lua_error(L);
  }
  // No line runs: the script has ended, of this very stop it may be, whose message would be lost.
}
}  // namespace

void interrupt(lua_State* L) {
  lua_sethook(L, stop_hook, LUA_MASKCALL | LUA_MASKRET | LUA_MASKLINE | LUA_MASKCOUNT, 1);
}

void watch_for_stops(lua_State* L) {
  constexpr int instructions = 10000;
  lua_sethook(L, stop_hook, LUA_MASKCOUNT, instructions);
}

std::string error_text(lua_State* L, int index) {
  index = lua_absindex(L, index);
  if (lua_type(L, index) == LUA_TSTRING) return std::string(Argument(L, index).text());
  lua_pushvalue(L, index);
  auto action = [](lua_State* s) {
    luaL_tolstring(s, 1, nullptr);
    return 1;
  };
  std::string text = "(an error value that cannot be shown)";
  if (protect(L, 1, 1, action) == LUA_OK && lua_type(L, -1) == LUA_TSTRING) {
    text = Argument(L, -1).text();
    if (lua_type(L, index) != LUA_TUSERDATA) text = "(error value: " + text + ")";
  }
  lua_pop(L, 1);
  return text;
}

int traceback_handler(lua_State* L) {
  // Raising here is allowed: lua_pcall then reports LUA_ERRERR.
  if (lua_type(L, 1) != LUA_TSTRING) {
    luaL_tolstring(L, 1, nullptr);
    if (lua_type(L, 1) != LUA_TUSERDATA) {
      lua_pushliteral(L, "(error value: ");
      lua_insert(L, -2);
      lua_pushliteral(L, ")");
      lua_concat(L, 3);
    }
    lua_replace(L, 1);
  }
  lua_settop(L, 1);
  // A stop that was raised is raised no more while its traceback is written.
  const lua_Hook hook = lua_gethook(L);
  const int mask = lua_gethookmask(L), count = lua_gethookcount(L);
  lua_sethook(L, nullptr, 0, 0);
  luaL_traceback(L, L, lua_tostring(L, 1), 1);
  lua_sethook(L, hook, mask, count);
  return 1;
}

}  // namespace asperity::lua

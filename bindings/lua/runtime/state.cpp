// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/runtime/state.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>

#include "bindings/lua/registry/dry_run.hpp"
#include "bindings/lua/registry/embedded.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/library.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "engine/core/error.hpp"
#include "engine/core/files/source_file.hpp"
#include "engine/core/text.hpp"
#include "engine/run/run_directory.hpp"
#include "engine/run/run_facts.hpp"

namespace asperity::lua {

namespace {

// A pipe's writer may never come.
void refuse_pipe(const std::string& name, const std::string& place) {
  std::error_code none;
  const auto status = std::filesystem::status(place, none);
  if (std::filesystem::is_fifo(status) || std::filesystem::is_socket(status))
    refuse_bad_file(quoted(name) + " is no regular file, but a pipe or a socket",
                    "write its output into a file first");
}

// For `require`, `dofile` and `loadfile`; none for an unreadable file, which Lua reports. A case records a
// module of the script's folder by its name there.
std::optional<std::string> loaded_text(const Session& session, const std::string& name, bool is_module) {
  const std::string place = session.run == nullptr ? name : session.run->place_to_read(name).string();
  const std::string own = session.run == nullptr ? "" : session.run->own_name(place);
  const LoadedFile* const copy = own.empty() ? recorded_copy(session.loaded, name) : nullptr;
  if (copy == nullptr) refuse_pipe(name, place);
  std::error_code none;
  if (copy == nullptr &&
      (!std::filesystem::is_regular_file(place, none) || ::access(place.c_str(), R_OK) != 0))
    return {};
  const std::string text = copy != nullptr ? copy->text : text_of_file(place);
  const auto bytes = static_cast<std::int64_t>(text.size());
  const std::string folder = session.script.folder + "/";
  if (session.notes != nullptr)
    session.notes->inputs.push_back(
        {name, bytes, content_digest(text),
         is_module && folder.size() > 1 && name.starts_with(folder) ? name.substr(folder.size()) : "", true});
  else if (session.run != nullptr && !own.empty())
    session.run->note_input(own, bytes, content_digest(text));
  else if (session.run != nullptr)
    session.run->note_loaded(name, text);
  return text.substr(begin_of_script(text));
}

// Pushes the text; nil and the message if `find` throws.
template <class Find>
int give_text(lua_State* L, const Find& find) {
  std::optional<std::string> text;
  std::string problem;
  try {
    text = find(Session::of(L), std::string(Argument(L, 1).text()));
  } catch (const std::exception& error) {
    problem = error.what();
  }
  const std::string& shown = text ? *text : problem;
  auto action = [&](lua_State* state) {
    if (!text) lua_pushnil(state);
    lua_pushlstring(state, shown.data(), shown.size());
    return text ? 1 : 2;
  };
  if (!text && problem.empty()) return 0;
  return protect(L, 0, text ? 1 : 2, action) == LUA_OK ? (text ? 1 : 2) : -1;
}

// host.script_text(name, is_module) -> text, nothing (Lua opens the file), or nil and a message
int script_text(lua_State* L) {
  const int results = give_text(L, [L](const Session& session, const std::string& name) {
    return loaded_text(session, name, lua_toboolean(L, 2) != 0);
  });
  return results < 0 ? lua_error(L) : results;
}

// host.was_loaded(name) -> whether by the recorded run
int was_loaded(lua_State* L) {
  lua_pushboolean(
      L, lua_isstring(L, 1) != 0 && recorded_copy(Session::of(L).loaded, lua_tostring(L, 1)) != nullptr);
  return 1;
}

// host.output_path(name) -> path, or nil and a message
int output_path(lua_State* L) {
  const int results = give_text(L, [](const Session& session, const std::string& name) {
    if (session.is_case)
      throw Error(ErrorCode::not_permitted, "a case of an ensemble writes no files",
                  "return its results, and write after the loop");
    return session.run == nullptr ? name : session.run->path_for(name).string();
  });
  return results < 0 ? lua_error(L) : results;
}

// host.settled(removed): files were written, or this output_path() removed
int settled(lua_State* L) {
  const auto& run = Session::of(L).run;
  if (run != nullptr && lua_isstring(L, 1) != 0) run->forget_output(lua_tostring(L, 1));
  if (run != nullptr) run->see_outputs();
  return 0;
}

// host.input_path(name) -> path, or nil and a message
int input_path(lua_State* L) {
  const int results = give_text(L, [](const Session& session, const std::string& name) {
    std::string place = session.run == nullptr ? name : session.run->place_to_read(name).string();
    refuse_pipe(name, place);
    if (session.notes != nullptr) session.notes->inputs.push_back(input_of_case(place));
    return place;
  });
  return results < 0 ? lua_error(L) : results;
}

// host.unknown_global(name, _G) -> message
int unknown_global(lua_State* L) {
  const int results = give_text(L, [L](const Session& session, const std::string& given) {
    const std::string name = Argument(L, 1).is_text() ? given.substr(0, 60) : "?";
    if (session.left_behind != nullptr && session.left_behind->contains(name))
      return "the global " + quoted(name) + " stays with the script: " + session.left_behind->at(name) +
             "; make it inside `run`, or use it on the rows that come back";
    std::vector<std::string> names;
    Argument(L, 2).each([&](const Argument& key, const Argument&) {
      if (key.is_text()) names.emplace_back(key.text());
    });
    return "the global " + quoted(name) + " was never set" +
           (name == "lab" ? "; a script begins with local lab = require \"asperity\""
                          : did_you_mean(name, names));
  });
  return results < 0 ? lua_error(L) : 1;
}

// host.mistaken(message) -> true and a placeholder after a noted mistake, else false
int mistaken(lua_State* L) {
  const bool noted = noted_as_mistake(L);
  lua_pushboolean(L, noted ? 1 : 0);
  if (!noted) return 1;
  push_unknown(L);
  return 2;
}

// A message if the process must continue.
const char* exit_body(lua_State* L, int code) {
  const Session& session = Session::of(L);
  if (session.is_case) return "a case of an ensemble cannot end the run";
  if (session.with_other_ranks)
    return "this function cannot end the run: other ranks wait for its result; raise an error in it";
  try {
    if (session.exit_hook) session.exit_hook(code);
  } catch (const std::exception& error) {
    const auto* own = dynamic_cast<const Error*>(&error);
    if (own != nullptr && own->code() == ErrorCode::interrupted) return "interrupted";
    std::fprintf(stderr, "asperity: %s\n", error.what());
    if (code == 0) code = 1;
  }
  std::fflush(nullptr);
  std::_Exit(code);
}

// os.exit([code]): true and nil are success.
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
  const char* search_path;  // "" means Lua's own
};

// Runs under lua_pcall.
int set_up(lua_State* L) {
  const auto& setup = *static_cast<const Setup*>(lua_touserdata(L, 1));
  Session& session = *setup.session;
  // A collection would be in vain.
  lua_gc(L, LUA_GCSTOP);
  luaL_openlibs(L);
  // Not in the loadable module: the host's functions stay.
  lua_register(L, "print", print_values);
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

  luaL_requiref(
      L, "asperity", [](lua_State* s) { return push_library(s), 1; }, 0);
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
  static constexpr std::array<luaL_Reg, 9> host = {{{"exit", exit_run},
                                                    {"output_path", output_path},
                                                    {"input_path", input_path},
                                                    {"settled", settled},
                                                    {"script_text", script_text},
                                                    {"was_loaded", was_loaded},
                                                    {"unknown_global", unknown_global},
                                                    {"mistaken", mistaken},
                                                    {nullptr, nullptr}}};
  lua_createtable(L, 0, static_cast<int>(host.size()));
  luaL_setfuncs(L, host.data(), 0);
  lua_pushboolean(L, session.dry_run ? 1 : 0);
  lua_setfield(L, -2, "dry");
  lua_pushboolean(L, session.trusted ? 1 : 0);
  lua_call(L, 2, 0);
  lua_gc(L, LUA_GCRESTART);
  // The next cycle begins at twice the present size.
  lua_gc(L, LUA_GCSTEP, -lua_gc(L, LUA_GCCOUNT));
  return 0;
}

const char* stop_sentence(StopReason reason) {
  return reason == StopReason::none         ? nullptr
         : reason == StopReason::interrupt  ? "interrupted"
         : reason == StopReason::time_limit ? "the time limit of the run is reached"
                                            : "the memory limit of the run is reached";
}

// A second stop would prevent the traceback.
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
  // The running line, or the caller's line.
  lua_Debug running;
  for (int level = 0; level < 16 && lua_getstack(L, level, &running) != 0; ++level) {
    lua_getinfo(L, "Sl", &running);
    if (running.currentline <= 0) continue;
    lua_pushfstring(L, "%s:%d: %s", running.short_src, running.currentline, sentence);
    lua_error(L);
  }
  // The script has ended, perhaps by this stop: an error would lose its message.
}

// Whether the first line of a message has a place such as "script.lua:3:".
bool names_a_line(const char* message) {
  for (const char* at = message; *at != '\0' && *at != '\n'; ++at) {
    if (*at != ':') continue;
    const std::size_t digits = std::strspn(at + 1, "0123456789");
    if (digits > 0 && at[1 + digits] == ':') return true;
  }
  return false;
}

// Lua's own C functions, and error values other than text, name no line. A script's error("text", 0) stays as
// written.
void add_running_line(lua_State* L, bool text) {
  lua_Debug frame;
  if (text && lua_getstack(L, 1, &frame) != 0 && lua_getinfo(L, "Sn", &frame) != 0 && *frame.what == 'C' &&
      frame.name != nullptr && std::strcmp(frame.name, "error") == 0)
    return;
  for (int level = 1; !names_a_line(lua_tostring(L, 1)) && lua_getstack(L, level, &frame) != 0; ++level) {
    lua_getinfo(L, "Sl", &frame);
    if (frame.currentline <= 0 || std::strcmp(frame.source, "=sandbox") == 0) continue;
    lua_pushfstring(L, "%s:%d: %s", frame.short_src, frame.currentline, lua_tostring(L, 1));
    lua_replace(L, 1);
  }
}

}  // namespace

void StateCloser::operator()(lua_State* L) const {
  const std::unique_ptr<StateHeap> heap(StateHeap::of(L));
  lua_close(L);
}

std::size_t begin_of_script(std::string_view text) {
  const std::size_t begin = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  return begin < text.size() && text[begin] == '#' ? std::min(text.find('\n'), text.size()) : begin;
}

std::string search_path(const std::string& script_folder) {
  return script_folder + "/?.lua;" + script_folder + "/?/init.lua";
}

State make_state(Session& session, const std::string& script_folder) {
  auto heap = std::make_unique<StateHeap>();
  State state(lua_newstate(StateHeap::allocate, heap.get()));
  if (state == nullptr) throw Error(ErrorCode::out_of_memory, "there is no memory for a Lua state");
  lua_State* L = state.get();
  heap.release()->main = L;  // the state now owns the heap
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

std::optional<std::string> failure_of_call(lua_State* L, int arguments, int results) {
  if (lua_pcall(L, arguments, results, 0) == LUA_OK) return {};
  stop_flag().check();
  return error_text(L, -1);
}

std::optional<std::string> failure_of_call(const Argument& function, const Values& arguments) {
  lua_State* L = function.state();
  lua_pushvalue(L, function.index());
  const int count = static_cast<int>(arguments.size());
  auto push_all = [&](lua_State* s) {
    for (const Value& argument : arguments) push(s, argument);
    return count;
  };
  if (protect(L, 0, count, push_all) == LUA_OK) return failure_of_call(L, count, 1);
  stop_flag().check();
  return error_text(L, -1);
}

int traceback_handler(lua_State* L) {
  const bool text = lua_type(L, 1) == LUA_TSTRING;
  if (!text) {
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
  add_running_line(L, text);
  // No stop during the traceback.
  const lua_Hook hook = lua_gethook(L);
  const int mask = lua_gethookmask(L), count = lua_gethookcount(L);
  lua_sethook(L, nullptr, 0, 0);
  int first = 1;  // below the functions of the sandbox
  lua_Debug frame;
  for (int level = 1; lua_getstack(L, level, &frame) != 0 && lua_getinfo(L, "S", &frame) != 0; ++level) {
    if (std::strcmp(frame.source, "=sandbox") == 0)
      first = level + 1;
    else if (*frame.what != 'C')
      break;
  }
  luaL_traceback(L, L, lua_tostring(L, 1), first);
  lua_sethook(L, hook, mask, count);
  return 1;
}

}  // namespace asperity::lua

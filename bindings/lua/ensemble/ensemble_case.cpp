// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/ensemble/ensemble_case.hpp"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "bindings/lua/ensemble/transfer.hpp"
#include "bindings/lua/registry/argument.hpp"
#include "bindings/lua/registry/guard.hpp"
#include "bindings/lua/registry/record.hpp"
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/runtime/state.hpp"
#include "engine/core/cost.hpp"
#include "engine/core/require.hpp"

namespace asperity::lua {

namespace {

// The ensemble as a whole reports progress.
class CaseMonitor final : public Monitor {
 public:
  CaseMonitor(std::vector<std::string>& warnings, ResultStore* results)
      : warnings_(warnings), results_(results) {}
  void progress(std::string_view, double) override {}
  void warn(std::string_view sentence) override { warnings_.emplace_back(sentence); }
  ResultStore* results() override { return results_; }

 private:
  std::vector<std::string>& warnings_;
  ResultStore* results_;
};

class OutputBuffer {
 public:
  OutputBuffer() : file_(open_memstream(&data_, &size_)) {
    if (file_ == nullptr)
      throw Error(ErrorCode::out_of_memory, "there is no memory for the output of a case");
  }
  ~OutputBuffer() {
    std::fclose(file_);
    std::free(data_);
  }
  OutputBuffer(const OutputBuffer&) = delete;
  OutputBuffer& operator=(const OutputBuffer&) = delete;
  std::FILE* file() const { return file_; }
  std::string text() {
    std::fflush(file_);
    return std::string(data_, size_);
  }

 private:
  char* data_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* file_;
};

int keep_open(lua_State* L) {
  static_cast<luaL_Stream*>(luaL_checkudata(L, 1, LUA_FILEHANDLE))->closef = keep_open;
  luaL_pushfail(L);
  lua_pushliteral(L, "cannot close standard file");
  return 2;
}

// Redirects print, io.write and io.stdout to the session. Raises.
void capture_output(lua_State* L) {
  lua_pushcfunction(L, print_values);
  lua_setglobal(L, "print");
  lua_getglobal(L, "io");
  lua_getfield(L, -1, "output");
  auto* stream = static_cast<luaL_Stream*>(lua_newuserdatauv(L, sizeof(luaL_Stream), 0));
  stream->closef = nullptr;  // closed until it has a file
  luaL_setmetatable(L, LUA_FILEHANDLE);
  stream->f = Session::of(L).output;
  stream->closef = keep_open;
  lua_pushvalue(L, -1);
  lua_setfield(L, -4, "stdout");
  lua_call(L, 1, 0);
  lua_pop(L, 1);
}

[[noreturn]] void fail(lua_State* L) {
  stop_flag().check();
  refuse(error_text(L, -1));
}

// Equality without metamethods.
bool same(const Argument& a, const Argument& b) {
  if (lua_rawequal(a.state(), a.index(), b.index()) != 0) return true;
  const Object* first = a.as_any_object();
  const Object* second = b.as_any_object();
  return first != nullptr && second != nullptr && first->pointer == second->pointer;
}

void make_table(lua_State* L) {
  const Argument returned(L, -1);
  if (returned.is_table()) return;
  const std::shared_ptr<Record> record = record_at(L, -1);
  if (record == nullptr) refuse(wrong_return(returned.describe()));
  Map fields;
  for (const Record::Entry& entry : record->entries) fields.items.emplace_back(entry.field, entry.value);
  push_checked(L, std::move(fields), "what a case returned");
}

void refuse_other_values(const CaseSetup& setup, const Argument& returned, const Argument& given) {
  for (const CaseValue& value : setup.values)
    with_key(returned, value.key, [&](const Argument& found) {
      with_key(given, value.key, [&](const Argument& own) {
        if (!found.is_nil() && !same(found, own))
          refuse("`run` returned " + quoted(value.key) + " = " + found.describe() + ", but " +
                     quoted(value.key) + " is " + value.text + " in this case",
                 "give the column another name");
      });
    });
}

// Seeds math.random and returns its next integer, for has_drawn(). Pushes math.random and math.randomseed.
lua_Integer first_draw(lua_State* L, std::uint64_t seed) {
  auto action = [seed](lua_State* s) {
    lua_getglobal(s, "math");
    lua_getfield(s, -1, "random");
    lua_getfield(s, -2, "randomseed");
    lua_remove(s, -3);
    lua_pushvalue(s, -2);
    lua_pushinteger(s, 0);
    lua_call(s, 1, 1);
    lua_pushvalue(s, -2);
    lua_pushinteger(s, static_cast<lua_Integer>(seed));
    lua_pushinteger(s, 0);
    lua_call(s, 2, 0);
    return 3;
  };
  if (protect(L, 0, 3, action) != LUA_OK) fail(L);
  const lua_Integer first = lua_tointeger(L, -1);
  lua_pop(L, 1);
  return first;
}

bool has_drawn(lua_State* L, int random, lua_Integer first) {
  lua_pushvalue(L, random);
  auto action = [](lua_State* s) {
    lua_pushinteger(s, 0);
    lua_call(s, 1, 1);
    return 1;
  };
  if (protect(L, 1, 1, action) != LUA_OK) fail(L);
  const bool drawn = lua_tointeger(L, -1) != first;
  lua_pop(L, 1);
  return drawn;
}

// Pushes the upvalues, for a list its length, and returns their number.
int push_upvalues(lua_State* L, int function) {
  if (lua_checkstack(L, 300) == 0) throw Error(ErrorCode::out_of_memory, "the Lua stack is full");
  int count = 0;
  for (; lua_getupvalue(L, function, count + 1) != nullptr; ++count) {
    if (!lua_istable(L, -1)) continue;
    lua_pushinteger(L, static_cast<lua_Integer>(lua_rawlen(L, -1)));
    lua_replace(L, -2);
  }
  return count;
}

// Changes of upvalues stay in the case. `before`: stack index of the first original.
void warn_of_lost_changes(lua_State* L, int function, int before) {
  const Argument::StackGuard guard(L);
  const int count = push_upvalues(L, function), after = lua_gettop(L) - count + 1;
  for (int k = 0; k < count; ++k) {
    const int type = lua_type(L, after + k);
    if ((type != LUA_TNUMBER && type != LUA_TSTRING) || lua_type(L, before + k) != type ||
        lua_rawequal(L, before + k, after + k) != 0)
      continue;
    const std::string name = lua_getupvalue(L, function, k + 1);
    lua_Debug facts;
    lua_pushvalue(L, function);
    lua_getinfo(L, ">S", &facts);
    Session::of(L).monitor().warn(std::string(facts.short_src) + ":" + std::to_string(facts.linedefined) +
                                  ": `run` changes " + quoted(name) + ", and each case has its own copy; " +
                                  "return the value and use the rows");
  }
}

std::shared_ptr<const PackedValue> call_run(lua_State* L, const CaseSetup& setup, CaseNotes& notes) {
  const lua_Integer first = first_draw(L, setup.seed);
  const int random = lua_gettop(L) - 1;
  lua_pushcfunction(L, traceback_handler);
  const int handler = lua_gettop(L);
  // `run` may change its own table.
  auto prepare = [&setup](lua_State* s) {
    capture_output(s);
    lua_createtable(s, 0, static_cast<int>(setup.values.size()));
    setup.run->push(s);
    lua_createtable(s, 0, static_cast<int>(setup.values.size()));
    for (const CaseValue& value : setup.values) {
      lua_pushlstring(s, value.key.data(), value.key.size());
      value.value->push(s);
      lua_pushvalue(s, -2);
      lua_pushvalue(s, -2);
      lua_rawset(s, -7);
      lua_rawset(s, -3);
    }
    return 3;
  };
  if (protect(L, 0, 3, prepare) != LUA_OK) fail(L);
  const int function = handler + 2;  // followed by its argument
  push_upvalues(L, function);
  lua_pushvalue(L, function);
  lua_pushvalue(L, function + 1);
  const int ended = lua_pcall(L, 1, 1, handler);
  if (has_drawn(L, random, first)) notes.drew = true;
  if (ended != LUA_OK) fail(L);
  warn_of_lost_changes(L, function, function + 2);
  make_table(L);
  const Argument given(L, handler + 1), returned(L, -1);
  refuse_other_values(setup, returned, given);
  auto add_values = [](lua_State* s) {  // given, returned
    copy_entries(s, 1, 2);
    return 1;
  };
  lua_pushvalue(L, given.index());
  lua_pushvalue(L, returned.index());
  if (protect(L, 2, 1, add_values) != LUA_OK) fail(L);
  return pack(L, -1, Cargo::data, "run(case)",
              "return numbers, strings, booleans, tables of these, and values such as surfaces");
}

}  // namespace

void RunningStates::interrupt() {
  const std::lock_guard lock(mutex_);
  for (lua_State* L : states_) lua::interrupt(L);
}

RunningStates::Member::Member(RunningStates& states, lua_State* L) : states_(states), L_(L) {
  const std::lock_guard lock(states_.mutex_);
  states_.states_.push_back(L_);
}

RunningStates::Member::~Member() {
  const std::lock_guard lock(states_.mutex_);
  std::erase(states_.states_, L_);
}

std::string case_name(const std::vector<CaseValue>& values) {
  std::string name = "case";
  for (const CaseValue& value : values)
    name += (name.size() > 4 ? ", " : " ") + value.key + " = " + value.text;
  return name;
}

std::string wrong_return(const std::string& found) {
  return "`run` returned " + found + "; return a table of named results";
}

CaseResult run_case(const CaseSetup& setup, RunningStates& states) {
  CaseResult result;
  const double transforms = cost::transforms();
  const auto begun = std::chrono::steady_clock::now();
  try {
    CaseMonitor monitor(result.warnings, setup.results);
    OutputBuffer output;
    Session session(monitor);
    static_cast<SessionSettings&>(session) = setup;
    session.is_case = true;
    session.output = output.file();
    session.left_behind = &setup.run->left_behind();
    CaseNotes notes;
    session.notes = &notes;
    try {
      const State state = make_state(session, "");
      if (setup.watched) watch_for_stops(state.get());
      const RunningStates::Member member(states, state.get());
      result.row = call_run(state.get(), setup, notes);
      result.digest = result.row->digest();
    } catch (const Error& error) {
      result.failure = error.what();
    } catch (const std::bad_alloc&) {
      result.failure = "out of memory";
    }
    result.output = output.text();
    result.inputs = std::move(notes.inputs);
    result.knobs = std::move(notes.knobs);
    result.drew = notes.drew;
  } catch (const std::exception& error) {
    result.failure = error.what();
  }
  result.transforms = cost::transforms() - transforms;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return result;
}

}  // namespace asperity::lua

// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/runtime/state.hpp"

#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::state_test {
namespace {

using StrictGlobals = LuaTest;
using LuaState = LuaTest;
using ErrorValue = LuaTest;
using Stop = LuaTest;

TEST_F(StrictGlobals, ReadingWhatWasNeverSetIsAnError) {
  EXPECT_EQ(run("local x = suface"), "script.lua:1: the global `suface` was never set");
  EXPECT_EQ(run("prnt('x')"), "script.lua:1: the global `prnt` was never set (did you mean `print`?)");
  EXPECT_EQ(run("local f = function() return undefined_thing end\nf()").rfind("script.lua:1: the global", 0),
            0u);
  EXPECT_EQ(value("rawget(_G, 'undefined_thing')"), "nil");
}

TEST_F(StrictGlobals, TheMainChunkMaySetThemAndFunctionsMayNot) {
  EXPECT_EQ(run("count = 1\nlocal function f() count = count + 1 end f() assert(count == 2)"), "");
  EXPECT_EQ(run("local function f()\n  sum = 0 end\nf()"),
            "script.lua:2: a function sets the global `sum`; write `local sum`");
  EXPECT_EQ(run("local function f() rawset(_G, 'meant', 1) end f() assert(meant == 1)"), "");
  EXPECT_EQ(run("flag = nil\nlocal x = flag").rfind("script.lua:2: the global `flag` was never set", 0), 0u);
}

TEST_F(StrictGlobals, NamesOfAnyTypeAreShown) {
  EXPECT_NE(run("local x = _G[{}]").find("was never set"), std::string::npos);
  EXPECT_NE(run("local x = _G[12]").find("was never set"), std::string::npos);
  EXPECT_NE(run("local function f() _G[{}] = 1 end f()").find("sets the global"), std::string::npos);
}

TEST_F(LuaState, DrawsTheSameRandomNumbersForTheSameSeed) {
  const std::string first = value("math.random(1 << 50)");
  open();
  EXPECT_EQ(value("math.random(1 << 50)"), first);
  session.seed = 2;
  open();
  EXPECT_NE(value("math.random(1 << 50)"), first);
}

TEST_F(LuaState, GivesTheLaboratoryToRequire) {
  EXPECT_TRUE(holds("require 'asperity' == lab and package.loaded.asperity == lab"));
  EXPECT_NE(run("require 'asperity.nothing'").find("module 'asperity.nothing' not found"), std::string::npos);
  EXPECT_NE(run("require 'asperity.sandbox'").find("not found"), std::string::npos);
}

TEST_F(LuaState, FindsTheScriptsOwnModules) {
  write_file("helper.lua", "return { answer = 42 }");
  write_file("broken.lua", "return {");
  EXPECT_EQ(value("require('helper').answer"), "42");
  EXPECT_NE(run("require 'broken'").find("broken.lua:1:"), std::string::npos);
}

TEST_F(LuaState, SortsKeysOfATable) {
  EXPECT_EQ(run("local seen = {} for k, v in lab.sorted{ b=1, a=2, [3]=3, [1]=4 } do seen[#seen + 1] = k .. "
                "'=' .. v end\n"
                "assert(table.concat(seen, ' ') == '1=4 3=3 a=2 b=1', table.concat(seen, ' '))"),
            "");
  EXPECT_EQ(run("lab.sorted(3)"), "script.lua:1: lab.sorted was given a number; give a table");
  EXPECT_NE(run("lab.sorted{ [{}]=1 }").find("lab.sorted met a table as a key"), std::string::npos);
}

TEST_F(LuaState, ManyStatesComeAndGo) {
  state.reset();
  const std::int64_t before = memory::held();
  for (int k = 0; k < 50; ++k) {
    open();
    run("keep = lab.surface.flat{ cells=64, size=1 } error('gone')");
    state.reset();
  }
  EXPECT_EQ(memory::held(), before);
}

TEST_F(LuaState, TooLittleMemoryForAStateIsAnError) {
  state.reset();
  const std::int64_t before = memory::held();
  for (const std::int64_t room : {1, 2000, 20000, 30000}) {
    memory::set_limit(before + room);
    EXPECT_THROW(make_state(session, ""), Error) << room;
    memory::set_limit(0);
    EXPECT_EQ(memory::held(), before);
  }
}

TEST_F(ErrorValue, OfAnyTypeBecomesText) {
  const struct {
    const char* code;
    const char* start;
  } cases[] = {
      {"error('plain', 0)", "plain"},
      {"error(12)", "(error value: 12)"},
      {"error(nil)", "(error value: nil)"},
      {"error()", "(error value: nil)"},
      {"error(true)", "(error value: true)"},
      {"error({})", "(error value: table: "},
      {"error(print)", "(error value: function: "},
      {"error(setmetatable({}, { __tostring=function() return 'shown' end }))", "(error value: shown)"},
      {"error(setmetatable({}, { __tostring=function() error('worse') end }))",
       "(an error value that cannot be shown)"},
      {"error(setmetatable({}, { __tostring=function() return {} end }))",
       "(an error value that cannot be shown)"},
      {"error(lab.rigid)", "rigid body"},
  };
  for (const auto& c : cases) EXPECT_EQ(run(c.code).rfind(c.start, 0), 0u) << c.code << ": " << run(c.code);
}

TEST_F(Stop, ReachesLoopsInLua) {
  stop_flag().raise(StopReason::interrupt);
  interrupt(L);
  EXPECT_NE(run("while true do end").find("interrupted"), std::string::npos);
}

TEST_F(Stop, IsNotSwallowedByProtectedCalls) {
  watch_for_stops(L);
  ASSERT_EQ(run("function loop() while true do pcall(function() while true do end end) end end"), "");
  stop_flag().raise(StopReason::time_limit);
  interrupt(L);
  EXPECT_NE(run("loop()").find("the time limit of the run is reached"), std::string::npos);
}

TEST_F(Stop, ReachesCoroutinesWhenWatching) {
  watch_for_stops(L);
  ASSERT_EQ(run("co = coroutine.wrap(function() while true do end end)"), "");
  stop_flag().raise(StopReason::time_limit);
  EXPECT_NE(run("co()").find("the time limit of the run is reached"), std::string::npos);
}

TEST_F(Stop, ReachesFunctionsThatTheEngineCalls) {
  watch_for_stops(L);
  ASSERT_EQ(run("function make() lab.surface.from_function{ cells=4, size=1, height=function() while true do "
                "end end } end"),
            "");
  // Raised while the engine calls the function.
  ASSERT_EQ(run("calls = 0"), "");
  lua_pushcfunction(L, [](lua_State*) {
    stop_flag().raise(StopReason::interrupt);
    return 0;
  });
  lua_setglobal(L, "stop");
  EXPECT_NE(run("lab.surface.from_function{ cells=64, size=1, height=function() stop() return 0 end }")
                .find("interrupted"),
            std::string::npos);
}

TEST_F(Stop, EndsTheEnginesOwnWork) {
  stop_flag().raise(StopReason::time_limit);
  const std::string error = run("lab.surface.flat{ cells=8, size=1 }");
  EXPECT_NE(error.find("time limit"), std::string::npos) << error;
}

}  // namespace
}  // namespace asperity::lua::state_test

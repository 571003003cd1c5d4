// SPDX-License-Identifier: GPL-3.0-or-later
// Engine errors become Lua errors with the script's line; failed calls release everything in both builds of
// Lua.
#include "bindings/lua/registry/registry.hpp"
#include "bindings/lua/registry/guard.hpp"

#include <memory>

#include "bindings/lua/surface/surface.hpp"
#include "engine/surface/generators/sphere.hpp"
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::registry_test {
namespace {

using Guard = LuaTest;
using Method = LuaTest;
using LabModule = LuaTest;

// Sets the global `s`.
std::shared_ptr<Surface> give_surface(lua_State* L, int cells) {
  auto surface =
      std::make_shared<Surface>(flat_surface({make_grid(cells, cells, 1e-3, 1e-3)}, Monitor::silent()));
  auto action = [&](lua_State* inner) {
    push(inner, object(surface));
    lua_setglobal(inner, "s");
    return 0;
  };
  EXPECT_EQ(protect(L, 0, 0, action), LUA_OK);
  return surface;
}

TEST_F(Guard, EngineErrorsCarryTheLineOfTheScript) {
  EXPECT_EQ(
      run("\n\nlab.material \"Al-2001\""),
      "script.lua:3: lab.material: there is no material `Al-2001` (did you mean `Al-2011`?); "
      "named materials are Al-2011, quartz, steel, copper, gold, silicon, glass, PMMA and rubber; or give a "
      "table with `young` and `poisson`");
  EXPECT_EQ(run("local s = lab.surface.flat{ cells=4, size=1 }\ns:height(4, 0)").rfind("script.lua:2: ", 0),
            0u);
}

TEST_F(Guard, TheLineIsThatOfTheCallAlsoThroughPcallAndMetamethods) {
  EXPECT_TRUE(
      holds("select(2, pcall(lab.surface.flat, { cells=0, size=1 })):find('^script.lua:1: ') ~= nil"));
  EXPECT_EQ(run("local t = setmetatable({}, { __index = function(_, k)\n return lab.surface[k] end })\n"
                "local x = t.flt"),
            "script.lua:2: lab.surface has no field `flt` (did you mean `flat`?); "
            "lab.help \"lab.surface\" lists its members");
}

TEST_F(Guard, AFailedCallFreesWhatItHeld) {
  collect();
  const std::int64_t before = memory::held();
  const std::string error =
      run("lab.surface.from_function{ cells=256, size=1, height=function(x, y)\n"
          "  if y > 0.5 then error('no height here') end return 0 end }");
  EXPECT_NE(error.find("script.lua:1: lab.surface.from_function: the function `height` failed: "
                       "script.lua:2: no height here"),
            std::string::npos)
      << error;
  collect();
  EXPECT_LT(memory::held() - before, 64 * 1024);
}

TEST_F(Guard, ManyFailedCallsHoldNothing) {
  const auto surface = give_surface(L, 8);
  const long held = surface.use_count();
  for (const char* call : {"s:height(99, 0)", "s:scaled{ }", "s:scaled{ rms=1, ra=1 }", "s:plus(3)",
                           "s:write '/nowhere/x.npy'", "s:write 'x.unknown'", "s:nothing()", "s.x = 1",
                           "lab.contact{ lower=s, upper=s, effects={ elasticity='spring' } }",
                           "s:profile{ row=99 }", "s:resampled{ cells=0 }", "s:rotated 'one turn'"})
    for (int k = 0; k < 20; ++k) EXPECT_NE(run(call), "") << call;
  collect();
  EXPECT_EQ(surface.use_count(), held);
}

TEST_F(Guard, AMemoryErrorWhileResultsAreDeliveredLeaksNothing) {
  const auto surface = give_surface(L, 512);
  collect();
  const long held = surface.use_count();
  const std::int64_t before = memory::held();
  memory::set_limit(before + (1 << 20));  // 512 x 512 heights need four times this
  const std::string error = run("local h = s:heights()");
  memory::set_limit(0);
  EXPECT_NE(error.find("not enough memory"), std::string::npos) << error;
  collect();
  EXPECT_EQ(surface.use_count(), held);
  EXPECT_LT(memory::held() - before, 256 * 1024);
  EXPECT_EQ(run("assert(#s:heights() == 512)"), "");  // the state still works
}

TEST_F(Guard, AValueThatCannotBeDeliveredIsFreed) {
  collect();
  const std::int64_t before = memory::held();
  for (std::int64_t room = 0; room < 4096; room += 128) {
    memory::set_limit(memory::held() + (1 << 15) + room);
    run("local t = {} for k = 1, 400 do t[k] = lab.surface.flat{ cells=8, size=1 } end");
    memory::set_limit(0);
    collect();
  }
  EXPECT_LT(memory::held() - before, 64 * 1024);
}

TEST_F(Guard, ErrorsInsideCoroutinesComeOutOfResume) {
  EXPECT_EQ(
      run("local co = coroutine.create(function()\n  coroutine.yield(1)\n  lab.surface.flat{ cells=8 "
          "}\nend)\n"
          "assert(coroutine.resume(co))\n"
          "local ok, message = coroutine.resume(co)\n"
          "assert(not ok and message:find('^script.lua:3: lab.surface.flat: `size` is missing'), message)\n"
          "assert(coroutine.status(co) == 'dead')"),
      "");
}

TEST_F(Guard, ACoroutineMayUseValuesOfAnother) {
  EXPECT_EQ(run("local s\nlocal make = coroutine.wrap(function() s = lab.surface.flat{ cells=8, size=1 }\n"
                "  coroutine.yield(s) error('never') end)\n"
                "assert(make() == s)\nmake = nil collectgarbage()\nassert(s:height(7, 7) == 0)"),
            "");
}

TEST_F(Guard, ProtectedCallsRecoverAgainAndAgain) {
  EXPECT_EQ(run("for k = 1, 2000 do\n"
                "  local ok = pcall(lab.surface.flat, { cells='many', size=1 })\n"
                "  assert(not ok)\n"
                "  assert(pcall(lab.surface.flat, { cells=2, size=1 }))\nend"),
            "");
}

TEST_F(Guard, CallsThatNestToTheStacksEndFailAndRecover) {
  const std::string error =
      run("local function deeper() return lab.surface.from_function{ cells=1, size=1, height=function()\n"
          "  deeper() return 0 end } end\ndeeper()");
  EXPECT_NE(error.find("stack overflow"), std::string::npos) << error.substr(0, 400);
  EXPECT_EQ(run("lab.surface.flat{ cells=2, size=1 }"), "");
}

TEST_F(Guard, ARaisedStopFlagEndsTheNextCall) {
  stop_flag().raise(StopReason::interrupt);
  EXPECT_EQ(run("lab.surface.flat{ cells=2, size=1 }"), "script.lua:1: interrupted");
  stop_flag().clear();
  EXPECT_EQ(run("lab.surface.flat{ cells=2, size=1 }"), "");
}

TEST_F(Guard, GarbageDoesNotCountAgainstTheMemoryLimit) {
  collect();
  // 8 MiB per surface: room for two.
  memory::set_limit(memory::held() + (20 << 20));
  EXPECT_EQ(run("local s for k = 1, 12 do s = lab.surface.flat{ cells=1024, size=k } end"), "");
  EXPECT_EQ(run("local s = lab.surface.flat{ cells=1024, size=1 }\n"
                "for k = 1, 12 do s = s:mirrored() end"),
            "");
  const std::string error =
      run("local t = {} for k = 1, 12 do t[k] = lab.surface.flat{ cells=1024, size=k } end");
  EXPECT_NE(error.find("out of memory: requested 8 MiB"), std::string::npos) << error;
}

TEST_F(Method, NeedsAColonAndAValueOfItsClass) {
  const std::string hint = "; write a colon: x:height(...)";
  run("s = lab.surface.flat{ cells=4, size=1 }");
  EXPECT_EQ(run("s.height(1, 2)"),
            "script.lua:1: surface:height was called on the number 1, not on a surface" + hint);
  EXPECT_EQ(run("s.height()"),
            "script.lua:1: surface:height was called on nothing (nil), not on a surface" + hint);
  EXPECT_EQ(run("s.height(lab.rigid, 2)"),
            "script.lua:1: surface:height was called on a material, not on a surface" + hint);
  EXPECT_EQ(run("s.height({}, 2)"),
            "script.lua:1: surface:height was called on an empty table, not on a surface" + hint);
  EXPECT_EQ(run("s.height(io.stdout, 2)"),
            "script.lua:1: surface:height was called on a userdata, not on a surface" + hint);
}

TEST_F(Method, RefusesSurplusArguments) {
  run("s = lab.surface.flat{ cells=4, size=1 }");
  EXPECT_EQ(run("s:height(1, 2, 3)"),
            "script.lua:1: surface:height takes at most 2 arguments and was given 3");
  EXPECT_EQ(run("s:mirrored(1)"), "script.lua:1: surface:mirrored takes no arguments and was given 1");
  EXPECT_EQ(run("lab.surface.flat({ cells=4, size=1 }, 2)"),
            "script.lua:1: lab.surface.flat takes one argument, a table of named keys, and was given 2");
}

TEST_F(Method, NamesItsPositionalArguments) {
  run("s = lab.surface.flat{ cells=4, size=1 }");
  EXPECT_EQ(run("s:height(1)"), "script.lua:1: surface:height: `j` is nothing (nil); give a number");
  EXPECT_EQ(run("s:height('1', {})"), "script.lua:1: surface:height: `j` is an empty table; give a number");
  EXPECT_EQ(run("s:plus(lab.rigid)"), "script.lua:1: surface:plus: `other` is a material; give a surface");
  EXPECT_EQ(run("s:write(12)"), "script.lua:1: surface:write: `path` is the number 12; give a string");
}

TEST_F(LabModule, AnUnknownNameOfTheLaboratoryIsAnErrorWithTheNearest) {
  EXPECT_EQ(run("lab.surfase = nil"), "script.lua:1: lab cannot be changed");
  EXPECT_EQ(run("local x = lab.surfaces"),
            "script.lua:1: lab has no field `surfaces` (did you mean `surface`?); lab.help \"lab\" lists its "
            "members");
  EXPECT_EQ(run("local x = lab.surface.sin"),
            "script.lua:1: lab.surface has no field `sin` (did you mean `sine`?); "
            "lab.help \"lab.surface\" lists its members");
  EXPECT_EQ(run("local x = lab.units.Nm2").rfind("script.lua:1: lab.units has no field `Nm2`", 0), 0u);
  EXPECT_EQ(run("local x = lab[3]").rfind("script.lua:1: lab has no field the number 3", 0), 0u);
  EXPECT_EQ(run("local x = lab[{}]").rfind("script.lua:1: lab has no field an empty table", 0), 0u);
}

TEST_F(LabModule, GoesThroughPairsAndCannotBeChanged) {
  EXPECT_EQ(
      run("local seen = {} for name, entry in pairs(lab) do seen[name] = type(entry) end\n"
          "assert(seen.surface == 'table' and seen.material == 'function' and seen.rigid == 'userdata')\n"
          "local n = 0 for _ in pairs(lab.units) do n = n + 1 end assert(n > 10)"),
      "");
  EXPECT_EQ(run("local next_of, state = pairs(lab)\nlocal ok = pcall(function() state.surface = 1 end)\n"
                "assert(not ok)\nassert(type(lab.surface.flat) == 'function')"),
            "");
  EXPECT_NE(run("lab.units.um = 1"), "");
  EXPECT_NE(run("table.insert(lab, 1)"), "");
  EXPECT_EQ(value("getmetatable(lab)"), "lab");
  EXPECT_NE(run("setmetatable(lab, nil)"), "");
  EXPECT_EQ(value("lab.units.um"), "1e-06");
}

// Members are created on first access.
TEST_F(LabModule, GivesTheSameMemberWheneverAndHoweverItIsAskedFor) {
  EXPECT_EQ(
      run("local flat, units, rigid = lab.surface.flat, lab.units, lab.rigid\n"
          "local seen = {} for name, entry in pairs(lab) do seen[name] = entry end\n"
          "assert(seen.units == units and rawequal(seen.rigid, rigid) and seen.surface == lab.surface)\n"
          "for name, entry in pairs(lab.surface) do seen[name] = entry end\n"
          "assert(seen.flat == flat and lab.surface.flat == flat and seen.sine == lab.surface.sine)"),
      "");
  EXPECT_EQ(run("local co = coroutine.wrap(function() return lab.surface.self_affine end)\n"
                "assert(co() == lab.surface.self_affine)"),
            "");
}

TEST_F(LabModule, AStateHasNoMemberThatNobodyAskedFor) {
  EXPECT_EQ(run("collectgarbage()\n"
                "local function all() for _, m in ipairs{ lab, lab.surface, lab.units, lab.profile, "
                "lab.table } do\n"
                "  for _ in pairs(m) do end end collectgarbage() end\n"
                "local before = collectgarbage 'count'\n"
                "all()\n"
                "local made = collectgarbage 'count' - before\n"
                "all()\n"
                "local again = collectgarbage 'count' - before - made\n"
                "assert(made > 8 and again < 2, made .. ' and ' .. again .. ' KiB')"),
            "");
}

TEST_F(LabModule, PairsGivesEveryMemberOnceInAFreshState) {
  std::size_t members = 0;
  for (const Module* module : modules()) {
    std::string path = "lab";
    const std::size_t dot = module->path.find('.');
    members = module->functions.size() + module->constants.size();
    for (const Module* inner : modules())
      if (inner->path.starts_with(module->path + ".") &&
          inner->path.find('.', module->path.size() + 1) == std::string::npos)
        ++members;
    if (dot != std::string::npos) path += module->path.substr(dot);
    EXPECT_EQ(
        run("local n, seen = 0, {} for name, entry in pairs(" + path +
            ") do assert(not seen[name] and entry ~= nil) seen[name] = true n = n + 1 end assert(n == " +
            std::to_string(members) + ", n)"),
        "")
        << path;
  }
}

TEST_F(Method, IsTheSameFunctionForEveryValueOfItsClass) {
  EXPECT_EQ(run("local a, b = lab.surface.flat{ cells=4, size=1 }, lab.surface.flat{ cells=8, size=1 }\n"
                "assert(a.height == b.height and a.height ~= a.scaled)\n"
                "assert(a:height(0, 0) == 0)"),
            "");
}

}  // namespace
}  // namespace asperity::lua::registry_test

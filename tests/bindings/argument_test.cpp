// SPDX-License-Identifier: GPL-3.0-or-later
// Script functions that fail, return wrong values, yield, or call the laboratory.
#include "bindings/lua/registry/argument.hpp"

#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::argument_test {
namespace {

using FromFunction = LuaTest;
using FromTable = LuaTest;
using Phases = LuaTest;

std::string from_function(const std::string& body) {
  return "lab.surface.from_function{ cells=4, size=1, height=function(x, y) " + body + " end }";
}
const std::string failed = "script.lua:1: lab.surface.from_function: the function `height` failed: ";
const std::string returned = "script.lua:1: lab.surface.from_function: the function `height` returned ";

TEST_F(FromFunction, SeesEveryNodeOnceInOrder) {
  EXPECT_EQ(run("local seen = {}\n"
                "local s = lab.surface.from_function{ cells={3, 2}, size={3, 4}, height=function(x, y)\n"
                "  seen[#seen + 1] = x .. ',' .. y return 10 * x + y end }\n"
                "assert(table.concat(seen, ' ') == '0.0,0.0 1.0,0.0 2.0,0.0 0.0,2.0 1.0,2.0 2.0,2.0')\n"
                "assert(s:height(2, 1) == 22)"),
            "");
}

TEST_F(FromFunction, ErrorsOfAnyKindAreReported) {
  EXPECT_EQ(run(from_function("error('no')")), failed + "script.lua:1: no");
  EXPECT_EQ(run(from_function("error('no', 0)")), failed + "no");
  EXPECT_EQ(run(from_function("error()")), failed + "nothing (nil)");
  EXPECT_EQ(run(from_function("error({})")), failed + "an empty table");
  EXPECT_EQ(run(from_function("error(42)")), failed + "the number 42");
  EXPECT_EQ(run(from_function("error(lab.rigid)")), failed + "a material");
  EXPECT_EQ(
      run(from_function("return nil + 1")).rfind(failed + "script.lua:1: attempt to perform arithmetic", 0),
      0u);
}

TEST_F(FromFunction, WrongResultsAreNamed) {
  const std::string hint = "; it must return a number";
  EXPECT_EQ(run(from_function("")), returned + "nothing (nil)" + hint);
  EXPECT_EQ(run(from_function("return '1'")), returned + "the string \"1\"" + hint);
  EXPECT_EQ(run(from_function("return { 1 }")), returned + "a list of 1" + hint);
  EXPECT_EQ(run(from_function("return true")), returned + "the boolean true" + hint);
  EXPECT_EQ(run(from_function("return 1, error")), "");  // further results are dropped
}

TEST_F(FromFunction, HeightsMustBeFinite) {
  for (const char* bad : {"return 0/0", "return math.huge", "return -math.huge"}) {
    const std::string error = run(from_function(bad));
    EXPECT_EQ(error.rfind("script.lua:1: lab.surface.from_function: ", 0), 0u) << error;
    EXPECT_NE(error.find("finite"), std::string::npos) << error;
  }
}

TEST_F(FromFunction, CannotYield) {
  const std::string error = run("local co = coroutine.wrap(function() return " +
                                from_function("coroutine.yield(1) return 0") + " end)\nco()");
  EXPECT_NE(error.find("attempt to yield across a C-call boundary"), std::string::npos) << error;
}

TEST_F(FromFunction, MayCallTheLaboratory) {
  EXPECT_EQ(run("local base = lab.surface.sine{ cells=4, size=1, amplitude=1 }\n"
                "local s = lab.surface.from_function{ cells=4, size=1, height=function(x, y)\n"
                "  local one = lab.surface.from_function{ cells=1, size=1, height=function() return 1 end }\n"
                "  return base:height(x * 4, y * 4) + one:height(0, 0) end }\n"
                "assert(math.abs(s:height(0, 0) - 2) < 1e-15 and math.abs(s:height(2, 1)) < 1e-15)"),
            "");
}

TEST_F(FromFunction, MayDropTheTableItCameFromWhileItRuns) {
  EXPECT_EQ(run("local t t = { cells=16, size=1, height=function(x, y)\n"
                "  if t then for k in pairs(t) do t[k] = nil end t = nil end\n"
                "  collectgarbage() return x end }\n"
                "local s = lab.surface.from_function(t)\nassert(s:height(8, 0) == 0.5)"),
            "");
}

TEST_F(FromFunction, MayGrowTheTableItCameFromWhileItRuns) {
  EXPECT_EQ(run("local t t = { cells=16, size=1, height=function(x, y) t['k' .. x] = y return 0 end }\n"
                "lab.surface.from_function(t)"),
            "");
}

TEST_F(FromFunction, IsNeededAndMustBeAFunction) {
  EXPECT_NE(run("lab.surface.from_function{ cells=4, size=1 }").find("`height` is missing"),
            std::string::npos);
  EXPECT_NE(run("lab.surface.from_function{ cells=4, size=1, height=1 }")
                .find("`height` is the number 1; give a function(x, y)"),
            std::string::npos);
  EXPECT_EQ(run("lab.surface.from_function{ cells=4, size=1, height=math.max }"), "");  // a C function
}

TEST_F(FromFunction, RunsInsideACoroutine) {
  EXPECT_EQ(run("local s = coroutine.wrap(function() return " + from_function("return x") +
                " end)()\nassert(s:height(1, 0) == 0.25)"),
            "");
}

TEST_F(Phases, FunctionsAreAskedForEveryWave) {
  EXPECT_EQ(run("local calls = 0\n"
                "local s = lab.surface.weierstrass_mandelbrot{ cells=8, D=2.5, M=3, n_max=4,\n"
                "  phases=function(m, n) calls = calls + 1\n"
                "    assert(math.type(m) == 'integer' and math.type(n) == 'integer') return 0 end }\n"
                "assert(calls == 15, calls)"),
            "");
}

TEST_F(Phases, FailuresAreReported) {
  const std::string start = "lab.surface.weierstrass_mandelbrot{ cells=8, D=2.5, phases=";
  EXPECT_EQ(run(start + "function() error('no phase') end }"),
            "script.lua:1: lab.surface.weierstrass_mandelbrot: the function `phases` failed: script.lua:1: "
            "no phase");
  EXPECT_EQ(
      run(start + "function() return {} end }"),
      "script.lua:1: lab.surface.weierstrass_mandelbrot: the function `phases` returned an empty table; it "
      "must return "
      "a number");
  EXPECT_NE(run(start + "function() return 0/0 end }"), "");
  EXPECT_NE(run(start + "'silver' }")
                .find("`phases` is the string \"silver\"; give \"golden\" or a function(m, n)"),
            std::string::npos);
}

TEST_F(FromTable, RowsAreAlongX) {
  EXPECT_EQ(
      run("local s = lab.surface.from_table{ size={3, 2}, heights={ {1, 2, 3}, {4, 5, 6} } }\n"
          "assert(s.cells[1] == 3 and s.cells[2] == 2 and s:height(2, 0) == 3 and s:height(0, 1) == 4)\n"
          "local h = s:heights() assert(#h == 2 and #h[1] == 3 and h[2][3] == 6)"),
      "");
}

TEST_F(FromTable, RaggedRowsAreRefused) {
  EXPECT_EQ(run("lab.surface.from_table{ size=1, heights={ {1, 2}, {3} } }"),
            "script.lua:1: lab.surface.from_table: row 2 of `heights` is a table of 1; every row must have 2 "
            "heights, "
            "as the first has");
  EXPECT_EQ(run("lab.surface.from_table{ size=1, heights={ {1, 2}, 3 } }"),
            "script.lua:1: lab.surface.from_table: row 2 of `heights` is the number 3; every row must have 2 "
            "heights, "
            "as the first has");
  EXPECT_NE(run("lab.surface.from_table{ size=1, heights={ {1, 2, 3}, {3, 4, 5, 6} } }").find("a table of 4"),
            std::string::npos);
}

TEST_F(FromTable, CellsAreNamedByTheirIndex) {
  EXPECT_EQ(
      run("lab.surface.from_table{ size=1, heights={ {1, 2}, {3, '4'} } }"),
      "script.lua:1: lab.surface.from_table: heights[2][2] is the string \"4\"; give a number of metres");
  for (const char* bad : {"0/0", "math.huge", "-math.huge"}) {
    const std::string error =
        run(std::string("lab.surface.from_table{ size=1, heights={ {1, ") + bad + "} } }");
    EXPECT_NE(error.find("finite"), std::string::npos) << error;
  }
}

TEST_F(FromTable, NothingIsNoTable) {
  for (const char* bad : {"{}", "{ {} }", "{ 1, 2 }", "1", "'x'", "{ [2]={1} }"}) {
    const std::string error = run(std::string("lab.surface.from_table{ size=1, heights=") + bad + " }");
    EXPECT_EQ(error.rfind("script.lua:1: lab.surface.from_table: ", 0), 0u) << bad << ": " << error;
    EXPECT_EQ(error.find("internal"), std::string::npos) << error;
  }
}

}  // namespace
}  // namespace asperity::lua::argument_test

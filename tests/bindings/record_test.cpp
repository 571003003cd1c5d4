// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/record.hpp"

#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::record_test {
namespace {

class Result : public LuaTest {
 protected:
  void SetUp() override {
    LuaTest::SetUp();
    ASSERT_EQ(run("s = lab.surface.sine{ cells=16, size='1 mm', amplitude='1 um' }\nr = s:roughness()"), "");
  }
};

class Sweep : public LuaTest {
 protected:
  void SetUp() override {
    LuaTest::SetUp();
    ASSERT_EQ(run("al = lab.material 'Al-2011'\n"
                  "s = lab.surface.sine{ cells=16, size='1 mm', amplitude='1 um', material=al }\n"
                  "c = lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity='box' } }\n"
                  "function sweep() return c:sweep{ approach={ '0.2 um', '0.8 um', '1.4 um' } } end"),
              "");
  }
};

TEST_F(Result, ComplainsAboutAFieldItDoesNotHave) {
  EXPECT_EQ(run("print(r.Raa)")
                .rfind("script.lua:1: a roughness result has no field `Raa` (did you mean `Ra`?); it "
                       "has Ra, Rq, amplitude",
                       0),
            0u)
      << run("print(r.Raa)");
  EXPECT_EQ(run("print(r[1])").rfind("script.lua:1: a roughness result has no field the number 1", 0), 0u);
  EXPECT_EQ(run("print(r[nil])").rfind("script.lua:1: a roughness result has no field nothing (nil)", 0), 0u);
}

TEST_F(Result, NamesTheEffectThatWouldBringAField) {
  ASSERT_EQ(run("al = lab.material 'Al-2011'\n"
                "local c = lab.contact{ lower=s:with{material=al}, upper=s:with{material=al},\n"
                "  effects={ elasticity='box' } }\n"
                "f = lab.friction{ tau0='1 MPa', alpha=0.2 }:on(c:press{ pressure='1 MPa' })"),
            "");
  EXPECT_EQ(run("print(f.interlocking_force)"),
            "script.lua:1: `interlocking_force` needs the effect `interlocking`, which this scene does not "
            "name; name it in the effects of the contact");
  EXPECT_EQ(
      run("for name in pairs(f) do assert(name ~= 'interlocking_force' and name ~= 'strengthening') end"),
      "");
}

TEST_F(Result, CannotBeChanged) {
  EXPECT_EQ(run("r.Ra = 0"), "script.lua:1: a result cannot be changed; copy its fields into a table");
  EXPECT_EQ(run("r.new = 0"), "script.lua:1: a result cannot be changed; copy its fields into a table");
  EXPECT_EQ(value("getmetatable(r)"), "result");
  EXPECT_NE(run("rawset(r, 'Ra', 1)"), "");
}

TEST_F(Result, PrintsItsFieldsWithUnits) {
  const std::string text = value("r");
  EXPECT_EQ(text.rfind("roughness\n  Ra ", 0), 0u) << text;
  EXPECT_NE(text.find("amplitude  2 um"), std::string::npos) << text;
  EXPECT_NE(text.find("skewness   0"), std::string::npos) << text;
}

TEST_F(Result, GoesThroughPairsInOrder) {
  EXPECT_EQ(
      run("local names = {} for name, v in pairs(r) do names[#names + 1] = name assert(v == r[name]) end\n"
          "assert(table.concat(names, ' '):find('^Ra Rq amplitude skewness kurtosis rms_slope peak valley "
          "mean Sa'))\n"
          "assert(#names == 16)"),
      "");
  EXPECT_EQ(run("local next_of = pairs(r)\nassert(next_of(r, 'mean') == 'Sa')\n"
                "assert(next_of(r, 'Sdq') == 'measured')\nassert(next_of(r, 'measured') == "
                "nil)\nassert(next_of(r, 'nonsense') == nil)\n"
                "assert(not pcall(next_of, {}))\nassert(not pcall(next_of, s))"),
            "");
}

TEST_F(Result, OutlivesWhatItCameFrom) {
  EXPECT_EQ(run("local d = s:fractal_dimension{}\ns = nil collectgarbage()\n"
                "assert(type(d.D) == 'number' and #d.steps > 0 and d.steps[1] == 1)"),
            "");
}

TEST_F(Result, ListsInsideAreFreshTables) {
  EXPECT_EQ(
      run("local d = s:fractal_dimension{}\nlocal a, b = d.steps, d.steps\na[1] = 99\nassert(b[1] == 1 and "
          "d.steps[1] == 1)"),
      "");
}

TEST_F(Result, AnAbsentValueIsNilNotAnError) {
  EXPECT_EQ(run("local d = lab.surface.weierstrass_mandelbrot{ cells=64, D=2.5 }:fractal_dimension{ "
                "method='structure' }\n"
                "assert(d.resolved == true and d.reason == nil)"),
            "");
}

TEST_F(Sweep, GivesAStateForEachLoad) {
  EXPECT_EQ(
      run("local n, last = 0, 0\nfor st in sweep() do n = n + 1 assert(st.area > last) last = st.area end\n"
          "assert(n == 3)"),
      "");
}

TEST_F(Sweep, MayBeLeftEarlyAndClosed) {
  EXPECT_EQ(run("for st in sweep() do break end\ncollectgarbage()\n"
                "local steps <close> = sweep()\nassert(steps().approach)"),
            "");
  EXPECT_EQ(run("local kept do local steps <close> = sweep() kept = steps end\nkept()"),
            "script.lua:2: the iterator is finished");
}

TEST_F(Sweep, IsFinishedAfterTheLast) {
  EXPECT_EQ(
      run("local steps = sweep()\nfor _ = 1, 3 do assert(steps()) end\nassert(steps() == nil)\nsteps()"),
      "script.lua:4: the iterator is finished");
}

TEST_F(Sweep, AnErrorInItsMiddleComesOutOfTheLoop) {
  const std::string error =
      run("local n = 0\nfor st in c:sweep{ flatten={ 0.1, 0.2 } } do n = n + 1\n  if n == 2 then "
          "error('enough') end end");
  EXPECT_EQ(error, "script.lua:3: enough");
  EXPECT_NE(run("for st in c:sweep{ flatten={ 0.1, 2 } } do end").find("`flatten` is 2"), std::string::npos);
}

TEST_F(Sweep, StopsWhereItsContactIsClosed) {
  EXPECT_EQ(run("n = 0\nfor st in sweep() do n = n + 1 if n == 1 then c:close() end end"),
            "script.lua:2: the contact of the sweep was closed inside its loop; close it after the loop");
  EXPECT_EQ(value("n"), "1");
}

TEST_F(Sweep, WorksFromACoroutine) {
  EXPECT_EQ(
      run("local steps = coroutine.wrap(function() for st in sweep() do coroutine.yield(st.area) end end)\n"
          "assert(steps() < steps())"),
      "");
}

TEST_F(Sweep, CanBePassedAroundAsAValue) {
  EXPECT_EQ(value("getmetatable(sweep())"), "iterator");
  EXPECT_NE(run("sweep().next = 1"), "");
  EXPECT_NE(value("sweep()").find("iterator"), std::string::npos);
}

}  // namespace
}  // namespace asperity::lua::record_test

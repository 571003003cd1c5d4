// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/value.hpp"
#include "bindings/lua/registry/guard.hpp"

#include <memory>

#include "bindings/lua/surface/surface.hpp"
#include "engine/surface/generators/sphere.hpp"
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::value_test {
namespace {

class NativeValue : public LuaTest {
 protected:
  void SetUp() override {
    LuaTest::SetUp();
    ASSERT_EQ(
        run("s = lab.surface.sine{ cells=8, size='1 mm', amplitude='1 um' }\n"
            "p = s:profile{ row=0 }\nm = lab.material 'Al-2011'\n"
            "c = lab.contact{ lower=s:with{ material=m }, upper=lab.rigid, effects={ elasticity='box' } }\n"
            "st = c:press{ approach='1 um' }\nf = st:field 'pressure'\n"
            "law = lab.friction{ tau0='500 MPa', alpha=0.2 }\n"
            "stylus = lab.stylus{ length='1 mm' }\nbook = lab.notebook 'values'\n"
            "stage = lab.tilt_stage{ contact=c, friction=law, mass='4 g' }\n"
            "all = { s, p, m, c, st, f, law, stylus, book, stage }"),
        "");
  }
};

TEST_F(NativeValue, PrintsWhatItIs) {
  EXPECT_EQ(value("s"), "surface 8 x 8 cells, 1 mm x 1 mm, peak to valley 2 um");
  EXPECT_EQ(value("p"), "profile of 8 samples, 1 mm long, peak to valley 2 um");
  EXPECT_EQ(value("lab.rigid"), "rigid body");
  EXPECT_EQ(value("stylus"), "stylus: tip radius 2 um, 4000 samples every 250 nm");
  EXPECT_EQ(value("book"), "notebook \"values\": 0 rows of 0 columns");
  for (const char* name : {"m", "c", "st", "f", "law", "stage"}) {
    const std::string text = value(name);
    EXPECT_EQ(text.find("userdata"), std::string::npos) << text;
    EXPECT_EQ(text.find("error"), std::string::npos) << text;
    EXPECT_GT(text.size(), 4u);
  }
}

TEST_F(NativeValue, AStatePrintsItsCostAndItsResidual) {
  const std::string text = value("st");
  for (const char* part : {"transforms", "residual"}) EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST_F(NativeValue, CannotBeChanged) {
  EXPECT_EQ(run("s.cells = 3"),
            "script.lua:1: a surface cannot be changed (field `cells`); its methods return new values");
  EXPECT_EQ(run("s[1] = 3"), "script.lua:1: a surface cannot be changed; its methods return new values");
  EXPECT_EQ(run("for _, v in ipairs(all) do assert(not pcall(function() v.anything = 1 end)) end"), "");
}

TEST_F(NativeValue, ComplainsAboutFieldsItDoesNotHave) {
  EXPECT_EQ(run("print(s.cell)"), "script.lua:1: a surface has no field `cell` (did you mean `cells`?)");
  EXPECT_EQ(run("print(s.scale)"), "script.lua:1: a surface has no field `scale` (did you mean `scaled`?)");
  EXPECT_EQ(run("print(st.presure)"),
            "script.lua:1: a state has no field `presure` (did you mean `pressure`?)");
  EXPECT_EQ(run("print(s[1])"),
            "script.lua:1: a surface was indexed with the number 1; its fields have names");
  EXPECT_EQ(run("print(s[nil])"),
            "script.lua:1: a surface was indexed with nothing (nil); its fields have names");
  EXPECT_EQ(
      run("s:scalled{}").rfind("script.lua:1: a surface has no field `scalled` (did you mean `scaled`?)", 0),
      0u);
}

TEST_F(NativeValue, EveryDeclaredFieldCanBeRead) {
  const struct {
    const char* global;
    const Class* type;
  } values[] = {
      {"s", &class_of<Surface>()},  {"p", &class_of<Profile>()},      {"m", find_class("Material")},
      {"c", find_class("Contact")}, {"st", find_class("State")},      {"f", find_class("Field")},
      {"law", find_class("Law")},   {"book", find_class("Notebook")}, {"stylus", find_class("Stylus")}};
  for (const auto& entry : values) {
    ASSERT_NE(entry.type, nullptr);
    for (const Getter& field : entry.type->fields) {
      const std::string text = value(std::string(entry.global) + "." + field.name);
      // Only quantities of absent effects are errors.
      EXPECT_TRUE(text.rfind("error: ", 0) != 0 || text.find("plasticity") != std::string::npos)
          << entry.global << "." << field.name << ": " << text;
    }
    for (const Function& method : entry.type->methods)
      EXPECT_EQ(value("type(" + std::string(entry.global) + "." + method.name + ")"), "function")
          << method.name;
  }
}

TEST_F(NativeValue, TracesAreAPlainListWithNamedFields) {
  ASSERT_EQ(run("traces = stylus:scan(s:with{ material=m }, { count=3 })"), "");
  EXPECT_EQ(value("type(traces)"), "table");
  EXPECT_EQ(value("#traces"), "3");
  EXPECT_EQ(value("traces[3].points"), "4000");
  EXPECT_EQ(value("traces.tip_effect.greatest_lift >= traces.tip_effect.mean_lift"), "true");
  EXPECT_EQ(value("#traces.lines"), "3");
}

TEST_F(NativeValue, HidesItsMetatable) {
  EXPECT_EQ(value("getmetatable(s)"), "Surface");
  EXPECT_EQ(run("for _, v in ipairs(all) do assert(type(getmetatable(v)) == 'string') end"), "");
  EXPECT_EQ(run("setmetatable(s, {})"),
            "script.lua:1: bad argument #1 to 'setmetatable' (table expected, got Surface)");
}

TEST_F(NativeValue, EqualContentIsEqual) {
  EXPECT_TRUE(holds("s == lab.surface.sine{ cells=8, size='1 mm', amplitude='1 um' }"));
  EXPECT_TRUE(holds("s == s:mirrored():mirrored()"));
  EXPECT_TRUE(holds("s ~= s:scaled{ amplitude='1 um' }"));
  EXPECT_TRUE(holds("lab.material 'Al-2011' == m and m ~= lab.rigid"));
  EXPECT_TRUE(holds("s ~= p and s ~= 3 and s ~= m and c ~= st"));
  EXPECT_TRUE(holds("p == s:profile{ row=0 }"));
  EXPECT_TRUE(holds("c:press{ approach='1 um' } == st and c:press{ approach='1.5 um' } ~= st"));
}

TEST_F(NativeValue, OrderAndArithmeticAreErrors) {
  EXPECT_NE(run("return s < s").find("attempt to compare two Surface values"), std::string::npos);
  EXPECT_NE(run("return s + 1").find("one side is the number 1, the other a surface"), std::string::npos);
  EXPECT_NE(run("return #s").find("get length of a Surface value"), std::string::npos);
  EXPECT_NE(run("return s .. 'x'").find("concatenate a Surface value"), std::string::npos);
  EXPECT_NE(run("s()").find("call a Surface value"), std::string::npos);
}

TEST_F(NativeValue, IsClosedAtTheEndOfItsBlock) {
  EXPECT_EQ(run("local kept\ndo local x <close> = s:mirrored() kept = x assert(kept:height(0, 0)) end\n"
                "assert(tostring(kept) == 'a surface (closed)', tostring(kept))\n"
                "kept:height(0, 0)"),
            "script.lua:4: surface:height: a surface was used after it was closed");
  EXPECT_EQ(run("local kept do local x <close> = s:mirrored() kept = x end\nlocal n = kept.cells"),
            "script.lua:2: a surface was used after it was closed");
  EXPECT_EQ(run("local kept do local x <close> = s:mirrored() kept = x end\nlab.contact{ lower=kept, "
                "upper=lab.rigid, effects={ elasticity='box' } }"),
            "script.lua:2: lab.contact: `lower` was closed");
  EXPECT_EQ(run("local kept do local x <close> = s:mirrored() kept = x end\nlab.contact{ lower=s, "
                "upper=kept, effects={ elasticity='box' } }"),
            "script.lua:2: lab.contact: `upper` was closed");
  EXPECT_EQ(run("local kept do local x <close> = s:mirrored() kept = x end\ns:plus(kept)"),
            "script.lua:2: surface:plus: `other` was closed");
}

TEST_F(NativeValue, ClosingFreesItsMemoryAtOnce) {
  collect();
  const std::int64_t before = memory::held();
  EXPECT_EQ(run("big = lab.surface.flat{ cells=1024, size=1 }"), "");
  EXPECT_GE(memory::held() - before, 8 << 20);
  EXPECT_EQ(run("do local x <close> = big end"), "");
  EXPECT_LT(memory::held() - before, 1 << 20);
}

TEST_F(NativeValue, IsClosedWhenAnErrorLeavesItsBlock) {
  EXPECT_EQ(run("local kept\nlocal ok = pcall(function() local x <close> = s:mirrored() kept = x "
                "error('out') end)\n"
                "assert(not ok and tostring(kept) == 'a surface (closed)')"),
            "");
}

TEST_F(NativeValue, AContactClosesByNameToo) {
  EXPECT_EQ(run("c:close()\nc:press{ approach=1e-6 }"),
            "script.lua:2: contact:press: a contact was used after it was closed");
  EXPECT_EQ(run("c:close() c:close()"), "");
  EXPECT_EQ(run("assert(st.area >= 0) stage:raise()"), "");
}

TEST_F(NativeValue, ClosingTwiceAndCollectingAfterwardsIsHarmless) {
  EXPECT_EQ(run("do local a <close> = s local b <close> = s end\ns = nil collectgarbage() collectgarbage()"),
            "");
}

TEST_F(NativeValue, IsFreedWhenCollectedAndWhenTheStateCloses) {
  const auto surface = std::make_shared<Surface>(flat_surface({make_grid(4, 4, 1, 1)}, Monitor::silent()));
  auto action = [&](lua_State* inner) {
    lua_newtable(inner);
    for (int k = 1; k <= 100; ++k) {
      push(inner, object(surface));
      lua_rawseti(inner, -2, k);
    }
    lua_setglobal(inner, "many");
    return 0;
  };
  ASSERT_EQ(protect(L, 0, 0, action), LUA_OK);
  EXPECT_EQ(surface.use_count(), 101);
  EXPECT_EQ(run("for k = 1, 50 do many[k] = nil end"), "");
  collect();
  EXPECT_EQ(surface.use_count(), 51);
  state.reset();
  EXPECT_EQ(surface.use_count(), 1);
}

TEST_F(NativeValue, ServesAsATableKeyByIdentity) {
  EXPECT_EQ(run("local t = { [s]=1 } assert(t[s] == 1 and t[s:mirrored():mirrored()] == nil)"), "");
}

TEST_F(NativeValue, ReadsFieldsAsPlainSiNumbers) {
  EXPECT_EQ(value("s.cells[1] .. 'x' .. s.cells[2]"), "8x8");
  EXPECT_EQ(value("math.type(s.cells[1])"), "integer");
  EXPECT_EQ(value("s.size[1]"), "0.001");
  EXPECT_EQ(value("s.material"), "nil");
  EXPECT_EQ(value("s:with{ material=m }.material.name"), "Al-2011");
}

}  // namespace
}  // namespace asperity::lua::value_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/contact/state_class.hpp"

#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::state_error_test {
namespace {

class ErrorOfState : public LuaTest {
 protected:
  void SetUp() override {
    LuaTest::SetUp();
    ASSERT_EQ(
        run("rough = lab.surface.self_affine{ cells=16, size='16 um', hurst=0.8, rms_slope=0.1, "
            "short_wave='4 um', material=lab.material{ young='70 GPa', poisson=0.3, hardness='2 GPa' } }\n"
            "function pressed(how, effects)\n"
            "  effects = effects or { elasticity='half_space' }\n"
            "  return lab.contact{ lower=rough, upper=lab.rigid, boundary='periodic', effects=effects }"
            ":press(how)\n"
            "end\n"
            "st = pressed{ pressure='500 MPa' }"),
        "");
  }
};

TEST_F(ErrorOfState, HasABoundForEveryQuantity) {
  EXPECT_TRUE(holds("st.error.algebraic.approach > 0 and st.error.algebraic.approach < 1e-3 * st.approach"));
  EXPECT_TRUE(holds("st.error.algebraic.energy > 0 and st.error.algebraic.energy < 1e-3 * st.energy"));
  EXPECT_TRUE(holds("st.error.algebraic.load < 1e-12 * st.load"));
  EXPECT_TRUE(holds("st.error.algebraic.nodes_in_contact_low <= st.nodes_in_contact"));
  EXPECT_TRUE(holds("st.error.algebraic.nodes_in_contact_high >= st.nodes_in_contact"));
  EXPECT_TRUE(holds("st.error.algebraic.area_fraction_low == st.error.algebraic.nodes_in_contact_low / 256"));
  EXPECT_TRUE(holds("st.error.algebraic.area_high <= st.error.algebraic.area_fraction_high * 256.001e-12"));
  EXPECT_TRUE(holds("st.error.algebraic.cost.transforms >= 4"));
}

TEST_F(ErrorOfState, OfPlasticityNeedsIt) {
  for (const char* name :
       {"plastic_volume", "plastic_fraction", "plastic_fraction_low", "plastic_fraction_high"})
    EXPECT_TRUE(holds(std::string("st.error.algebraic.") + name + " == nil")) << name;
  EXPECT_EQ(run("local e = pressed({ pressure='1.5 GPa' }, { elasticity='half_space', plasticity={} }).error"
                ".algebraic\n"
                "assert(e.plastic_volume > 0 and e.plastic_fraction_low <= e.plastic_fraction_high)"),
            "");
}

TEST_F(ErrorOfState, EveryFieldIsANumberOrNil) {
  for (const char* how :
       {"{ flatten=0.1 }", "{ pressure='500 MPa' }", "{ approach='10 nm' }", "{ pressure=0 }"})
    for (const Getter& field : class_of<StateBounds>().fields) {
      if (field.name == "cost") continue;
      const std::string kind =
          value(std::string("math.type(pressed") + how + ".error.algebraic." + field.name + ")");
      const std::string of_nil = value(std::string("pressed") + how + ".error.algebraic." + field.name);
      EXPECT_TRUE(kind == "float" || kind == "integer" || of_nil == "nil")
          << how << field.name << ": " << kind;
    }
  EXPECT_TRUE(holds("pressed{ flatten=0.1 }.error.algebraic.load == nil"));
  EXPECT_TRUE(holds("pressed{ flatten=0.1 }.error.algebraic.approach > 0"));
}

TEST_F(ErrorOfState, NamesAreCheckedAndNearestOnesOffered) {
  EXPECT_EQ(run("print(st.error.algebriac)"),
            "script.lua:1: the error of a state has no field `algebriac` (did you mean `algebraic`?)");
  EXPECT_EQ(run("print(st.error.algebraic.enrgy)"),
            "script.lua:1: an algebraic error has no field `enrgy` (did you mean `energy`?)");
  EXPECT_NE(run("st.error.algebraic.energy = 0").find("an algebraic error cannot be changed"),
            std::string::npos);
}

TEST_F(ErrorOfState, PrintsItsBounds) {
  const std::string text = value("tostring(st.error.algebraic)");
  EXPECT_EQ(text.rfind("algebraic error, at most\n  load ", 0), 0U) << text;
  EXPECT_NE(text.find("\n  approach "), std::string::npos) << text;
  EXPECT_NE(text.find(" of 256"), std::string::npos) << text;
  EXPECT_EQ(text.find("plastic"), std::string::npos) << text;
}

TEST_F(ErrorOfState, IsKnownByNameToADryRun) {
  session.dry_run = true;
  session.run.reset();
  open();
  const std::string script =
      "local st = lab.contact{ lower=lab.surface.flat{ cells=8, size=1 }, upper=lab.rigid, boundary='free', "
      "effects={ elasticity={ model='box', stiffness=1 } } }:press{ pressure=1 }\n";
  EXPECT_EQ(run(script + "local x = st.error.algebraic.approach * 2"), "");
  EXPECT_NE(run(script + "local x = st.error.algebraic.aproach").find("did you mean `approach`?"),
            std::string::npos);
}

}  // namespace
}  // namespace asperity::lua::state_error_test

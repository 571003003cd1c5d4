// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::explain_test {
namespace {

class Explain : public LuaTest {
 protected:
  void SetUp() override {
    LuaTest::SetUp();
    ASSERT_EQ(
        run("rough = lab.surface.self_affine{ cells=48, size='48 um', hurst=0.8, rms_slope=0.1,\n"
            "  short_wave='6 um', material=lab.material{ young='70 GPa', poisson=0.3, hardness='2 GPa' } }\n"
            "c = lab.contact{ lower=rough, upper=lab.rigid, boundary='periodic',\n"
            "  effects={ elasticity='half_space', plasticity={} } }\n"
            "st = c:copy():press{ pressure='500 MPa' }"),
        "");
  }
};

TEST_F(Explain, SaysWhatEachControlTakes) {
  for (const char* key : {"pressure", "load", "approach", "indentation", "flatten"}) {
    ASSERT_EQ(run("key = '" + std::string(key) + "'\nplan = c:explain{ [key]=st[key] }"), "") << key;
    EXPECT_TRUE(holds("plan.transforms == c:copy():press{ [key]=st[key] }.cost.transforms")) << key;
    EXPECT_TRUE(holds(
        "tostring(plan):find('expected of the press by `' .. key .. '`, from a trial on all 48 x 48', 1, "
        "true) ~= nil"))
        << key;
  }
}

TEST_F(Explain, WithoutAPressSaysThatItIsAGuess) {
  EXPECT_TRUE(holds("c:explain().transforms == 40 and c:explain().press == ''"));
  EXPECT_NE(value("tostring(c:explain())").find("of a press by `pressure`, a rough guess"),
            std::string::npos);
}

TEST_F(Explain, MistakesAreThoseOfAPress) {
  for (const char* keys :
       {"{ presure=1e6 }", "{}", "{ pressure=1e6, load=1 }", "{ flatten=2 }", "{ approach='1 Pa' }"}) {
    std::string of_press = run("c:copy():press" + std::string(keys));
    const auto at = of_press.find("contact:press");
    ASSERT_NE(at, std::string::npos) << of_press;
    of_press.replace(at, 13, "contact:explain");
    EXPECT_EQ(run("c:explain" + std::string(keys)), of_press) << keys;
  }
  EXPECT_NE(run("c:explain{ presure=1e6 }").find("did you mean `pressure`"), std::string::npos);
}

TEST_F(Explain, ChangesNothing) {
  ASSERT_EQ(
      run("d = c:copy()\nbefore = lab.ledger().transforms\n"
          "lower, upper = d:lower().digest, d:upper().digest\n"
          "for _, key in ipairs{ 'pressure', 'approach', 'flatten' } do d:explain{ [key]=st[key] } end\n"
          "after = lab.ledger().transforms"),
      "");
  EXPECT_TRUE(holds("after == before"));
  EXPECT_TRUE(holds("d:lower().digest == lower and d:upper().digest == upper"));
  EXPECT_TRUE(holds("d:press{ pressure='500 MPa' }.digest == st.digest"));
}

}  // namespace
}  // namespace asperity::lua::explain_test

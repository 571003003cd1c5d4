// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/variation.hpp"

#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::variation_test {
namespace {

class VariationTest : public LuaTest {
 protected:
  void SetUp() override {
    LuaTest::SetUp();
    session.variation = std::make_shared<Variation>();
  }
  Variation& variation() { return *session.variation; }
};

TEST_F(VariationTest, ReplacesAKeyWhereACallGivesIt) {
  variation().set("cells=6");
  EXPECT_EQ(run("assert(lab.surface.flat{ cells=4, size=1 }.cells[1] == 6)"), "");
  variation().check_all_met();
  EXPECT_EQ(variation().text(), "cells = 6");
}

TEST_F(VariationTest, IsCheckedLikeAnyOtherValue) {
  variation().set("cells=ten");
  EXPECT_EQ(
      run("lab.surface.flat{ cells=4, size=1 }"),
      "script.lua:1: lab.surface.flat: `cells` is the string \"ten\"; give a whole number from 1 to 65536");
}

TEST_F(VariationTest, AQuantityMayCarryItsUnitAndQuotes) {
  variation().set("size=\"2 um\"");
  EXPECT_EQ(run("assert(lab.surface.flat{ cells=4, size=1 }.size[1] == 2e-6)"), "");
}

TEST_F(VariationTest, OfOneCallLeavesOthersAloneAndGivesTheKeyWhereItIsLeftOut) {
  variation().set("sine.amplitude=0.5");
  variation().set("lab.surface.self_affine.seed=9");
  EXPECT_EQ(run("local s = lab.surface.sine{ cells=8, size=1, amplitude=0.1 }\n"
                "assert(s:height(0, 0) == 0.5)\n"
                "local keys = { cells=8, size=1, hurst=0.8, rms_height=1, short_wave=0.5, seed=9 }\n"
                "local nine = lab.surface.self_affine(keys).digest\n"
                "keys.seed = nil\n"
                "assert(lab.surface.self_affine(keys).digest == nine)"),
            "");
  variation().check_all_met();
}

TEST_F(VariationTest, HoldsWhileItIsInForce) {
  bool now = false;
  variation().in_force = [&] { return now; };
  variation().set("cells=6");
  EXPECT_EQ(run("assert(lab.surface.flat{ cells=4, size=1 }.cells[1] == 4)"), "");
  now = true;
  EXPECT_EQ(run("assert(lab.surface.flat{ cells=4, size=1 }.cells[1] == 6)"), "");
}

TEST_F(VariationTest, OneThatNoCallMeetsIsAnErrorWithTheNearestKey) {
  variation().set("cels=6");
  EXPECT_EQ(run("lab.surface.flat{ cells=4, size=1 }"), "");
  try {
    variation().check_all_met();
    FAIL() << "it was passed over";
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "no call gives the key `cels` (did you mean `cells`?); keys that were given: cells and size");
  }
  EXPECT_THROW(variation().set("cells"), Error);
  EXPECT_THROW(variation().set("=3"), Error);
  EXPECT_THROW(variation().set("press.=3"), Error);
}

TEST_F(VariationTest, OneThatOtherCallsMeetSaysWhichTheyAre) {
  variation().set("read.cells=6");
  EXPECT_EQ(run("lab.surface.flat{ cells=4, size=1 } lab.surface.sine{ cells=4, size=1, amplitude=0 }"), "");
  try {
    variation().check_all_met();
    FAIL() << "it was passed over";
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("no call of `read` gives the key `cells`, which `lab.surface.flat` and "
                           "`lab.surface.sine` give; keys that were given: "),
              std::string::npos)
        << message;
  }
}

}  // namespace
}  // namespace asperity::lua::variation_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include <string_view>
#include <vector>

#include "bindings/lua/surface/surface.hpp"
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::holed_surfaces_test {
namespace {

class HoledSurface : public LuaTest {
 protected:
  void SetUp() override {
    LuaTest::SetUp();
    ASSERT_EQ(
        run("s = lab.surface.from_function{ cells={6, 5}, size={6, 5}, material=lab.material \"Al-2011\",\n"
            "  height=function(x, y) return x + 10 * y end }\n"
            "m = s:masked{ mask=function(x, y, z) return x == 2 and y == 1 end }"),
        "");
  }
};

TEST_F(HoledSurface, SaysWhatWasMeasured) {
  EXPECT_TRUE(holds("s.measured == 30 and m.measured == 29"));
  EXPECT_TRUE(holds("m.mask:value(2, 1) == 0 and m.mask:value(1, 2) == 1 and s.mask.min == 1"));
  EXPECT_TRUE(holds("m:height(2, 1) ~= m:height(2, 1)"));
  EXPECT_TRUE(holds("m:heights()[2][3] ~= m:heights()[2][3] and m:heights()[3][2] == 21"));
  EXPECT_EQ(value("m"),
            "surface 6 x 5 cells, 6 m x 5 m, peak to valley 45 m, 1 of 30 points not measured, Al-2011");
  EXPECT_EQ(value("s").find("not measured"), std::string::npos);
  EXPECT_TRUE(holds("m ~= s and m == s:masked{ mask=m.mask } and s == s:masked{ mask=s.mask }"));
  EXPECT_TRUE(holds("m:roughness().measured == 29 and s:roughness().measured == nil"));
  EXPECT_TRUE(holds("m:spectrum().measured == 29"));
  EXPECT_TRUE(holds("m:profile{ row=1 }.measured == 5 and m:profile{ row=1 }.mask[3] == 0"));
  EXPECT_EQ(value("m:profile{ row=1 }"),
            "profile of 6 samples, 6 m long, peak to valley 5 m, 1 of 6 points not measured");
}

TEST_F(HoledSurface, IsMaskedInOneWay) {
  EXPECT_EQ(run("s:masked{}"),
            "script.lua:1: surface:masked: give one of `mask` and `outliers`; none is given");
  EXPECT_NE(run("s:masked{ mask=function() return true end, outliers=\"mad\" }").find("both are given"),
            std::string::npos);
  EXPECT_NE(run("s:masked{ mask=function() return 1 end }")
                .find("returned the number 1; it must return true or false"),
            std::string::npos);
  EXPECT_NE(run("s:masked{ mask=function() end }").find("it must return true or false"), std::string::npos);
  EXPECT_NE(run("s:masked{ mask=function() return true end }").find("leaves no measured point"),
            std::string::npos);
  EXPECT_NE(
      run("s:masked{ mask=lab.surface.flat{ cells=6, size=1 }.mask }").find("the mask has 6 x 6 points"),
      std::string::npos);
  EXPECT_NE(run("s:masked{ outliers=\"sigma\" }").find("`outliers` is \"sigma\"; give \"mad\""),
            std::string::npos);
  EXPECT_NE(run("s:masked{ outliers={ factr=3 } }").find("did you mean `factor`?"), std::string::npos);
  EXPECT_NE(run("s:outliers{ window=4 }").find("give an odd number, e.g. 5"), std::string::npos);
  EXPECT_NE(run("m:filled{}").find("`by=\"interpolate\"` or `value=`"), std::string::npos);
  EXPECT_NE(run("m:filled{ by=\"interpolate\", value=0 }").find("not both"), std::string::npos);
  EXPECT_TRUE(holds("m:filled{ by=\"interpolate\" }.measured == 30"));
  EXPECT_TRUE(holds("m:filled{ value=\"3 m\" }:height(2, 1) == 3"));
}

TEST_F(HoledSurface, OutliersAreNamedAndTold) {
  struct Heard final : Monitor {
    void progress(std::string_view, double) override {}
    void warn(std::string_view sentence) override { warnings.emplace_back(sentence); }
    std::vector<std::string> warnings;
  } heard;
  const Session::Reporting here(session, heard);
  ASSERT_EQ(
      run("local r = lab.surface.self_affine{ cells=64, size=64, hurst=0.8, ra=1, short_wave=4, seed=2 }\n"
          "spiky = r + lab.surface.from_function{ cells=64, size=64,\n"
          "  height=function(x, y) return x == 30 and y == 20 and 50 or 0 end }\n"
          "found = spiky:outliers{ factor=8 }\n"
          "clean = spiky:masked{ outliers={ rule=\"mad\", factor=8 } }"),
      "");
  EXPECT_TRUE(holds("found.marked == 1 and found.rule == \"mad\" and found.mask:value(30, 20) == 0"));
  EXPECT_TRUE(holds("clean.measured == 64 * 64 - 1 and clean == spiky:masked{ mask=found.mask }"));
  EXPECT_TRUE(holds("spiky.measured == 64 * 64"));
  ASSERT_EQ(heard.warnings.size(), 1U);
  EXPECT_TRUE(
      heard.warnings[0].starts_with("script.lua:5: surface:masked: 1 of 4096 measured points are outliers by "
                                    "the rule \"mad\", factor 8 and window 5 (more than "))
      << heard.warnings[0];
  ASSERT_EQ(run("spiky:masked{ outliers={ factor=1000 } }"), "");  // no outlier, no warning
  EXPECT_EQ(heard.warnings.size(), 1U);
}

TEST_F(HoledSurface, IsRefusedByAContactWhichNamesTheBody) {
  const auto contact = [&](const std::string& lower, const std::string& upper) {
    return run("\nlab.contact{ lower=" + lower + ", upper=" + upper +
               ", boundary=\"periodic\", effects={ elasticity=\"half_space\" } }");
  };
  EXPECT_EQ(contact("m", "lab.rigid"),
            "script.lua:2: lab.contact: 1 of the 30 points of the lower body were not measured, and a "
            "contact needs "
            "every point; fill them first, `lower = surface:filled{ by=\"interpolate\" }`, or crop the "
            "surface to a "
            "part without holes");
  EXPECT_NE(contact("s", "m").find("of the upper body were not measured"), std::string::npos);
  EXPECT_EQ(contact("m:filled{ by=\"interpolate\" }", "lab.rigid"), "");
  EXPECT_NE(run("lab.stylus{ tip=\"2 um\", spacing=\"1 um\", length=\"0.1 mm\" }:closed(m)")
                .find("were not measured"),
            std::string::npos);
}

TEST_F(HoledSurface, IsKnownInADryRun) {
  session.dry_run = true;
  session.run.reset();
  open();
  EXPECT_EQ(run("local s = lab.surface.flat{ cells=8, size=1 }\n"
                "local m = s:masked{ outliers=\"mad\" }\n"
                "local d = 2 * (m - s:masked{ mask=function() return true end }) / 3\n"
                "local x = -(d + s):filled{ by=\"interpolate\" }.measured + 1\n"
                "print(d:roughness().measured, d.mask:value(0, 0), s:outliers{}.marked)"),
            "");
}

TEST_F(HoledSurface, ArithmeticIsThatOfHeights) {
  ASSERT_EQ(run("t = lab.surface.from_function{ cells={6, 5}, size={6, 5}, height=function(x, y) return x * "
                "y end }"),
            "");
  EXPECT_TRUE(holds("(s + t):height(3, 4) == 43 + 12 and s + t == s:plus(t)"));
  EXPECT_TRUE(holds("(s - t):height(3, 4) == 43 - 12 and s - t == s:minus(t)"));
  EXPECT_TRUE(holds("(-s):height(3, 4) == -43 and -(-s) == s"));
  EXPECT_TRUE(holds("(2 * s):height(3, 4) == 86 and 2 * s == s * 2 and s / 2 == s * 0.5"));
  EXPECT_TRUE(holds("(s / 4):height(1, 0) == 0.25 and (2 * s - s) == s"));
  EXPECT_TRUE(holds("(m - t).measured == 29 and (t + m).measured == 29"));
  EXPECT_TRUE(holds("(s - t).material.name == \"Al-2011\" and (t - s).material == nil"));
}

TEST_F(HoledSurface, ArithmeticRefusesWhatHasNoMeaning) {
  EXPECT_EQ(run("return s - 5"),
            "script.lua:1: a - b: one side is the number 5, the other a surface; give two surfaces of equal "
            "cells and size; `levelled{ degree=0 }` removes the mean height");
  EXPECT_NE(run("return 5 + s").find("one side is the number 5"), std::string::npos);
  EXPECT_NE(run("return s + nil").find("one side is nothing"), std::string::npos);
  EXPECT_NE(run("return s * s").find("one must be a surface, the other a plain number"), std::string::npos);
  EXPECT_NE(run("return 2 / s").find("a surface can be divided by a plain number"), std::string::npos);
  EXPECT_NE(run("return s / 0").find("give a finite number other than 0"), std::string::npos);
  EXPECT_NE(run("return s * (0 / 0)").find("give a finite number"), std::string::npos);
  EXPECT_NE(run("return \"2\" * s").find("the string \"2\""), std::string::npos);
  EXPECT_NE(run("return s - lab.surface.flat{ cells=6, size=6 }").find("cannot be subtracted"),
            std::string::npos);
  EXPECT_NE(run("return s:minus(3)").find("`other` is the number 3; give a surface"), std::string::npos);
  EXPECT_NE(run("return s - lab.surface.flat{ cells={6, 5}, size=6 }").find("m cannot be subtracted"),
            std::string::npos);
  EXPECT_NE(run("return s // 2"), "");
  EXPECT_NE(run("return s ^ 2"), "");
}

TEST_F(HoledSurface, OperatorsAreTold) {
  const Class& type = class_of<Surface>();
  ASSERT_EQ(type.operators.size(), 5u);
  for (const Operator& operation : type.operators) EXPECT_NE(operation.sentence, "") << operation.event;
}

TEST_F(HoledSurface, ProfilesToo) {
  ASSERT_EQ(run("p = s:profile{ row=0 }\nq = p:masked{ mask=function(x, z) return x > 1.5 and x < 3.5 end }"),
            "");
  EXPECT_TRUE(holds("q.measured == 4 and q.mask[3] == 0 and q.mask[4] == 0 and q.mask[5] == 1"));
  EXPECT_TRUE(holds("q == p:masked{ mask={ 1, 1, 0, 0, 1, 1 } }"));
  EXPECT_TRUE(holds("math.abs(q:filled{ by=\"interpolate\" }:heights()[3] - 2) < 1e-11"));
  EXPECT_TRUE(holds("q:heights()[3] ~= q:heights()[3] and q:roughness().measured == 4"));
  EXPECT_NE(run("p:masked{ mask={ 1, 1 } }").find("the mask has 2 points, and the profile 6"),
            std::string::npos);
  EXPECT_NE(run("p:masked{ mask={ 1, true, 1, 1, 1, 1 } }").find("other values than numbers"),
            std::string::npos);
}

}  // namespace
}  // namespace asperity::lua::holed_surfaces_test

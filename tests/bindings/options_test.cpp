// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings/lua/registry/options.hpp"

#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::options_test {
namespace {

using Options = LuaTest;

TEST(Held, CallsWithWhatWasCaptured) {
  const std::string large(100, 'x');
  const std::size_t small = large.size() - 97;
  EXPECT_FALSE(Held<std::size_t(std::size_t)>());
  Held<std::size_t(std::size_t)> held([large](std::size_t k) { return large.size() + k; });
  const auto copy = held;
  held = [small](std::size_t k) { return small + k; };
  EXPECT_EQ(copy(1), 101u);
  EXPECT_EQ(held(1), 4u);
}

TEST_F(Options, UnknownKeysNameTheNearestAndAllThatThereAre) {
  EXPECT_EQ(
      run("lab.material{ young='70 GPa', poisson=0.3, hardnes='1 GPa' }"),
      "script.lua:1: lab.material: unknown key `hardnes` (did you mean `hardness`?); the keys are young, "
      "poisson, hardness, density and name");
  EXPECT_EQ(run("lab.surface.flat{ cells=4, size=1, xyzzyx=1 }"),
            "script.lua:1: lab.surface.flat: unknown key `xyzzyx`; the keys are cells, size and material");
}

TEST_F(Options, AllProblemsOfATableAreReportedTogether) {
  EXPECT_EQ(
      run("lab.surface.weierstrass_mandelbrot{ cells=0, D=3.5, gama=1.5, L='5 MPa', M='ten', band='al' }"),
      "script.lua:1: lab.surface.weierstrass_mandelbrot: 6 problems\n"
      "  `cells` is 0; give a whole number from 1 to 65536\n"
      "  `D` is 3.5; give a number from 2 to 3\n"
      "  `L`: \"5 MPa\": a pressure where a length is wanted; write it such as \"250 um\"\n"
      "  `M` is the string \"ten\"; give a whole number from 1 to 4096\n"
      "  `band` is \"al\" (did you mean `all`?); give \"all\" or \"resolved\"\n"
      "  unknown key `gama` (did you mean `gamma`?)\n"
      "  the keys are cells, D, span, L, G, gamma, M, n_max, seed, phases, band and material");
}

TEST_F(Options, MissingKeysSayWhatTheyMean) {
  EXPECT_EQ(
      run("lab.surface.flat{ cells=4 }"),
      "script.lua:1: lab.surface.flat: `size` is missing: length of the sides: one value, or {along x, along "
      "y}, e.g. \"250 um\"");
  EXPECT_EQ(
      run("lab.surface.flat()").find("script.lua:1: lab.surface.flat: 2 problems\n  `cells` is missing"), 0u);
  EXPECT_EQ(run("lab.surface.flat{}"), run("lab.surface.flat()"));
}

TEST_F(Options, KeysThatAreNotNamesAreRefused) {
  EXPECT_EQ(run("lab.surface.flat{ 64, cells=4, size=1 }"),
            "script.lua:1: lab.surface.flat: position 1 holds a value without a key; write `key = value`; "
            "the keys are "
            "cells, size and material");
  EXPECT_EQ(run("lab.surface.flat{ [true]=1, cells=4, size=1 }"),
            "script.lua:1: lab.surface.flat: a key is the boolean true; keys are names; the keys are cells, "
            "size and "
            "material");
  EXPECT_NE(
      run("lab.surface.flat{ [{}]=1, cells=4, size=1 }").find("a key is an empty table; keys are names"),
      std::string::npos);
  EXPECT_NE(
      run("lab.surface.flat{ [2.5]=1, cells=4, size=1 }").find("position 2.5 holds a value without a key"),
      std::string::npos);
}

TEST_F(Options, WhatIsNotATableIsRefused) {
  for (const char* wrong : {"64", "'64'", "true", "print", "lab.rigid", "coroutine.create(print)"}) {
    const std::string error = run(std::string("lab.surface.flat(") + wrong + ")");
    EXPECT_NE(error.find("script.lua:1: lab.surface.flat takes one table of named keys, and was given "),
              std::string::npos)
        << error;
    EXPECT_NE(error.find("; write lab.surface.flat{ ... }"), std::string::npos) << error;
  }
}

TEST_F(Options, QuantitiesAreNumbersInSiOrTextWithAUnit) {
  EXPECT_EQ(value("lab.surface.flat{ cells=4, size='250 um' }.size[1]"), "0.00025");
  EXPECT_EQ(value("lab.surface.flat{ cells=4, size=0.00025 }.size[1]"), "0.00025");
  EXPECT_EQ(value("lab.surface.flat{ cells=4, size={ '250 um', 1 } }.size[2]"), "1.0");
  EXPECT_EQ(value("lab.material{ young='70 GPa', poisson=0.3 }.young"), "70000000000.0");
  EXPECT_EQ(value("lab.surface.flat{ cells=4, size=1 }:rotated('90 deg') == "
                  "lab.surface.flat{ cells=4, size=1 }:rotated(math.pi / 2)"),
            "true");
}

TEST_F(Options, UnitsAreCheckedForTheirDimension) {
  EXPECT_EQ(run("lab.surface.flat{ cells=4, size='3 kg' }"),
            "script.lua:1: lab.surface.flat: `size`: \"3 kg\": a mass where a length is wanted; write it "
            "such as \"250 um\"");
  EXPECT_NE(run("lab.surface.flat{ cells=4, size='3 parsec' }").find("`size`: "), std::string::npos);
  EXPECT_NE(run("lab.surface.flat{ cells=4, size='um' }").find("`size`: "), std::string::npos);
  EXPECT_NE(run("lab.surface.flat{ cells=4, size='' }").find("`size`: "), std::string::npos);
  EXPECT_NE(run("lab.surface.flat{ cells=4, size='250' }").find("`size`: "), std::string::npos);
  EXPECT_NE(run("lab.surface.flat{ cells=4, size='2 um\\0' }").find("`size`: "), std::string::npos);
}

TEST_F(Options, RangesHoldToTheLastBit) {
  for (const char* good : {"D=2", "D=3", "D=3-2^-51", "D=2+2^-51"})
    EXPECT_EQ(run(std::string("lab.surface.weierstrass_mandelbrot{ cells=4, n_max=3, ") + good + " }"), "")
        << good;
  for (const char* bad : {"D=2-2^-51", "D=3+2^-50", "D=-1", "D=0/0", "D=math.huge", "D=-math.huge"}) {
    const std::string error =
        run(std::string("lab.surface.weierstrass_mandelbrot{ cells=4, n_max=3, ") + bad + " }");
    EXPECT_NE(error.find("script.lua:1: lab.surface.weierstrass_mandelbrot: `D` is "), std::string::npos)
        << error;
    EXPECT_NE(error.find("give a number from 2 to 3"), std::string::npos) << error;
  }
}

TEST_F(Options, NotANumberAndInfinityAreNoLengths) {
  EXPECT_NE(run("lab.surface.flat{ cells=4, size=0/0 }").find("`size` is "), std::string::npos);
  EXPECT_NE(run("lab.surface.flat{ cells=4, size=math.huge }")
                .find("`size` is inf m; give a finite length above 0"),
            std::string::npos);
  EXPECT_NE(run("lab.surface.flat{ cells=4, size='1e999 um' }").find("`size`"), std::string::npos);
  EXPECT_NE(run("lab.surface.flat{ cells=4, size=0 }").find("`size` is 0 m; give a length above 0"),
            std::string::npos);
}

TEST_F(Options, InfinityMeansNeverWhereThatMakesSense) {
  EXPECT_EQ(value("lab.material{ young=1e9, poisson=0.3, hardness=math.huge }.hardness"), "inf");
  EXPECT_EQ(value("lab.friction{ tau0=1e6, alpha=0.2, tau_max=math.huge }.tau_max"), "nil");
  EXPECT_NE(run("lab.friction{ tau0=1e6, alpha=0.2, tau_max=-math.huge }").find("or math.huge for never"),
            std::string::npos);
}

TEST_F(Options, WholeNumbersMustBeWhole) {
  EXPECT_EQ(run("lab.surface.flat{ cells=4.0, size=1 }"), "");
  EXPECT_NE(run("lab.surface.flat{ cells=4.5, size=1 }").find("`cells` is 4.5; give a whole number"),
            std::string::npos);
  EXPECT_EQ(value("lab.surface.flat{ cells='4', size=1 }.cells[1]"), "4");  // as in "1e-6"
  EXPECT_NE(run("lab.surface.flat{ cells='4.5', size=1 }").find("`cells` is \"4.5\"; give a whole number"),
            std::string::npos);
  EXPECT_NE(run("lab.surface.flat{ cells='4 um', size=1 }")
                .find("\"4 um\": a length where a plain number is wanted"),
            std::string::npos);
  EXPECT_NE(
      run("lab.surface.flat{ cells='four', size=1 }").find("`cells` is the string \"four\"; give a whole"),
      std::string::npos);
  EXPECT_NE(run("lab.surface.flat{ cells=2^53, size=1 }").find("`cells` is "), std::string::npos);
  EXPECT_NE(run("lab.surface.flat{ cells={4, 4, 4}, size=1 }").find("give a whole number or {nx, ny}"),
            std::string::npos);
  EXPECT_NE(run("lab.surface.flat{ cells={4, -1}, size=1 }").find("`cells` is -1"), std::string::npos);
  EXPECT_NE(run("lab.surface.flat{ cells={}, size=1 }").find("`cells` is an empty table"), std::string::npos);
  EXPECT_NE(run("lab.surface.weierstrass_mandelbrot{ cells=4, D=2.5, seed=-1 }").find("`seed` is -1"),
            std::string::npos);
}

TEST_F(Options, NativeValuesAreCheckedForTheirClass) {
  EXPECT_NE(run("lab.surface.flat{ cells=4, size=1, material='quartz' }")
                .find("`material` is the string \"quartz\"; give a material, from lab.material"),
            std::string::npos);
  EXPECT_NE(run("lab.contact{ lower=lab.rigid, upper=lab.rigid, effects={ elasticity='box' } }")
                .find("`lower` is a material; give a surface"),
            std::string::npos);
  EXPECT_NE(run("lab.contact{ lower=io.stdout, upper=lab.rigid, effects={ elasticity='box' } }")
                .find("`lower` is a userdata; give a surface"),
            std::string::npos);
}

TEST_F(Options, TablesInsideTablesJoinTheirProblems) {
  run("s = lab.surface.sine{ cells=8, size=1, amplitude=1e-3 }");
  const std::string error =
      run("lab.contact{ lower=s, upper=lab.rigid, effects={ elasticity={ modl='box' }, gravity=1 },\n"
          "  accuracy={ tolerance=2, precison='double' } }");
  for (const char* part : {"problems", "unknown key `modl` (did you mean `model`?)", "gravity",
                           "`tolerance` is 2", "unknown key `precison` (did you mean `precision`?)"})
    EXPECT_NE(error.find(part), std::string::npos) << part << " in " << error;
}

TEST_F(Options, ExclusiveKeysAreCountedOnlyWhenEachIsGood) {
  run("s = lab.surface.sine{ cells=8, size=1, amplitude=1e-3 }");
  EXPECT_EQ(run("s:scaled{ rms=1, ra=1 }"),
            "script.lua:1: surface:scaled: give exactly one of `amplitude`, `rms` and `ra`; 2 are given");
  EXPECT_EQ(run("s:scaled{ about='base' }"),
            "script.lua:1: surface:scaled: give exactly one of `amplitude`, `rms` and `ra`; 0 are given");
  EXPECT_EQ(run("s:scaled{ rms='1 s' }"),
            "script.lua:1: surface:scaled: `rms`: \"1 s\": a time where a length is wanted; write it such as "
            "\"250 um\"");
}

TEST_F(Options, AFalseOrNilValueIsNotSilentlyADefault) {
  EXPECT_EQ(run("lab.surface.flat{ cells=4, size=1, material=nil }"), "");
  EXPECT_NE(
      run("lab.surface.flat{ cells=4, size=1, material=false }").find("`material` is the boolean false"),
      std::string::npos);
}

TEST_F(Options, MetatablesOfATableAreNotFollowed) {
  EXPECT_NE(
      run("lab.surface.flat(setmetatable({ cells=4 }, { __index={ size=1 } }))").find("`size` is missing"),
      std::string::npos);
  EXPECT_EQ(run("lab.surface.flat(setmetatable({ cells=4, size=1 }, { __pairs=error, __len=error, "
                "__index=error }))"),
            "");
}

TEST_F(Options, AwkwardTextIsQuotedInParts) {
  const std::string error = run("lab.surface.flat{ cells=4, size=1, [('x'):rep(1e6)]=1 }");
  EXPECT_LT(error.size(), 300u);
  EXPECT_LT(run("lab.surface.flat{ cells=4, size=('9'):rep(1e6) }").size(), 400u);
  EXPECT_LT(run("lab.surface.flat{ cells=('9'):rep(1e6), size=1 }").size(), 400u);
  EXPECT_NE(run("lab.surface.flat{ cells=4, size=1, ['a\\0b']=1 }"), "");
  EXPECT_LT(
      run("local t = { cells=4, size=1 } for k = 1, 1e4 do t['k'..k] = 1 end lab.surface.flat(t)").size(),
      4000u);
}

}  // namespace
}  // namespace asperity::lua::options_test

// SPDX-License-Identifier: GPL-3.0-or-later
// accuracy={ estimate=true } and accuracy={ error= } in scripts.
#include "bindings/lua/contact/state_class.hpp"

#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::discretisation_error_test {
namespace {

class AccuracyOfContact : public LuaTest {
 protected:
  void SetUp() override {
    LuaTest::SetUp();
    ASSERT_EQ(
        run("rough = lab.surface.self_affine{ cells=64, size='64 um', hurst=0.8, rms_slope=0.1, "
            "short_wave='8 um', material=lab.material{ young='70 GPa', poisson=0.3, hardness='2 GPa' } }\n"
            "function contact(accuracy)\n"
            "  return lab.contact{ lower=rough, upper=lab.rigid, boundary='periodic',\n"
            "    effects={ elasticity='half_space' }, accuracy=accuracy }\n"
            "end\n"
            "function pressed(accuracy) return contact(accuracy):press{ pressure='500 MPa' } end"),
        "");
  }
};

TEST_F(AccuracyOfContact, EstimatesAreReadByName) {
  ASSERT_EQ(run("st = pressed{ estimate=true }\ne = st.error.discretisation"), "");
  EXPECT_TRUE(holds("e.approach > 0 and e.approach < st.approach"));
  EXPECT_TRUE(holds("e.corrected_area_fraction > 0 and e.corrected_area_fraction < e.area_fraction"));
  EXPECT_TRUE(holds("math.abs(e.area / st.area - e.area_fraction / st.area_fraction) < 1e-12"));
  EXPECT_TRUE(holds("e.pressure == 0 and e.load == 0"));
  EXPECT_TRUE(holds("e:extrapolated 'area_fraction' == st.corrected_area_fraction"));
  EXPECT_TRUE(holds("st.cost.by_effect.estimate.transforms > 0"));
  EXPECT_TRUE(holds("st.cost.by_effect.estimate.transforms < st.cost.by_effect.elasticity.transforms"));
  EXPECT_TRUE(holds("st.chosen == nil"));
  EXPECT_NE(value("tostring(st)").find("error of the grid, estimated: approach "), std::string::npos);
  EXPECT_EQ(
      value("tostring(e)").rfind("discretisation error, estimated from 32 x 32 cells and 16 x 16 cells", 0),
      0U);
  EXPECT_EQ(run("print(e.plastic_volume)"),
            "script.lua:1: `plastic_volume` needs the effect `plasticity`, which this scene does not name");
}

TEST_F(AccuracyOfContact, AFinerGridIsAskedForByName) {
  ASSERT_EQ(run("st = pressed{ estimate='finer' }\ne = st.error.discretisation"), "");
  EXPECT_TRUE(holds("e.approach > 0 and e.approach < st.approach"));
  EXPECT_TRUE(holds("e:extrapolated 'energy' ~= st.energy"));
  EXPECT_TRUE(holds("st.cost.by_effect.estimate.transforms > 7 * st.cost.by_effect.elasticity.transforms"));
  EXPECT_EQ(value("tostring(e)").rfind("discretisation error, estimated from 192 x 192 cells\n", 0), 0U);
  EXPECT_NE(value("contact{ estimate='finer' }:explain()").find("the same press on 192 x 192 cells"),
            std::string::npos);
  EXPECT_EQ(run("contact{ estimate='fine' }"),
            "script.lua:3: lab.contact: `accuracy`: `estimate` is the string \"fine\"; give true, false or "
            "\"finer\"");
  EXPECT_EQ(run("contact{ estimate='finer', error=0.01 }"),
            "script.lua:3: lab.contact: `accuracy`: `error` and `estimate`=\"finer\" are both given; `error` "
            "compares with the coarser grids that it has tried, so leave one of the two out");
}

TEST_F(AccuracyOfContact, NotAskedForCostsNothingAndSaysSo) {
  ASSERT_EQ(run("st = pressed()"), "");
  EXPECT_EQ(run("print(st.error.discretisation.approach)"),
            "script.lua:1: the discretisation error of `approach` was not estimated in this press; give "
            "lab.contact accuracy={ estimate=true }, which solves coarser grids as well");
  EXPECT_EQ(value("tostring(st.error.discretisation)"),
            "discretisation error: not estimated; give lab.contact accuracy={ estimate=true }");
  EXPECT_EQ(value("tostring(st)").find("error of the grid"), std::string::npos);
  EXPECT_EQ(run("local by_effect = st.cost.by_effect; print(by_effect.estimate)").find("estimate") ==
                std::string::npos,
            false);
  EXPECT_TRUE(holds("st.cost.transforms == st.cost.by_effect.elasticity.transforms"));
}

TEST_F(AccuracyOfContact, AnErrorChoosesTheCells) {
  ASSERT_EQ(run("c = contact{ error=0.03 }\nbefore = c:explain()\nst = c:press{ pressure='500 MPa' }"), "");
  EXPECT_NE(value("before").find("the first press chooses cells and tolerance for an error of 3 % of "
                                 "corrected_area_fraction"),
            std::string::npos);
  EXPECT_TRUE(holds("st.chosen.met and st.chosen.error <= 0.03"));
  EXPECT_TRUE(holds("st.chosen.of == 'corrected_area_fraction' and st.chosen.precision == 'double'"));
  EXPECT_EQ(value("st.chosen.why_precision"), "single saves no time");
  ASSERT_EQ(run("named = contact{ error=0.03, precision='single' }:press{ pressure='500 MPa' }.chosen"), "");
  EXPECT_TRUE(holds("named.precision == 'single' and named.why_precision == 'as named'"));
  EXPECT_TRUE(holds("named.text:find('single precision (as named)', 1, true) ~= nil"));
  EXPECT_TRUE(holds("st.chosen.tolerance <= 9e-4 and #st.chosen.tried >= 1"));
  EXPECT_TRUE(holds("c:lower().cells[1] == st.chosen.cells[1]"));
  EXPECT_TRUE(holds("st.chosen.tried[#st.chosen.tried].cells[1] == st.chosen.cells[1]"));
  EXPECT_NE(value("tostring(st)").find("3 % of corrected_area_fraction was requested"), std::string::npos);
  EXPECT_TRUE(holds("st.error.discretisation.corrected_area_fraction <= 0.03 * st.corrected_area_fraction"));
  EXPECT_EQ(run("st = pressed{ error=0.05, of={ 'approach', 'energy' } }"), "");
}

// Interpolated from 32 x 32 nodes, the area had an error of 11 % instead of 3 %.
TEST_F(AccuracyOfContact, AFunctionIsEvaluatedAgainOnFinerCells) {
  ASSERT_EQ(run("local pi = math.pi\n"
                "function waves(n, accuracy, noise)\n"
                "  local f = lab.surface.from_function{ cells=n, size=1, material=lab.material{ young=1e9, "
                "poisson=0 },\n"
                "    height=function(x, y) return .002*(math.cos(2*pi*x)*math.cos(2*pi*y) + "
                ".25*math.cos(2*pi*(13*x+5*y))\n"
                "      + .2*math.cos(2*pi*(7*x-12*y)+1) + (noise or 0) * math.random()) end }\n"
                "  return lab.contact{ lower=f, upper=lab.rigid, boundary='periodic', accuracy=accuracy,\n"
                "    effects={ elasticity='half_space' } }:press{ pressure=1e6 } end\n"
                "st = waves(32, { error=.03 })"),
            "");
  EXPECT_TRUE(holds("math.abs(st.corrected_area_fraction / 0.0516 - 1) < 0.03"));
  EXPECT_TRUE(holds("st.chosen.text:find('generated again', 1, true) ~= nil"));
  // Random heights exist on the first cells only.
  EXPECT_NE(
      run("waves(32, { error=.03 }, 0.01)").find("`error` = 0.03 of `corrected_area_fraction` was requested"),
      std::string::npos);
  EXPECT_TRUE(holds("not waves(32, { error=.03, on_failure='best' }, 0.01).chosen.met"));
}

TEST_F(AccuracyOfContact, LimitsOfAChoiceAreKeys) {
  EXPECT_NE(run("contact{ error=1e-3, at_most={ cells=32 } }:press{ pressure='500 MPa' }")
                .find(" cells a side, and 32 x 32 cells are the most within 32 cells a side; "),
            std::string::npos);
  EXPECT_EQ(
      run("contact{ at_most={ cells=32 } }"),
      "script.lua:3: lab.contact: `accuracy`: `at_most` is given without `error`; give the relative error "
      "as well, such as error=0.01");
  EXPECT_NE(run("contact{ error=1e-3, at_most={ cells=4 } }").find("`cells` is 4"), std::string::npos);
}

TEST_F(AccuracyOfContact, AnExplainedChoiceCountsTheFinestCellsAllowed) {
  ASSERT_EQ(run("c = contact{ error=0.03, at_most={ cells=512 } }\np = c:explain{ pressure='500 MPa' }"), "");
  EXPECT_NE(value("tostring(p)").find(" 512 x 512 cells are the most within 512 cells a side"),
            std::string::npos);
  EXPECT_TRUE(holds("p.bytes > 512^2 * 8 and p.seconds > contact():explain().seconds"));
}

TEST_F(AccuracyOfContact, KeysThatDoNotGoTogether) {
  EXPECT_EQ(run("contact{ error=0.01, tolerance=1e-4 }"),
            "script.lua:3: lab.contact: `accuracy`: `error` and `tolerance` are both given; with `error` the "
            "tolerance is chosen, so leave `tolerance` out");
  EXPECT_EQ(
      run("contact{ of='approach' }"),
      "script.lua:3: lab.contact: `accuracy`: `of` is given without `error`; give the relative error as "
      "well, such as error=0.01");
  EXPECT_EQ(run("contact{ error=1 }"),
            "script.lua:3: lab.contact: `accuracy`: `error` is 1; give a number from 1e-06 and below 1");
  EXPECT_EQ(
      run("contact{ error=0.01, of={} }"),
      "script.lua:3: lab.contact: `accuracy`: `of` is an empty table; give a name such as \"approach\", or a "
      "list of them");
  EXPECT_NE(run("contact{ error=0.01, of='aproach' }").find("whose error is not estimated"),
            std::string::npos);
}

TEST_F(AccuracyOfContact, RefusedWithWhatWasReached) {
  ASSERT_EQ(run("c = contact{ error=0.05 }\nst = c:press{ pressure='20 GPa' }"), "");
  const std::string refused = run("c:press{ pressure='2 MPa' }");
  EXPECT_NE(refused.find("`error` = 0.05 of `corrected_area_fraction` was requested, and on the "),
            std::string::npos)
      << refused;
  EXPECT_NE(refused.find("on_failure=\"best\""), std::string::npos) << refused;
}

}  // namespace
}  // namespace asperity::lua::discretisation_error_test

// SPDX-License-Identifier: GPL-3.0-or-later
// lab.calibrate in scripts: calls of the model, undetermined parameters, refusals.
#include <string>

#include "engine/core/parallel.hpp"
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::calibrate_test {
namespace {

class CalibrateTest : public LuaTest {
 protected:
  void SetUp() override {
    LuaTest::SetUp();
    // Four specimens of real areas c in m², four angles each; tau0 in Pa.
    ASSERT_EQ(run(R"(
      local rows = {}
      for s, c in ipairs{ 0.5, 0.8, 1.2, 2.0 } do
        for k = 1, 4 do
          local scatter = 1 + 0.1 * ((s * 4 + k) * 0.618 % 1 - 0.5)
          rows[#rows + 1] = { specimen="S" .. s, ["load [N]"]=5, c=c * 1e-9, ["angle [deg]"]=math.deg(math.atan((0.2 + 0.3 * c) * scatter)) }
        end
      end
      t = lab.table.from(rows)
      calls = 0
      function law(q, row) calls = calls + 1 return math.atan(q.alpha + q.tau0 * row.c) end
      function fit(more)
        local keys = { model=law, data=t, y="angle", parameters={ tau0={ start="500 MPa", lower=0 }, alpha=0.1 } }
        for key, value in pairs(more or {}) do keys[key] = value end
        return lab.calibrate(keys)
      end)"),
              "");
  }
  testing::AssertionResult refuses(const std::string& code, const std::string& part) {
    const std::string text = run(code);
    if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "\"" << text << "\" does not hold \"" << part << "\"";
  }
};

TEST_F(CalibrateTest, ParametersComeInSIWithIntervals) {
  ASSERT_EQ(run("f = fit() asked = calls tau0 = f.parameters.tau0 alpha = f.parameters.alpha"), "");
  EXPECT_TRUE(holds("math.abs(tau0.value / 3e8 - 1) < 0.1 and math.abs(alpha.value - 0.2) < 0.03"));
  EXPECT_TRUE(holds("f.values.tau0 == tau0.value and f.names[1] == 'alpha' and f.names[2] == 'tau0'"));
  EXPECT_TRUE(
      holds("tau0.low < 3e8 and 3e8 < tau0.high and tau0.profile_low < 3e8 and 3e8 < tau0.profile_high"));
  EXPECT_TRUE(holds("tau0.determined and not tau0.at_lower and f.identifiable"));
  EXPECT_TRUE(holds("f.correlation[1][2] < -0.8 and f.correlation[2][2] == 1 and f.condition > 1"));
  EXPECT_TRUE(holds("f.n == 16 and f.degrees == 14 and f.observations == 16 and f.left_out == 0"));
  EXPECT_TRUE(
      holds("#f.residuals == 16 and f.fitted_low[3] < f.fitted[3] and f.fitted[3] < f.fitted_high[3]"));
  EXPECT_TRUE(holds("math.abs(f.fitted[3] + f.residuals[3] - t:rows()[3].angle) < 1e-15"));
  EXPECT_TRUE(holds("f.calls == asked and #f.specimens == 0 and f.specimen_p == nil"));
}

TEST_F(CalibrateTest, PrintsALineAParameterAndTheVerdict) {
  ASSERT_EQ(run("text = tostring(fit())"), "");
  EXPECT_TRUE(
      holds("tostring(fit()):find('\\n  warning: the rows have a column `specimen`', 1, true) ~= nil"));
  for (const char* part :
       {"calibration of angle over 16 rows, 14 degrees of freedom", "\\n  tau0 ", " MPa to ",
        "correlation: alpha with tau0 -0.8", "verdict: every parameter is determined"})
    EXPECT_TRUE(holds("text:find('" + std::string(part) + "', 1, true) ~= nil")) << part << "\n"
                                                                                 << value("text");
}

TEST_F(CalibrateTest, SameBitsEachTime) {
  ASSERT_EQ(run("a, b = fit(), fit()"), "");
  EXPECT_TRUE(holds("a.values.tau0 == b.values.tau0 and a.calls == b.calls and tostring(a) == tostring(b)"));
}

TEST_F(CalibrateTest, OneRealAreaIsGivenNoNumber) {
  ASSERT_EQ(run("f = fit{ where={ specimen='S2' }, specimen='specimen' }"), "");
  EXPECT_TRUE(holds("not f.identifiable and f.parameters.tau0.value == nil and f.values.tau0 == nil"));
  EXPECT_TRUE(holds("f.condition == nil and f.correlation[1][2] ~= f.correlation[1][2]"));
  EXPECT_TRUE(holds("f.combinations[1]:find('alpha + 8e-10 tau0 = 0.4', 1, true) == 1"))
      << value("f.combinations[1]");
  EXPECT_TRUE(holds("f.combinations[1]:find('with tau0 in Pa', 1, true) ~= nil"));
  EXPECT_TRUE(holds("f.verdict:find('`load` is 5 N', 1, true) ~= nil")) << value("f.verdict");
  EXPECT_TRUE(holds("tostring(f):find('tau0       not identifiable', 1, true) ~= nil")) << value("f");
}

TEST_F(CalibrateTest, SpecimensAreTold) {
  ASSERT_EQ(run("f = fit{ specimen='specimen', scatter='relative' } means = fit{ specimen='specimen', "
                "basis='specimens' }"),
            "");
  EXPECT_TRUE(holds("#f.specimens == 4 and f.specimens[2].name == 'S2' and f.specimens[2].rows == 4"));
  EXPECT_TRUE(holds("f.specimen_f > 0 and f.specimen_p <= 1"));
  EXPECT_TRUE(holds("means.by_specimens and means.degrees == 2 and means.observations == 4"));
  ASSERT_EQ(run("f = fit()"), "");
  EXPECT_TRUE(holds("f.warnings[#f.warnings]:find('give specimen=\"specimen\"', 1, true) ~= nil"));
}

TEST_F(CalibrateTest, UncertaintyIsAColumnANumberOrAQuantity) {
  ASSERT_EQ(run("plain, number, quantity = fit(), fit{ u=0.01 }, fit{ u='1 deg' }"), "");
  EXPECT_TRUE(holds(
      "math.abs(plain.parameters.tau0.u / number.parameters.tau0.u / plain.residual_sd * 0.01 - 1) < 1e-6"));
  EXPECT_TRUE(holds("math.abs(number.residual_sd * 0.01 / (quantity.residual_sd * math.rad(1)) - 1) < 1e-6"));
  ASSERT_EQ(
      run("rows = t:rows() for _, r in ipairs(rows) do r.u = 0.02 * r.angle end rows = lab.table.from(rows) "
          "f = fit{ data=rows, u='u' }"),
      "");
  EXPECT_TRUE(holds("f.values.tau0 ~= plain.values.tau0"));
  EXPECT_TRUE(refuses("fit{ u='1 mm' }", "`u` is neither a column"));
  EXPECT_TRUE(refuses("fit{ u=0 }", "`u` is 0 in row 1"));
}

TEST_F(CalibrateTest, RowsWithoutNumbersAreLeftOut) {
  ASSERT_EQ(
      run("rows = t:rows() rows[2].angle = nil rows[5].angle = 0/0 f = fit{ data=lab.table.from(rows) }"),
      "");
  EXPECT_TRUE(holds("f.n == 14 and f.left_out == 2 and f.rows[2] == 3"));
}

TEST_F(CalibrateTest, NotebooksAreTakenToo) {
  ASSERT_EQ(run("book = lab.notebook 'angles' for _, r in ipairs(t:rows()) do book:write(r) end f = fit{ "
                "data=book }"),
            "");
  EXPECT_TRUE(holds("f.values.tau0 == fit().values.tau0"));
}

TEST_F(CalibrateTest, ModelErrorsCarryTheLineTheRowAndTheParameters) {
  EXPECT_TRUE(refuses("fit{ model=function(q, row) return q.alpha +\n row.nothing end }",
                      "failed in row 1 with alpha = 0.1, tau0 = 5e+08 Pa: script.lua:"));
  EXPECT_TRUE(
      refuses("fit{ model=function(q, row) return lab.surface.sine{ cells=0 } end }", "failed in row 1"));
  EXPECT_TRUE(refuses("fit{ model=function(q, row) return 'steep' end }",
                      "returned the string \"steep\" for row 1 with alpha = 0.1"));
  EXPECT_TRUE(refuses(
      "fit{ where={ specimen='S3' }, model=function(q, row) if row.c > 1e-9 then return nil end end }",
      "no finite value for row 1 at the start, with alpha = 0.1, tau0 = 5e+08 Pa"));
  EXPECT_TRUE(refuses("fit{ model=function(q, row) return 0/0 end }", "no finite value for row 1"));
}

TEST_F(CalibrateTest, WhatIsAskedWronglyIsRefused) {
  EXPECT_TRUE(refuses("fit{ y='angel' }", "angle"));
  EXPECT_TRUE(refuses("fit{ specimen='specimens' }", "specimen"));
  EXPECT_TRUE(refuses("fit{ y='specimen' }", "specimen"));
  EXPECT_TRUE(refuses("fit{ data={ 1, 2 } }", "a table (lab.table) or a notebook"));
  EXPECT_TRUE(refuses("fit{ model=3 }", "a function(q, row)"));
  EXPECT_TRUE(refuses("fit{ parameters={} }", "names no parameter"));
  EXPECT_TRUE(refuses("fit{ parameters={ 1, 2 } }", "names a parameter by the number"));
  EXPECT_TRUE(refuses("fit{ parameters={ a={ stat=1 } } }", "did you mean `start`"));
  EXPECT_TRUE(refuses("fit{ parameters={ a={ lower=1 } } }", "`parameters.a.start` is missing"));
  EXPECT_TRUE(
      refuses("fit{ parameters={ a={ start='5 MPa', lower='1 um' } } }", "another value of the parameter"));
  EXPECT_TRUE(refuses("fit{ parameters={ a='5 MPq' } }", "`parameters.a`"));
  EXPECT_TRUE(refuses("fit{ parameters={ a={ start=3, upper=1 } } }", "outside its bounds"));
  EXPECT_TRUE(refuses("fit{ parameters={ a=true } }", "give a number or a quantity"));
  EXPECT_TRUE(refuses("fit{ confidence=1 }", "confidence"));
  EXPECT_TRUE(refuses("fit{ scatter='some' }", "absolute"));
  EXPECT_TRUE(refuses("fit{ basis='specimens' }", "specimen"));
  EXPECT_TRUE(refuses("fit{ where={ specimen='S9' } }", "no row matches `where` `specimen` = S9"));
  EXPECT_TRUE(refuses("fit{ parameters={ a=1, b=1, c=1, d=1, e=1 }, where={ specimen='S1' } }",
                      "4 rows for 5 parameters"));
  EXPECT_TRUE(refuses("lab.calibrate()", "model"));
}

TEST_F(CalibrateTest, ModelIsTheMeanOverReplicates) {
  ASSERT_EQ(
      run("f = fit{ specimen='specimen', replicate={ seed={ 1, 2, 3 } }, model=function(q, row) return "
          "math.atan(q.alpha + q.tau0 * row.c * (1 + 0.05 * (q.seed - 2))) end } tau0 = f.parameters.tau0"),
      "");
  EXPECT_TRUE(holds("tau0.low < 3e8 and 3e8 < tau0.high and tau0.profile_low == nil"));
  EXPECT_TRUE(holds("tau0.share_of_faces > 0 and tau0.share_of_faces < 1"));
  EXPECT_TRUE(holds("f.verdict:find('a mean over 3 replicates', 1, true) ~= nil and f.calls % 48 == 0"));
  EXPECT_TRUE(refuses("fit{ replicate={ seed={ 1 } } }", "one key with two numbers or more"));
  EXPECT_TRUE(
      refuses("fit{ replicate={ seed={ 1, 2 }, cut={ 1, 2 } } }", "one key with two numbers or more"));
  EXPECT_TRUE(refuses("fit{ replicate={ alpha={ 1, 2 } } }", "which is a parameter, too"));
}

TEST_F(CalibrateTest, StopKeepsNothing) {
  ASSERT_EQ(run("kept = false"), "");
  stop_flag().raise(StopReason::interrupt);
  EXPECT_NE(run("kept = fit()"), "");
  stop_flag().clear();
  EXPECT_TRUE(holds("kept == false"));
}

TEST_F(CalibrateTest, ChartsAreDrawnWithoutTheModel) {
  ASSERT_EQ(run("f = fit() before = calls a, b, c = f:chart{ x='c' }, f:chart{ likelihood=true }, f:chart{ "
                "file='m.svg' }"),
            "");
  EXPECT_TRUE(holds("calls == before"));
  EXPECT_TRUE(std::filesystem::exists(folder / "run" / "calibration-angle.svg"));
  EXPECT_TRUE(std::filesystem::exists(folder / "run" / "calibration-angle-likelihood.svg"));
  EXPECT_TRUE(std::filesystem::exists(folder / "run" / "m.svg"));
  EXPECT_TRUE(refuses("f:chart{ x='nothing' }", "nothing"));
  EXPECT_TRUE(refuses("f:chart{ x='specimen' }", "is no axis of a chart"));
  EXPECT_TRUE(refuses("f:chart{ x='c', likelihood=true }", "leave out `x` or `likelihood`"));
  EXPECT_TRUE(refuses("fit{ profile=false }:chart{ likelihood=true }", "no profile likelihood to draw"));
}

TEST_F(CalibrateTest, PressesMayStandInTheModel) {
  ASSERT_EQ(run(R"(
    local face = lab.surface.sine{ cells=16, size="1 mm", amplitude="1 um", material=lab.material "steel" }
    local pair = lab.contact{ lower=face, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
    local measured = {}
    for k, p in ipairs{ 1e6, 2e6, 4e6, 8e6 } do
      measured[k] = { p=p, gap=pair:press{ pressure=p }.mean_gap * (1 + 0.001 * (k % 2)) }
    end
    f = lab.calibrate{ data=lab.table.from(measured), y="gap", parameters={ factor={ start=0.8, lower=0.1 } },
                       model=function(q, row) return q.factor * pair:press{ pressure=row.p }.mean_gap end })"),
            "");
  EXPECT_TRUE(holds("math.abs(f.values.factor - 1) < 0.01")) << value("f");
}

constexpr const char* fourteen_presses = R"(
  asked = 0
  function gap(q, p)
    asked = asked + 1
    local face = lab.surface.sine{ cells=16, size="1 mm", amplitude=q.amplitude, material=lab.material{ young=q.young, poisson=0.3 } }
    local pair = lab.contact{ lower=face, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
    return pair:press{ pressure=p }.mean_gap
  end
  local rows = {}
  for k = 1, 14 do rows[k] = { p=2e7 * k, gap=gap({ amplitude=1e-6, young=2e11 }, 2e7 * k) * (1 + 0.02 * ((k * 0.618) % 1 - 0.5)) } end
  presses = lab.table.from(rows)
  asked = 0
  function fit_presses(more)
    local keys = { data=presses, y="gap", scatter="relative", model=function(q, row) return gap(q, row.p) end,
                   parameters={ amplitude={ start="1.2 um", lower="0.1 um" }, young={ start="150 GPa", lower="10 GPa" } } }
    for key, value in pairs(more or {}) do keys[key] = value end
    return lab.calibrate(keys)
  end)";

TEST_F(CalibrateTest, PressesAreFewAndSpreadOverThreads) {
  ASSERT_EQ(run(fourteen_presses), "");
  const int threads = thread_count();
  set_thread_count(1);
  EXPECT_EQ(run("one = fit_presses()"), "");
  set_thread_count(2);
  EXPECT_EQ(run("two = fit_presses()"), "");
  set_thread_count(threads);
  EXPECT_TRUE(holds("one.calls <= 14 * 16")) << value("one.calls");
  EXPECT_TRUE(holds("asked == 4")) << value("asked");  // two of each fit; the others in copies
  EXPECT_TRUE(holds("one.values.young == two.values.young and tostring(one) == tostring(two)"));
  EXPECT_TRUE(holds("math.abs(one.values.amplitude / 1e-6 - 1) < 0.02")) << value("one");
  EXPECT_TRUE(holds("one.identifiable and one.parameters.young.profile_high > one.values.young"));
}

// The real area counts 6 to 42 of 32 x 32 nodes.
TEST_F(CalibrateTest, RealAreasOfPressesTellNoProductApart) {
  ASSERT_EQ(run(R"(
    function area(young, p)
      local face = lab.surface.self_affine{ cells=32, size="1 mm", hurst=0.8, rms_height="1 um", short_wave="64 um", seed=3,
                                            material=lab.material{ young=young, poisson=0.3 } }
      local pair = lab.contact{ lower=face, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" } }
      return pair:press{ pressure=p }.area_fraction
    end
    local rows = {}
    for k = 1, 10 do rows[k] = { p=2e6 * k, area=area(1.3e11, 2e6 * k) * (1 + 0.02 * ((k * 0.618) % 1 - 0.5)) } end
    function product(young, factor, most)
      local found = lab.calibrate{ data=lab.table.from(rows), y="area", scatter="relative",
        model=function(q, row) return area(q.E * q.f, row.p) end,
        parameters={ E={ start=young, lower="10 GPa" }, f={ start=factor, lower=0.1, upper=most } } }
      return not found.values.E and not found.values.f and found.verdict:find("only the product E f = 1%.[23]")
        and true or found.verdict
    end)"),
            "");
  EXPECT_TRUE(holds("product('100 GPa', 1) == true")) << value("product('100 GPa', 1)");
  EXPECT_TRUE(holds("product('200 GPa', 0.9) == true")) << value("product('200 GPa', 0.9)");
  EXPECT_TRUE(holds("product('120 GPa', 1, 1) == true")) << value("product('120 GPa', 1, 1)");
}

TEST_F(CalibrateTest, MistakesOfASpreadModelCarryTheRowAndTheParameters) {
  ASSERT_EQ(run(fourteen_presses), "");
  EXPECT_TRUE(
      refuses("fit_presses{ model=function(q, row) local g = gap(q, row.p) if row.p > 1e8 then "
              "return g.nothing end return g end }",
              "failed in row 6 with amplitude = 1.2e-06 m, young = 1.5e+11 Pa: script.lua:1: attempt to "
              "index a number value"));
  EXPECT_TRUE(
      refuses("fit_presses{ model=function(q, row) local g = gap(q, row.p) if row.p > 1e8 then "
              "return 'steep' end return g end }",
              "returned the string \"steep\" for row 6 with amplitude"));
  EXPECT_TRUE(
      refuses("fit_presses{ model=function(q, row) local g = gap(q, row.p) if row.p > 1e8 then "
              "return nil end return g end }",
              "no finite value for row 6 at the start"));
}

TEST_F(CalibrateTest, DryRunChecksTheKeysAndCallsNothing) {
  open_dry();
  EXPECT_EQ(
      run("f = lab.calibrate{ model=function() error 'called' end, data=lab.table.from{ { a=1 } }, y='a', "
          "parameters={ q=1 } } x = f.parameters.q.value f:chart{ x='a' }"),
      "");
  EXPECT_TRUE(
      refuses("lab.calibrate{ model=print, data=lab.table.from{ { a=1 } }, y='a', paramters={ q=1 } }",
              "parameters"));
}

}  // namespace
}  // namespace asperity::lua::calibrate_test

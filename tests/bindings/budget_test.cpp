// SPDX-License-Identifier: GPL-3.0-or-later
// lab.budget and lab.sensitivity in scripts; tests/statistics checks the numbers.
#include <string>

#include "engine/core/parallel.hpp"
#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::budget_test {
namespace {

class BudgetTest : public LuaTest {
 protected:
  testing::AssertionResult refuses(const std::string& code, const std::string& part) {
    const std::string text = run(code);
    if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "\"" << text << "\" does not hold \"" << part << "\"";
  }
};

// Known parts: seed scatter, an error of 1/cells, a gain uncertainty of 2 %.
TEST_F(BudgetTest, HasAShareOfEachPartAndWhatHalvingItTakes) {
  ASSERT_EQ(run(R"(
    local off = { 0.9, 1.1, -0.4, -1.2, -0.4 }
    calls = 0
    function ask(x) calls = calls + 1 return x.gain * (10 + off[x.seed] + 16 / x.cells) end
    b = lab.budget{ ask=ask, cells={ 32, 64 }, replicate={ seed={ 1, 2, 3, 4, 5 } },
                    inputs={ gain={ value=1, u="2 %" } }, half_width=0.8 }
    shares = {}
    total = 0
    for _, p in ipairs(b.parts) do shares[p.name] = p.share total = total + p.share end
  )"),
            "");
  EXPECT_TRUE(holds("math.abs(total - 1) < 1e-9 and b.runs == calls and b.n == 5"));
  EXPECT_TRUE(holds("b.low < 10 and 10 < b.high and math.abs(b.value - 10) < 0.3"));
  EXPECT_TRUE(holds("shares.sampling > shares.gain and shares.gain > shares.cells and shares.solver == nil"));
  EXPECT_TRUE(holds("b.parts[1].name == 'sampling' and b.parts[1].halving:find 'more replicates' ~= nil"));
  EXPECT_TRUE(holds("b.plan and b.plan.replicates > 5 and b.plan.half_width <= 0.8"));
  EXPECT_TRUE(
      holds("tostring(b):find('part ', 1, true) ~= nil and tostring(b):find('solver: not estimated', 1, "
            "true) ~= nil"));
}

constexpr const char* area_of_faces = R"(
  asked = 0
  function area(x)
    asked = asked + 1
    local face = lab.surface.self_affine{ cells=x.cells or 16, size="100 um", hurst=0.8, rms_height="0.5 um", short_wave="25 um",
                                          seed=x.seed or 1, material=lab.material{ young=x.young or 7e10, poisson=0.3 } }
    local pair = lab.contact{ lower=face, upper=lab.rigid, boundary="periodic", effects={ elasticity="half_space" },
                              accuracy={ tolerance=x.tolerance } }
    return pair:press{ pressure=1e7 }.area_fraction
  end
  function budget(more)
    local keys = { ask=area, replicate={ seed={ 1, 2, 3, 4, 5 } }, cells={ 16, 32 }, tolerance={ 1e-4, 1e-6 },
                   inputs={ young={ value="70 GPa", u="5 %" } }, runs=16 }
    for key, value in pairs(more or {}) do keys[key] = value end
    return lab.budget(keys)
  end)";

TEST_F(BudgetTest, HeavyRunsAreSpreadWithTheSameBits) {
  ASSERT_EQ(run(area_of_faces), "");
  const int threads = thread_count();
  set_thread_count(1);
  EXPECT_EQ(run("one = budget()"), "");
  set_thread_count(2);
  EXPECT_EQ(run("two = budget()"), "");
  set_thread_count(threads);
  EXPECT_TRUE(holds("one.runs == 5 * 2 + 1 + 16")) << value("one.runs");
  EXPECT_TRUE(holds("asked == 4")) << value("asked");  // the first replicate, twice on two grids
  EXPECT_TRUE(holds("one.value == two.value and one.low == two.low and one.high == two.high"));
  EXPECT_TRUE(holds("one.parts[1].share == two.parts[1].share and one.seconds > 0"));
  EXPECT_TRUE(holds("one.low < one.value and one.value < one.high")) << value("one");
  // A bench cannot be copied: sequential runs.
  ASSERT_EQ(run("local bench = lab.contact{ lower=lab.surface.sine{ cells=8, size='1 mm', amplitude='1 um', "
                "material=lab.material 'steel' }, upper=lab.rigid, boundary='periodic', "
                "effects={ elasticity='half_space' } } asked = 0 "
                "three = budget{ ask=function(x) assert(bench) return area(x) end }"),
            "");
  EXPECT_TRUE(holds("asked == three.runs and three.value == one.value"));
}

TEST_F(BudgetTest, MistakesOfASpreadRunAreThoseOfTheFirst) {
  ASSERT_EQ(run(area_of_faces), "");
  EXPECT_TRUE(
      refuses("budget{ ask=function(x) local a = area(x) if x.seed >= 3 then error('seed ' .. x.seed) "
              "end return a end }",
              "seed=3"));
  EXPECT_TRUE(
      refuses("budget{ ask=function(x) local a = area(x) if x.seed >= 3 then return 'x' end return a end }",
              "`ask` returned the string \"x\" for { cells=16, seed=3"));
  EXPECT_TRUE(
      refuses("budget{ ask=function(x) local a = area(x) if x.seed >= 3 then return 0/0 end return a end }",
              "the answer of run 5 (replicate 3) is not finite"));
}

TEST_F(BudgetTest, TipAndNoiseAreAskedFor) {
  ASSERT_EQ(run(R"(
    tips, noises = {}, {}
    b = lab.budget{ ask=function(x)
      tips[x.tip] = true
      if x.noise then noises[#noises + 1] = x.noise end
      return 10 - 1e5 * x.tip + (x.noise or 0) * 0.1
    end, tip={ "5 um", "2 um" }, noise={ 1, 2, 3 } }
    parts = {} for _, p in ipairs(b.parts) do parts[p.name] = p end)"),
            "");
  EXPECT_TRUE(holds("tips[5e-6] and tips[2e-6] and #noises == 3"));
  EXPECT_TRUE(holds("math.abs(parts.noise.u - 0.1) < 1e-9 and parts.tip.u > 0 and parts.tip.seconds == nil"));
  EXPECT_TRUE(holds("parts.tip.halving:find('a tip of', 1, true) == 1")) << value("parts.tip.halving");
  EXPECT_TRUE(refuses("lab.budget{ ask=print, tip={ '2 um', '5 um' } }", "blunt ones first"));
  EXPECT_TRUE(refuses("lab.budget{ ask=print, tip={ '2 s', '5 um' } }", "tip"));
  EXPECT_TRUE(refuses("lab.budget{ ask=print, noise={ 1, 1 } }", "`noise[2]` is 1 for the second time"));
  EXPECT_TRUE(refuses("lab.budget{ ask=print, noise=3 }", "`noise` has one draw"));
}

TEST_F(BudgetTest, InputsHaveShapesDegreesSamplesAndCorrelation) {
  ASSERT_EQ(run(R"(
    draws = {} for k = 1, 50 do draws[k] = k .. " um" end
    b = lab.budget{ ask=function(x) return x.a + x.b + x.c + x.d + 1e6 * x.e end, correlation={ { "a", "b", -0.5 } },
      inputs={ a={ value=1, u=0.1 }, b={ value=1, u=0.2 }, c={ value="2", u="10 %", shape="lognormal" },
               d={ value=0, u=0.1, degrees=2 }, e={ sample=draws } } }
    part = {} for _, p in ipairs(b.parts) do part[p.name] = p end)"),
            "");
  EXPECT_TRUE(holds("part.correlation.share < 0 and part.d.degrees == 2 and part.a.degrees == math.huge"));
  EXPECT_TRUE(holds("math.abs(part.a.sensitivity - 1) < 1e-6 and math.abs(part.e.u - 14.577) < 0.01"));
  EXPECT_TRUE(
      holds("(tostring(b):find('25.5 um', 1, true) and tostring(b):find('lognormal', 1, true)) ~= nil"))
      << value("b");
  EXPECT_TRUE(refuses("lab.budget{ ask=print, inputs={ a={ value=0, u=1, shape='cauchy' } } }",
                      "\"lognormal\" or \"triangular\""));
  EXPECT_TRUE(
      refuses("lab.budget{ ask=print, inputs={ a={ value=0, u=1, shape='lognormal' } } }", "above 0"));
  EXPECT_TRUE(
      refuses("lab.budget{ ask=print, inputs={ a={ value=0, u=1, degrees=0 } } }", "`a` has 0 degrees"));
  EXPECT_TRUE(
      refuses("lab.budget{ ask=print, inputs={ a={ sample={ 1, 2, 3 } } } }", "fewer than 10 numbers"));
  EXPECT_TRUE(refuses(
      "lab.budget{ ask=print, inputs={ a={ value=0, u=1 } }, correlation={ { 'a', 'z', 0.5 } } }", "`z`"));
  EXPECT_TRUE(refuses("lab.budget{ ask=print, inputs={ a={ value=0, u=1 } }, correlation={ { 'a', 0.5 } } }",
                      "`correlation` lists two inputs and a number"));
}

TEST_F(BudgetTest, ACalibrationIsAnInputWithItsCorrelation) {
  ASSERT_EQ(run(R"(
    rows = {} for k = 1, 8 do rows[k] = { x=k, y=2 + 0.5 * k + 0.1 * math.sin(9 * k) } end
    line = lab.calibrate{ data=lab.table.from(rows), y="y", parameters={ p=1, q=1 },
                          model=function(q, row) return q.p + q.q * row.x end }
    b = lab.budget{ ask=function(x) return x.p + 4.5 * x.q end, inputs={ law=line } }
    part = {} for _, p in ipairs(b.parts) do part[p.name] = p end)"),
            "");
  EXPECT_TRUE(
      holds("part.p.degrees == 6 and part.correlation.share < -1 and math.abs(b.degrees - 6) < 1e-6"));
  EXPECT_TRUE(holds("math.abs(b.u - line.residual_sd / math.sqrt(8)) < 1e-3 * b.u"));
  EXPECT_TRUE(refuses("lab.sensitivity{ ask=print, inputs={ law=line } }", "use lab.budget"));
  EXPECT_TRUE(refuses("lab.budget{ ask=print, inputs={ law=line, p={ value=1, u=1 } } }", "`p`"));
}

TEST_F(BudgetTest, SpecimensHaveRepeats) {
  ASSERT_EQ(run(R"(
    b = lab.budget{ ask=function(x) return x.specimen + x.seed end, half_width="50 %",
                    replicate={ specimen={ 1, 1, 2, 2, 5, 5 }, seed={ 1, 2, 1, 2, 1, 2 } } })"),
            "");
  EXPECT_TRUE(holds("b.n == 3 and b.degrees == 2 and b.parts[1].halving == '9 more specimens'"))
      << value("b");
  EXPECT_TRUE(holds("b.plan and b.plan.half_width <= 0.5 * b.value"));
  EXPECT_TRUE(refuses("lab.budget{ ask=print, replicate={ face={ 1, 1, 2 }, seed={ 1, 2, 3 } } }",
                      "`replicate.face[2]` is 1 for the second time"));
  EXPECT_TRUE(refuses("lab.budget{ ask=print, replicate={ seed={ 1, 1, 3 }, specimen={ 1, 1, 2 } } }",
                      "`replicate.seed[2]` is 1 for the second time"));
}

TEST_F(BudgetTest, SaysWhatIsWrongAndWhere) {
  EXPECT_TRUE(refuses("lab.budget{ ask=function() return 1 end }", "there is nothing to vary"));
  EXPECT_TRUE(refuses("lab.budget{ ask=function() return 'x' end, replicate={ seed={ 1, 2 } } }",
                      "`ask` returned the string \"x\" for { seed=1 }; return one number"));
  EXPECT_TRUE(refuses("lab.budget{ ask=function() return 0/0 end, replicate={ seed={ 1, 2 } } }",
                      "the answer of run 1 (replicate 1) is not finite"));
  EXPECT_TRUE(refuses("lab.budget{ ask=function() error 'boom' end, replicate={ seed={ 1, 2 } } }", "boom"));
  EXPECT_TRUE(refuses("lab.budget{ ask=print, replicate={ seed={ 1, 1 } } }",
                      "`replicate.seed[2]` is 1 for the second"));
  EXPECT_TRUE(refuses("lab.budget{ ask=print, replicate={ seed={ 1 } } }", "scatter takes two or more"));
  EXPECT_TRUE(refuses("lab.budget{ ask=print, inputs={ h={ value=1 } } }", "`inputs.h` has no `u`"));
  EXPECT_TRUE(refuses("lab.budget{ ask=print, inputs={ h={ value=1, u='1 m' } } }",
                      "give both in units of one kind"));
  EXPECT_TRUE(refuses("lab.sensitivity{ ask=print }", "`inputs` is missing"));
  EXPECT_TRUE(refuses(
      "lab.ensemble{ over={ n={ 1 } }, run=function(case) lab.budget{ ask=function(x) return x.seed end, "
      "replicate={ seed={ 1, 2 } } } end }",
      "a case of an ensemble cannot measure the times of a budget: other cases run at the same time; go "
      "over the cases in a `for` loop, one budget after the other"));
}

TEST_F(BudgetTest, SensitivityRanksInputsAndRefusesNoise) {
  ASSERT_EQ(run("s = lab.sensitivity{ ask=function(x) return 3 * x.a + x.b end,"
                " inputs={ a={ value=1, u=0.1 }, b={ value=2, u=0.1 } } }"),
            "");
  EXPECT_TRUE(holds(
      "s.measure_next == 'a' and s.inputs[1].name == 'a' and math.abs(s.inputs[1].first - 0.9) < 1e-6"));
  EXPECT_TRUE(holds("math.abs(s.inputs[2].total - 0.1) < 1e-6 and not s.approximate"));
  EXPECT_TRUE(
      refuses("math.randomseed(1) lab.sensitivity{ ask=function(x) return math.random() end,"
              " inputs={ h={ value=1, u=0.1 } } }",
              "the answer is no polynomial of its inputs"));
}

}  // namespace
}  // namespace asperity::lua::budget_test

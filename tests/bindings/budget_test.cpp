// SPDX-License-Identifier: GPL-3.0-or-later
// lab.budget and lab.sensitivity from a script: what `ask` is given, what comes back and prints, and each
// refusal with the place it names. The numbers are held in tests/statistics.
#include <string>

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

// An answer of which each part is known: seeds scatter by a few, cells err by 1/cells, the gain by 2 %.
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

// SPDX-License-Identifier: GPL-3.0-or-later
// As a script sees it: off the overlap of two turned bodies the gap is missing in values, in what sums
// them up and in pictures, as a measured map with holes is; every other number stays one.
#include <gtest/gtest.h>

#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::missing_gap_test {
namespace {

class MissingGap : public LuaTest {
 protected:
  void SetUp() override {
    LuaTest::SetUp();
    ASSERT_EQ(run("function bar()\n"
                  "  return lab.surface.sphere{ cells={ 8, 32 }, size={ '1 mm', '4 mm' }, radius='10 m',\n"
                  "                             material=lab.material 'Al-2011' }\n"
                  "end\n"
                  "c = lab.contact{ lower=bar(), upper=bar(), boundary='free',\n"
                  "                 effects={ elasticity='half_space' } }\n"
                  "c:rotate '90 deg'\n"
                  "st = c:press{ pressure='10 MPa' }"),
              "");
  }
};

TEST_F(MissingGap, IsNanInValuesAndLeftOutOfSums) {
  EXPECT_TRUE(holds("st.overlap_fraction == 0.25"));
  EXPECT_TRUE(holds("st.area <= 1.000001e-6"));
  EXPECT_TRUE(holds("math.abs(st.pressure / 10e6 - 1) < 1e-9"));
  EXPECT_EQ(run("local gap, pressure, sum, known = st:field 'gap', st:field 'pressure', 0, 0\n"
                "for j = 0, 31 do for i = 0, 7 do\n"
                "  local g = gap:value(i, j)\n"
                "  if j < 12 or j >= 20 then\n"
                "    assert(g ~= g and pressure:value(i, j) == 0)\n"
                "    assert(gap:values()[j + 1][i + 1] ~= gap:values()[j + 1][i + 1])\n"
                "  else\n"
                "    sum, known = sum + g, known + 1\n"
                "    assert(g >= 0)\n"
                "  end\n"
                "end end\n"
                "assert(known == 64)\n"
                "local off = st.error.algebraic.mean_gap  -- what touches counts as 0 in the field, with its "
                "residual in the mean\n"
                "assert(off < 1e-12 and math.abs(sum / known - st.mean_gap) <= off)\n"
                "assert(math.abs(gap.mean - st.mean_gap) <= off)\n"
                "assert(gap.min >= 0 and gap.max < 1e-3 and not tostring(gap):find 'nan')"),
            "");
}

TEST_F(MissingGap, IsToldByThePlanAndTheState) {
  EXPECT_TRUE(holds("c:explain().overlap_fraction == 0.25"));
  EXPECT_TRUE(holds("tostring(c:explain()):find '25 %% of the tile' ~= nil"));
  EXPECT_TRUE(holds("tostring(st):find 'face each other on 25 %%' ~= nil"));
}

}  // namespace
}  // namespace asperity::lua::missing_gap_test

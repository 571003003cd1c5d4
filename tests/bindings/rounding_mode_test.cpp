// SPDX-License-Identifier: GPL-3.0-or-later
// A host that rounds upward gets the same results from the module, and its mode back after each call.
#include <cfenv>

#include "tests/bindings/lua_test.hpp"

namespace asperity::lua::rounding_mode_test {
namespace {

// 0.75 and 0.25 are exact: what the host's own parser makes of other numbers hangs on its rounding.
constexpr const char* digests =
    "local s = lab.surface.self_affine{ cells=32, size='1 mm', hurst=0.75, ra='1 um', short_wave='80 um', "
    "seed=1,"
    " material=lab.material{ young='70.3 GPa', poisson=0.25 } } "
    "local c = lab.contact{ lower=s, upper=lab.rigid, boundary='periodic', effects={ elasticity='half_space' "
    "} } "
    "local st = c:press{ pressure='12.3 MPa' } "
    "return s.digest .. ' ' .. st.digest .. ' ' .. string.format('%a %a', st.stiffness, s:roughness().Rq)";

struct RoundingMode {
  int before = std::fegetround();
  explicit RoundingMode(int mode) { std::fesetround(mode); }
  ~RoundingMode() { std::fesetround(before); }
  RoundingMode(const RoundingMode&) = delete;
  RoundingMode& operator=(const RoundingMode&) = delete;
};

class HostRounding : public LuaTest {
 protected:
  std::string found() { return value(std::string("(function() ") + digests + " end)()"); }
};

TEST_F(HostRounding, DoesNotReachResults) {
  const std::string to_nearest = found();
  ASSERT_EQ(to_nearest.find("error"), std::string::npos) << to_nearest;
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    const RoundingMode of_host(mode);
    EXPECT_EQ(found(), to_nearest);
    EXPECT_EQ(std::fegetround(), mode);
  }
}

}  // namespace
}  // namespace asperity::lua::rounding_mode_test

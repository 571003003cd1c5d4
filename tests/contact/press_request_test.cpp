// SPDX-License-Identifier: GPL-3.0-or-later
// What a press refuses whatever the contact.
#include "engine/contact/press_request.hpp"

#include <limits>

#include "tests/contact/contacts.hpp"

namespace asperity {
namespace {

using test::error_of;

TEST(PressRequest, NegativeAndNonFiniteValuesAreRefusedByName) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(error_of([] {
              check(PressRequest{PressBy::load, -1, {}});
            }),
            "`load` is -1 N; a contact without adhesion takes a finite value from zero up");
  for (const PressBy by :
       {PressBy::pressure, PressBy::load, PressBy::approach, PressBy::indentation, PressBy::flatten})
    for (const double value : {-1e-300, inf, -inf, std::numeric_limits<double>::quiet_NaN()})
      EXPECT_EQ(error_of([&] {
                  check(PressRequest{by, value, {}});
                }).find("`" + std::string(name(by)) + "` is "),
                0U);
}

TEST(PressRequest, FlattenIsAFraction) {
  EXPECT_EQ(error_of([] { check(PressRequest{PressBy::flatten, 1, {}}); }), "");
  EXPECT_EQ(error_of([] {
              check(PressRequest{PressBy::flatten, 1 + 1e-15, {}});
            }).find("`flatten` is 1"),
            0U);
  EXPECT_EQ(error_of([] { check(PressRequest{PressBy::indentation, 3, {}}); }), "");
}

TEST(PressRequest, DwellIsNotNegative) {
  EXPECT_EQ(error_of([] {
              check(PressRequest{PressBy::load, 1, -2.0});
            }),
            "`dwell` is -2 s; give a time from zero up");
  EXPECT_EQ(error_of([] { check(PressRequest{PressBy::load, 1, 600.0}); }), "");
}

}  // namespace
}  // namespace asperity

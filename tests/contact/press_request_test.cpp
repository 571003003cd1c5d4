// SPDX-License-Identifier: GPL-3.0-or-later
// Requests refused for every contact.
#include "engine/contact/scene/press_request.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "tests/contact/contacts.hpp"

namespace asperity::press_request_test {
namespace {

using test::error_of;

TEST(PressRequest, NegativeAndNonFiniteValuesAreRefusedByName) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(error_of([] {
              check(PressRequest{PressBy::load, -1, {}});
            }),
            "`load` is -1 N; give a finite value from zero up: nothing attracts the bodies");
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

TEST(PressRequest, NumbersMayBePullsUntilAContactIsPulled) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const auto refused = [](const PressRequest& request) { return error_of([&] { check_numbers(request); }); };
  EXPECT_EQ(refused({PressBy::load, -1, {}, {2}}), "");
  EXPECT_NE(refused({PressBy::load, -inf}).find("`load` is -inf N"), std::string::npos);
  EXPECT_NE(refused({PressBy::load, 0, {}, {inf}}).find("`preload` is inf"), std::string::npos);
  EXPECT_NE(refused({PressBy::flatten, -0.1}).find("`flatten` is -0.1"), std::string::npos);
  EXPECT_EQ(error_of([] { check({PressBy::load, 2, {}, {3, 1}}, true); }), "");
}

TEST(PressRequest, TurnsPastWhichAPathWentAreForgotten) {
  const auto turns = [](std::vector<double> visited, double value) { return turns_before(visited, value); };
  using Turns = std::vector<double>;
  EXPECT_EQ(turns({}, 1), Turns{});
  EXPECT_EQ(turns({1, 2, 3}, 4), Turns{});
  EXPECT_EQ(turns({1, 2, 3}, 3), Turns{});
  EXPECT_EQ(turns({1, 2, 3}, std::nextafter(3.0, 0.0)), Turns{3});
  EXPECT_EQ(turns({1, 3, 2}, 1), Turns{3});
  EXPECT_EQ(turns({1, 3, 1}, 2), (Turns{3, 1}));
  EXPECT_EQ(turns({3, 0, 2, 1}, 1.5), (Turns{3, 0, 2, 1}));
  EXPECT_EQ(turns({3, 0, 2, 1}, 2), (Turns{3, 0}));
  EXPECT_EQ(turns({3, 0, 2, 1}, 2.5), (Turns{3, 0}));
  EXPECT_EQ(turns({3, 0, 2, 1}, -1), Turns{3});
  EXPECT_EQ(turns({3, 0, 2, 1}, 3), Turns{});
  EXPECT_EQ(turns({3, 1, 3, 2}, 2.5), (Turns{3, 2}));
  EXPECT_EQ(turns({3, 1, 2, 1}, 1.5), (Turns{3, 1}));
}

TEST(PressRequest, DwellIsNotNegative) {
  EXPECT_EQ(error_of([] {
              check(PressRequest{PressBy::load, 1, -2.0});
            }),
            "`dwell` is -2 s; give a time from zero up");
  EXPECT_EQ(error_of([] { check(PressRequest{PressBy::load, 1, 600.0}); }), "");
}

}  // namespace
}  // namespace asperity::press_request_test

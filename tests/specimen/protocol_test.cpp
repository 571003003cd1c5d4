// SPDX-License-Identifier: GPL-3.0-or-later
// Protocols as values: refusals, text, digests.
#include "engine/specimen/protocol.hpp"

#include <limits>
#include <numbers>
#include <set>

#include "tests/support/run_fixture.hpp"

namespace asperity::protocol_test {
namespace {

using Event = Protocol::Event;

PressRequest pressure(double value, std::optional<double> dwell = {}) {
  return {PressBy::pressure, value, dwell};
}
constexpr double quarter = 0.5 * std::numbers::pi;

Protocol every_kind() {
  return Protocol({{pressure(152.78e6, 600.0)},
                   {Protocol::Release{}},
                   {Protocol::Place{3}},
                   {Protocol::Rotate{-quarter}},
                   {Protocol::Shift{1e-5, 0}},
                   {PressRequest{PressBy::load, 2.5, {}}, 90.0, "a.csv line 2"},
                   {PressRequest{PressBy::approach, 1e-6, 1.5}},
                   {PressRequest{PressBy::indentation, 0.1, {}}},
                   {PressRequest{PressBy::flatten, 1.0, {}}}});
}

TEST(Protocol, ReadsAsAListing) {
  EXPECT_EQ(every_kind().text(),
            "protocol of 9 events\n"
            "  1  press 152.78 MPa for 10 min\n"
            "  2  release\n"
            "  3  place with seed 3\n"
            "  4  rotate -90 deg\n"
            "  5  shift by 10 um along x and 0 m along y\n"
            "  6  press 2.5 N (at 90 s, a.csv line 2)\n"
            "  7  press to an approach of 1 um for 1.5 s\n"
            "  8  press to `indentation` 0.1\n"
            "  9  press to `flatten` 1");
  EXPECT_EQ(Protocol({{Protocol::Release{}}}).text(), "protocol of 1 event\n  1  release");
  EXPECT_EQ(Protocol({{PressRequest{PressBy::load, -1, {}, {2, 0.5}}}}).text(),
            "protocol of 1 event\n  1  press -1 N preloaded to 2 N and then 500 mN");
}

TEST(Protocol, LongListingsLeaveOutTheMiddle) {
  const Protocol all = Protocol({{pressure(1)}}).repeated(25);
  EXPECT_EQ(all.text().find("..."), std::string::npos);
  const std::string longer = all.plus(Protocol({{Protocol::Release{}}})).text();
  EXPECT_NE(longer.find("\n  20  press 1 Pa\n  ... 1 more\n  22  press 1 Pa\n"), std::string::npos) << longer;
  EXPECT_TRUE(longer.ends_with("\n  26  release")) << longer;
}

TEST(Protocol, CountsEventsAndPresses) {
  EXPECT_EQ(every_kind().count(), 9U);
  EXPECT_EQ(every_kind().presses(), 5U);
  EXPECT_EQ(kind(every_kind().events()[3].step), "rotate");
}

TEST(Protocol, RefusesNoEvents) {
  EXPECT_EQ(error_of([] { Protocol({}); }),
            "bad_value: a protocol has no events; give at least one, such as { press={ "
            "pressure=\"10 MPa\" } }");
}

TEST(Protocol, RefusesNumbersThatNoContactTakes) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(error_of([] {
              Protocol({{pressure(1)}, {pressure(-inf)}});
            }),
            "bad_value: event 2: `pressure` is -inf Pa; give a finite value; one below zero pulls");
  EXPECT_EQ(error_of([] { Protocol({{Protocol::Rotate{inf}}}); }),
            "bad_value: event 1: the angle of `rotate` is inf; give a finite value");
  EXPECT_EQ(error_of([] {
              Protocol({{Protocol::Shift{0, -inf}}});
            }),
            "bad_value: event 1: `y` of `shift` is -inf; give a finite value");
  EXPECT_EQ(error_of([] { Protocol({{pressure(1, -1.0)}}); }),
            "bad_value: event 1: `dwell` is -1 s; give a time from zero up");
}

TEST(Protocol, DigestsAreThoseOfStepsAndTimes) {
  EXPECT_EQ(every_kind().digest(), every_kind().digest());
  std::set<std::string> digests;
  const std::vector<std::vector<Event>> different = {
      {{pressure(1)}},
      {{pressure(2)}},
      {{pressure(1, 0.0)}},
      {{pressure(1), 0.0}},
      {{PressRequest{PressBy::load, 1, {}}}},
      {{PressRequest{PressBy::load, -1, {}}}},
      {{PressRequest{PressBy::load, 1, {}, {2}}}},
      {{PressRequest{PressBy::load, 1, {}, {3, 2}}}},
      {{pressure(1)}, {pressure(1)}},
      {{Protocol::Release{}}},
      {{Protocol::Place{1}}},
      {{Protocol::Rotate{1}}},
      {{Protocol::Shift{1, 0}}},
      {{Protocol::Shift{0, 1}}},
  };
  for (const auto& events : different) digests.insert(Protocol(events).digest());
  EXPECT_EQ(digests.size(), different.size());
  // The source line is no part of the digest.
  EXPECT_EQ(Protocol({{pressure(1), 0.0, "a.csv line 2"}}).digest(), Protocol({{pressure(1), 0.0}}).digest());
}

TEST(Protocol, IsPutTogetherFromOthers) {
  const Protocol press({{pressure(1), 5.0}}), turn({{Protocol::Release{}}, {Protocol::Rotate{quarter}}});
  EXPECT_EQ(press.plus(turn).repeated(2).text(),
            "protocol of 6 events\n  1  press 1 Pa\n  2  release\n  3  rotate 90 deg\n  4  press 1 Pa\n  5  "
            "release\n  6  rotate 90 deg");
  EXPECT_EQ(press.repeated(1).digest(), press.digest());
  EXPECT_FALSE(press.repeated(2).events()[0].time.has_value());
  EXPECT_TRUE(press.events()[0].time.has_value());
}

TEST(Protocol, RefusesTimesThatMakeNoProtocol) {
  const Protocol two({{pressure(1)}, {Protocol::Release{}}});
  EXPECT_EQ(error_of([&] { two.repeated(0); }),
            "bad_value: a protocol of 2 events cannot be repeated 0 times; give a whole number from 1 to "
            "5000000");
  EXPECT_NE(error_of([&] { two.repeated(5'000'001); }), "");
}

}  // namespace
}  // namespace asperity::protocol_test

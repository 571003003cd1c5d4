// SPDX-License-Identifier: GPL-3.0-or-later
// Protocols run like presses by hand; failed and stopped events.
#include "engine/specimen/specimen_pair.hpp"

#include <numbers>

#include "tests/contact/contacts.hpp"

namespace asperity::protocol_run_test {
namespace {

using test::error_of;
using test::random_surface;
using test::scene_of;

constexpr double quarter = 0.5 * std::numbers::pi;
PressRequest pressure(double value) { return {PressBy::pressure, value, {}}; }

std::shared_ptr<SpecimenPair> rough_pair(int nx = 12, int ny = 12) {
  return std::make_shared<SpecimenPair>(
      scene_of(random_surface(nx, ny, 1), random_surface(nx, ny, 2), 3.0, Boundary::periodic));
}

const Protocol& five() {
  static const Protocol protocol({{pressure(1)},
                                  {Protocol::Release{}},
                                  {Protocol::Place{4}},
                                  {Protocol::Rotate{quarter}},
                                  {pressure(2)}});
  return protocol;
}

// Digests of the presses; "-" for other events.
std::vector<std::string> done(ProtocolRun run) {
  std::vector<std::string> digests;
  while (!run.finished()) {
    const auto state = run.step();
    digests.push_back(state ? state->digest() : "-");
  }
  return digests;
}

TEST(ProtocolRun, DoesWhatCallsByHandDo) {
  const auto by_hand = rough_pair();
  std::vector<std::string> expected = {by_hand->press(pressure(1)).digest(), "-", "-", "-"};
  by_hand->place(4);
  by_hand->rotate(quarter);
  expected.push_back(by_hand->press(pressure(2)).digest());
  EXPECT_EQ(done(ProtocolRun(five(), rough_pair())), expected);
}

TEST(ProtocolRun, ShiftsAreDone) {
  const auto pair = rough_pair();
  ProtocolRun run(Protocol({{Protocol::Shift{0.25, 0}}}), pair);
  const auto before = pair->placement();
  EXPECT_FALSE(run.step().has_value());
  EXPECT_FALSE(pair->placement() == before);
}

TEST(ProtocolRun, AProtocolServesTwoContactsAndTwice) {
  const auto pair = rough_pair();
  const auto first = done(ProtocolRun(five(), pair));
  EXPECT_EQ(done(ProtocolRun(five(), rough_pair())), first);
  pair->release();
  pair->place(1);
  EXPECT_EQ(done(ProtocolRun(five(), pair)).back(), first.back());  // placed afresh before the last press
}

TEST(ProtocolRun, AnEventThatDoesNotFitIsRefusedBeforeTheFirst) {
  const auto refusal = [](const std::shared_ptr<SpecimenPair>& pair, const Protocol& protocol) {
    const auto placement = pair->placement();
    std::string error = error_of([&] { ProtocolRun(protocol, pair); });
    EXPECT_TRUE(pair->history().empty() && pair->placement() == placement && !pair->under_load());
    return error;
  };
  const auto expect_told = [](const std::string& error, const std::string& part) {
    EXPECT_NE(error.find(part), std::string::npos) << error;
  };
  expect_told(refusal(rough_pair(),
                      Protocol({{pressure(1)}, {Protocol::Rotate{0.5 * quarter}, 9.0, "log.csv line 3"}})),
              "event 2 of 2: rotate 45 deg (log.csv line 3): a turn by 45 deg does not fit a "
              "periodic tile, which turns by multiples of 90 deg");
  expect_told(refusal(rough_pair(12, 8), Protocol({{pressure(1)}, {Protocol::Rotate{quarter}}})),
              "event 2 of 2: rotate 90 deg: a turn by 90 deg does not fit a tile that is not square");
  expect_told(refusal(rough_pair(), Protocol({{pressure(1)}, {Protocol::Shift{0.1, 0}}})),
              "event 2 of 2: shift");
  const auto free_pair = std::make_shared<SpecimenPair>(
      scene_of(random_surface(12, 12, 1), random_surface(12, 12, 2), 3.0, Boundary::free));
  EXPECT_NO_THROW(ProtocolRun(Protocol({{pressure(1)}, {Protocol::Rotate{0.5 * quarter}}}), free_pair));
  expect_told(refusal(free_pair, Protocol({{pressure(1)}, {Protocol::Shift{0.25, 0}}})),
              "event 2 of 2: shift by 250 mm along x and 0 m along y: `shift` is given on a free boundary");
}

TEST(ProtocolRun, AStopIsSeenBetweenEvents) {
  const auto pair = rough_pair();
  ProtocolRun run(five(), pair);
  run.step();
  stop_flag().raise(StopReason::interrupt);
  ErrorCode code = ErrorCode::internal;
  try {
    run.step();
  } catch (const Error& error) {
    code = error.code();
  }
  stop_flag().clear();
  EXPECT_EQ(code, ErrorCode::interrupted);
  EXPECT_TRUE(pair->under_load());
  run.step();
  EXPECT_FALSE(pair->under_load());
}

class Recorder final : public Monitor {
 public:
  void progress(std::string_view, double) override {}
  void progress_of_parts(std::string_view, double done, std::string_view part, double) override {
    lines.push_back(std::string(part) + " " + std::to_string(done).substr(0, 4));
  }
  void warn(std::string_view) override {}
  std::vector<std::string> lines;
};

TEST(ProtocolRun, ProgressIsThatOfThePresses) {
  Recorder recorder;
  ProtocolRun run(five(), rough_pair());
  while (!run.finished()) run.step(recorder);
  const std::vector<std::string> expected = {
      "event 1 of 5: press 1 Pa 0.00", "event 2 of 5: release 0.50", "event 3 of 5: place with seed 4 0.50",
      "event 4 of 5: rotate 90 deg 0.50", "event 5 of 5: press 2 Pa 0.50"};
  EXPECT_EQ(recorder.lines, expected);
}

}  // namespace
}  // namespace asperity::protocol_run_test

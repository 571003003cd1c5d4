// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/recording/protocol_chart.hpp"

#include <numbers>

#include "engine/recording/event_detection.hpp"
#include "tests/recording/synthetic_recording.hpp"
#include "tests/support/run_fixture.hpp"

namespace asperity::protocol_chart_test {
namespace {

constexpr double quarter = 0.5 * std::numbers::pi;

std::string series_of(const LineChart& chart) {
  std::string names;
  for (const ChartSeries& series : chart.series) names += series.name + " ";
  return names;
}
std::string labels_of(const LineChart& chart) {
  std::string texts;
  for (const ChartLabel& label : chart.labels) texts += label.text + "; ";
  return texts;
}

TEST(ProtocolChart, ARecordingIsDrawnUnderWhatWasFound) {
  SyntheticPress press;
  press.holds = {{100, 150, 2, 2, 0.2, 20, quarter}, {60, 300, 3, 3}, {60, 200, 3, 3}};
  SyntheticTruth truth;
  const LineChart chart = protocol_chart(detect_events(play(press, 1, truth)), "a title");
  EXPECT_EQ(series_of(chart), "recorded detected rise peak release turn ");
  EXPECT_EQ(labels_of(chart), "hold 100 N, 2.5 min; 90 deg; hold 60 N, 5 min; hold 60 N, 3.33 min; ");
  EXPECT_EQ(chart.x.label, "time (min)");
  EXPECT_EQ(chart.y.unit, "N");
  std::vector<std::string> warnings;
  EXPECT_FALSE(chart_script(chart, PictureFormat::svg, warnings).empty());
  EXPECT_TRUE(warnings.empty());
}

TEST(ProtocolChart, DwellsAddUpWhereNoTimesAreKnown) {
  const Protocol protocol({{PressRequest{PressBy::pressure, 1e6, 60.0}},
                           {Protocol::Release{}},
                           {Protocol::Place{1}},
                           {PressRequest{PressBy::pressure, 2e6, 120.0}},
                           {PressRequest{PressBy::pressure, 1e6, 30.0}}});
  const LineChart chart = protocol_chart(protocol, "");
  EXPECT_EQ(series_of(chart), "protocol rise release turn ");
  EXPECT_EQ(chart.x.label, "time under load, as the dwells add up (s)");
  EXPECT_EQ(labels_of(chart), "hold 1 MPa, 60 s; placed; hold 2 MPa, 2 min; hold 1 MPa, 30 s; ");
}

TEST(ProtocolChart, RecordedTimesAreKept) {
  const Protocol protocol({{PressRequest{PressBy::load, 5, 60.0}, 100.0},
                           {Protocol::Release{}, 170.0},
                           {Protocol::Rotate{quarter}, 200.0},
                           {PressRequest{PressBy::load, 5}, 300.0}});
  const LineChart chart = protocol_chart(protocol, "");
  EXPECT_EQ(chart.x.label, "time (s)");
  EXPECT_EQ(chart.series.front().x.back(), 300.0);
}

TEST(ProtocolChart, WithoutDwellsEventsStandOneByOne) {
  const LineChart chart =
      protocol_chart(Protocol({{PressRequest{PressBy::load, 5}}, {Protocol::Release{}}}), "");
  EXPECT_EQ(chart.x.label, "event");
  EXPECT_EQ(labels_of(chart), "hold 5 N; ");
}

TEST(ProtocolChart, OneAxisHoldsLoadsOrPressures) {
  EXPECT_EQ(
      error_of([] {
        protocol_chart(Protocol({{PressRequest{PressBy::load, 5}}, {PressRequest{PressBy::pressure, 5}}}),
                       "");
      }),
      "bad_value: a chart has one axis of loads, and this protocol presses by pressure and by load; give "
      "all presses by `pressure`, or all by `load`");
}

TEST(ProtocolChart, ManyHoldsGoWithoutLabels) {
  std::vector<Protocol::Event> events;
  for (int k = 1; k < 40; ++k) events.push_back({PressRequest{PressBy::load, 1.0 * k, 10.0}});
  EXPECT_TRUE(protocol_chart(Protocol(events), "").labels.empty());
}

}  // namespace
}  // namespace asperity::protocol_chart_test

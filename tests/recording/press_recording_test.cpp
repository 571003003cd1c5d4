// SPDX-License-Identifier: GPL-3.0-or-later
// Units, missing cells, errors by line and column, recognition.
#include "engine/recording/press_recording.hpp"

#include <cmath>
#include <numbers>

#include "engine/core/files/source_file.hpp"
#include "tests/support/run_fixture.hpp"
#include "tests/support/warnings.hpp"

namespace asperity::press_recording_test {
namespace {

PressRecording read(const std::string& text) { return read_press_recording(SourceFile("press.csv", text)); }
std::string refusal(const std::string& text) {
  return error_of([&] { read(text); });
}

TEST(PressRecording, UnitsAreThoseOfTheTitles) {
  const PressRecording r = read("Time [min]; Load [kN]; Angle [deg]\n-1; 0,25; 90\n0,5; -0.001; \n1; ; 45\n");
  EXPECT_EQ(r.name, "press.csv");
  EXPECT_EQ(r.by, PressBy::load);
  ASSERT_EQ(r.time.size(), 3U);
  EXPECT_EQ(r.time[0], -60.0);
  EXPECT_EQ(r.time[1], 30.0);
  EXPECT_EQ(r.load[0], 250.0);
  EXPECT_EQ(r.load[1], -1.0);
  EXPECT_TRUE(std::isnan(r.load[2]));
  EXPECT_TRUE(std::isnan(r.angle[1]));
  EXPECT_DOUBLE_EQ(r.angle[2], 0.25 * std::numbers::pi);
  EXPECT_EQ(r.line[2], 4U);
  EXPECT_EQ(read("time [ms],pressure [MPa]\n1,2\n").by, PressBy::pressure);
  EXPECT_TRUE(read("time [ms],pressure [MPa]\n1,2\n").angle.empty());
  EXPECT_TRUE(std::isnan(read("time [s],load [N]\n1,NaN\n").load[0]));
}

TEST(PressRecording, TimesIncreaseOrTheirLinesAreNamed) {
  EXPECT_EQ(refusal("time [s],load [N]\n1,1\n1,1\n0.5,1\n,1\nx,1\n2,y\n"),
            "bad_file: \"press.csv\" has 5 problems\n"
            "  line 3, column 1 (time): the time 1 s is in line 2 too; write more of its digits, or "
            "spread such rows by equal_times=\"spread\"\n"
            "  line 4, column 1 (time): the time 0.5 s runs backwards, after 1 s\n"
            "  line 5, column 1 (time): the time is missing\n"
            "  line 6, column 1 (time): \"x\" is no number\n"
            "  line 7, column 2 (load): \"y\" is no number");
}

TEST(PressRecording, ColumnsOfEventsAndLackOfTimesAreRefused) {
  EXPECT_EQ(refusal("load [N]\n1\n"),
            "bad_file: \"press.csv\" line 1: no column `time`, and events need one; write \"time "
            "[s]\"");
  EXPECT_TRUE(refusal("time [s],load [N],dwell [min]\n1,1,1\n")
                  .find("line 1, column 3 (dwell): a recording has no such column") != std::string::npos);
  EXPECT_TRUE(refusal("time [s],load [N],pressure [Pa]\n1,1,1\n").find("both `pressure` and `load`") !=
              std::string::npos);
  EXPECT_TRUE(refusal("time [s]\n1\n").find("no column `pressure` or `load`") != std::string::npos);
  EXPECT_TRUE(refusal("time [s],load [N]\n").find("names columns but holds no row") != std::string::npos);
}

// An unknown unit does not prevent recognition.
TEST(PressRecording, AUnitThatIsNotReadIsToldAndNotTheRows) {
  std::string text = "time [s],load [kN],angle [gon]\n";
  for (int k = 0; k < 120; ++k)
    text += std::to_string(k) + "," + std::to_string(k % 2 == 0 ? -0.1 : 0.1) + ",0\n";
  EXPECT_TRUE(looks_like_recording(SourceFile("press.csv", text)));
  EXPECT_NE(refusal(text).find("line 1, column 3 (angle): \"gon\": unknown unit `gon`"), std::string::npos)
      << refusal(text);
  text.replace(text.find("gon"), 3, "rev");
  EXPECT_EQ(refusal(text), "");
  EXPECT_DOUBLE_EQ(read("time [s],load [N],angle [rev]\n0,1,0.25\n").angle[0], 0.5 * std::numbers::pi);
}

TEST(PressRecording, OtherNamesAndStampsAreRead) {
  const PressRecording r =
      read("Zeit;Kraft [kN];Winkel [deg]\n23.11.2026 10:00:00,5;1,5;0\n23.11.2026 10:01:00;2;90\n");
  ASSERT_EQ(r.time.size(), 2U);
  EXPECT_EQ(r.time[0], 0.0);
  EXPECT_EQ(r.time[1], 59.5);
  EXPECT_EQ(r.load[0], 1500.0);
  EXPECT_DOUBLE_EQ(r.angle[1], 0.5 * std::numbers::pi);
}

// A logger faster than its clock.
TEST(PressRecording, EqualTimesAreSpreadWhereThatIsSaid) {
  const SourceFile file("press.csv", "time [s],load [N]\n0,1\n0,2\n1,3\n1,4\n2,5\n2,6\n2,7\n");
  test::Warnings listener;
  const PressRecording r = read_press_recording(file, listener, {}, EqualTimes::spread);
  const std::vector<double> wanted{0, 0.5, 1, 1.5, 2, 2.5, 3};
  ASSERT_EQ(r.time.size(), wanted.size());
  for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_EQ(r.time[k], wanted[k]) << k;
  ASSERT_EQ(listener.all.size(), 1U);
  EXPECT_EQ(listener.all[0],
            "\"press.csv\": 4 rows have the time of the row before them, and are spread evenly until the "
            "next time");
  EXPECT_EQ(error_of([] {
              read_press_recording(SourceFile("press.csv", "time [s],load [N]\n5,1\n5,2\n"),
                                   Monitor::silent(), {}, EqualTimes::spread);
            }),
            "bad_file: \"press.csv\" has the same time in all of its rows");
}

TEST(PressRecording, LooksLikeOneFromAHundredRowsWithoutDwellsOrTurns) {
  const auto table = [](const std::string& titles, const std::string& rest, int rows) {
    std::string text = titles + "\n";
    for (int k = 0; k < rows; ++k) text += std::to_string(k) + ",1" + rest + "\n";
    return looks_like_recording(SourceFile("press.csv", text));
  };
  EXPECT_TRUE(table("time [s],load [N]", "", 100));
  EXPECT_FALSE(table("time [s],load [N]", "", 99));
  EXPECT_TRUE(table("time [s],load [N],angle [deg]", ",90", 100));
  EXPECT_TRUE(table("time [s],load [N],rotation [deg]", ",0", 100));
  EXPECT_FALSE(table("time [s],load [N],rotation [deg]", ",90", 100));
  EXPECT_FALSE(table("time [s],load [N],dwell [s]", ",", 100));
  EXPECT_FALSE(table("time [s],load [N],turn [deg]", ",0", 100));
  EXPECT_FALSE(table("load [N],other", "", 100));
}

}  // namespace
}  // namespace asperity::press_recording_test

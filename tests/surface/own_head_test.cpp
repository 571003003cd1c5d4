// SPDX-License-Identifier: GPL-3.0-or-later
// Reliable entries of text headers are used, others ignored; doubtful tables are refused.
#include "engine/surface/io/own_head.hpp"

#include "engine/surface/io/read.hpp"
#include "tests/support/warnings.hpp"
#include "tests/surface/files.hpp"

namespace asperity::own_head_test {
namespace {

using test::Warnings;
using testing::message_of;

constexpr const char* map = "10 20 31\n40 55 60\n71 80 90\n";

Surface surface_of(const std::string& text, const ReadOptions& options = {},
                   Monitor& monitor = Monitor::silent()) {
  return read_surface(SourceFile("map.txt", text), options, monitor);
}
std::string refusal(const std::string& text, const std::string& format = "") {
  ReadOptions options;
  options.size_x = options.size_y = options.unit = 1e-6;
  options.format = format;
  return message_of([&] { surface_of(text, options); });
}

TEST(OwnHead, ItsLengthsAndCountsAreTaken) {
  for (const char* head :
       {"Profiler of the hall\nOperator Li\nColumns: 3\nX Range: 30 um\nY Range: 0.06 mm\nZ unit: nm\n",
        "Profiler\npixels = 3 x 3\nscan size = 30 um x 60 um\nheight unit nm\n",
        "Profiler\nresolution\t3x3\nScan-Size [um]\t30 x 60\nUnits of height: nm\n",
        "\"Measured data\"\n\"Number of columns\",\"3\"\n\"x spacing\",\"10\",\"um\"\n\"y "
        "spacing\",\"20\",\"um\"\n"
        "\"Z unit\",\"nm\"\n",
        "Profiler\n# columns: 3\n# dx: 10 \xC2\xB5m\n# dy: 20 \xC2\xB5m\nnx=3\nHeight [nm]\n"}) {
    const Surface surface = surface_of(std::string(head) + map);
    EXPECT_NEAR(surface.grid().size_x, 30e-6, 1e-18) << head;
    EXPECT_NEAR(surface.grid().size_y, 60e-6, 1e-18) << head;
    EXPECT_EQ(surface.grid().nx, 3) << head;
    EXPECT_NEAR(surface.height(2, 0), 31e-9, 1e-20) << head;
    EXPECT_NEAR(surface.height(0, 2), 71e-9, 1e-20) << head;
  }
}

TEST(OwnHead, ALengthWithoutAUnitIsPassedOver) {
  const std::string text = std::string("Profiler\ncolumns 3\nX Range: 30\nY Range: 60\n") + map;
  EXPECT_NE(message_of([&] { surface_of(text); }).find("does not say its size and unit"), std::string::npos);
  EXPECT_EQ(refusal(text), "no error");
}

TEST(OwnHead, ASquareIsSquareOnlyOnAsManyRowsAsColumns) {
  const std::string head = "Profiler\ncolumns 3\nScan size: 30 um\nZ unit: nm\n";
  EXPECT_EQ(surface_of(head + map).grid().size_y, surface_of(head + map).grid().size_x);
  EXPECT_NE(message_of([&] { surface_of(head + "1 2 3\n4 5 7\n"); }).find("does not say its size"),
            std::string::npos);
}

TEST(OwnHead, WhatIsStatedTwiceIsNotUsed) {
  Warnings warnings;
  const std::string text =
      std::string("Profiler\ncolumns 3\nX size 30 um\nX length 40 um\nY size 60 um\nZ unit nm\n") + map;
  ReadOptions options;
  EXPECT_NE(message_of([&] { surface_of(text, options, warnings); }).find("does not say its size"),
            std::string::npos);
  EXPECT_TRUE(warnings.told("has two values for its size along x in its head"));
  options.size_x = 30e-6;
  EXPECT_EQ(surface_of(text, options).grid().size_x, 30e-6);
}

TEST(OwnHead, CountsThatContradictTheTableAreRefused) {
  EXPECT_NE(refusal(std::string("Profiler\ncolumns: 4\n") + map).find("4 columns but holds 3"),
            std::string::npos);
  EXPECT_NE(refusal(std::string("Profiler\ncolumns: 3\nrows: 4\n") + map).find("4 rows but holds 3"),
            std::string::npos);
  const std::string turned = refusal("Profiler\npixels: 2 x 3\n1 2 4\n3 4 7\n");
  EXPECT_NE(turned.find("states 2 columns and 3 rows"), std::string::npos) << turned;
  EXPECT_NE(turned.find("transpose the numbers"), std::string::npos) << turned;
  EXPECT_NE(refusal(std::string("Profiler\nnx 3\n") + map + "1 2\n").find("2 cells in line 6"),
            std::string::npos);
}

TEST(OwnHead, ASpacingIsThatOfNodesAndALengthThatContradictsItIsRefused) {
  const std::string rest = std::string("dy 20 um\ncolumns 3\nZ unit nm\n") + map;
  for (const char* length : {"20 um", "30 um"})  // between outer nodes; of all cells
    EXPECT_NEAR(surface_of("Profiler\ndx 10 um\nX Range: " + std::string(length) + "\n" + rest).grid().size_x,
                30e-6, 1e-18);
  EXPECT_NE(message_of([&] {
              surface_of("Profiler\ndx 10 um\nX Range: 40 um\n" + rest);
            }).find("3 points 10 um apart"),
            std::string::npos);
  // "1,250" may be thousands.
  EXPECT_NE(
      message_of([&] { surface_of("Profiler\nX Range: 1,250 um\n" + rest); }).find("does not say its size"),
      std::string::npos);
}

TEST(OwnHead, ATraceAndPointsGoByTheLastLineOfTheHead) {
  const Profile trace =
      read_profile(SourceFile("t.prf", "Stylus profiler\nOperator Li\nx [mm],z [um]\n0,1\n0.1,2\n0.2,4\n"));
  EXPECT_NEAR(trace.spacing(), 1e-4, 1e-16);
  EXPECT_NEAR(trace.heights()[2], 4e-6, 1e-18);
  const Profile heights =
      read_profile(SourceFile("t.prf", "Stylus profiler\nSpacing: 0.5 um\nHeight [nm]\n5\n7\n6\n8\n"));
  EXPECT_NEAR(heights.spacing(), .5e-6, 1e-18);
  EXPECT_NEAR(heights.heights()[1], 7e-9, 1e-20);
  const Surface points =
      surface_of("Profiler\nOperator Li\nx [um];y [um];z [nm]\n0;0;1\n1;0;2\n0;2;3\n1;2;4\n");
  EXPECT_EQ(points.grid().nx, 2);
  EXPECT_NEAR(points.grid().hy(), 2e-6, 1e-18);
  EXPECT_NEAR(points.height(1, 1), 4e-9, 1e-20);
}

TEST(OwnHead, WhatMayBeNoMapIsRefused) {
  std::string wrapped = "Profiler of the hall\n", ruled = "Map\nof the hall\n 0 1 2 3 4\n",
              log = "t [s] F [N] T u\n";
  for (int k = 0; k < 100; ++k) wrapped += std::to_string(k * k % 17) + " 2 5 4\n";
  for (int k = 0; k < 4; ++k) ruled += std::to_string(5 * k) + " 3 2 7 4\n";
  for (int k = 0; k < 4; ++k) log += std::to_string(k * k) + " 3 2 7\n";
  for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
           {"Profiler\nthe hall's\n0 1.2\n.1 1.3\n.2 1.1\n", "positions and heights, or a matrix"},
           {std::string("Profiler\n") + map, "x y z points, or a matrix"},
           {wrapped, "may be a wrapped matrix"},
           {ruled, "rises evenly"},
           {log, "by `table.read`"}}) {
    const std::string message = refusal(text);
    EXPECT_NE(message.find("has a head in lines 1 ("), std::string::npos) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
    EXPECT_EQ(refusal(text, "text"), "no error") << text;
  }
  EXPECT_EQ(refusal("columns = 4\n" + wrapped), "no error");
  EXPECT_EQ(refusal(std::string("Profiler\ncolumns 3\n") + map), "no error");
}

TEST(OwnHead, IsNoneOverOneLineOfNumbersOrNone) {
  EXPECT_FALSE(own_head(SourceFile("a.txt", "words\n1 2 3\n")));
  EXPECT_FALSE(own_head(SourceFile("a.txt", "words\nand words\n")));
  EXPECT_FALSE(own_head(SourceFile("a.txt", "1 2\n3 4\nwords\n5 6\n7 8\n")));
  EXPECT_FALSE(own_head(SourceFile("a.txt", "x [mm],z [um]\n0,1\n1,2\n")));
  const auto head = own_head(SourceFile("a.txt", "Profiler\n12 13\n\nmore words\n\n1 2 3\n4 5 6\n"));
  ASSERT_TRUE(head);
  EXPECT_EQ(head->lines, 5u);
  EXPECT_EQ(head->columns, 3u);
}

}  // namespace
}  // namespace asperity::own_head_test

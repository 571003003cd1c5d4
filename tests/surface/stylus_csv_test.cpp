// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <vector>

#include "engine/surface/io/read.hpp"
#include "tests/support/warnings.hpp"
#include "tests/surface/files.hpp"

namespace asperity::stylus_csv_test {
namespace {

using testing::measured;
using testing::message_of;
using testing::sample;
using testing::Scratch;

TEST(StylusCsv, SpacingComesFromAllRoundedPositions) {
  const Profile profile = read_profile(sample("trace.csv"));
  EXPECT_EQ(profile.size(), 20);
  EXPECT_NEAR(profile.spacing(), 0.156e-6, 0.002e-6);
  EXPECT_NEAR(profile.heights()[1], 0.003e-6, 1e-18);
  EXPECT_NEAR(profile.heights()[0], -0.004e-6, 1e-18);
}

TEST(StylusCsv, SurfaceOfOneRow) {
  const Surface surface = read_surface(sample("trace.csv"));
  EXPECT_EQ(surface.grid().nx, 20);
  EXPECT_EQ(surface.grid().ny, 1);
  EXPECT_DOUBLE_EQ(surface.grid().hx(), surface.grid().hy());
  ReadOptions options;
  options.size_y = 1e-4;
  EXPECT_EQ(read_surface(sample("trace.csv"), options).grid().size_y, 1e-4);
}

TEST(StylusCsv, UnitsOfTheTitles) {
  const Scratch scratch;
  const auto spacing_and_height = [&](const std::string& titles) {
    const Profile p = read_profile(scratch.write("t.csv", "Scan Data\n" + titles + "\n0,1\n1,2\n2,3\n"));
    return std::pair(p.spacing(), p.heights()[0]);
  };
  EXPECT_EQ(spacing_and_height("Lateral um,Raw Micrometer,"), std::pair(1e-6, 1e-6));
  EXPECT_EQ(spacing_and_height("Lateral(\xB5m),Total Profile(\xC5)"), std::pair(1e-6, 1e-10));
  EXPECT_EQ(spacing_and_height("Lateral mm,Height [nm]"), std::pair(1e-3, 1e-9));
  EXPECT_NE(
      message_of([&] { spacing_and_height("Lateral parsnips,Raw um"); }).find("no known unit of length"),
      std::string::npos);
  EXPECT_NE(message_of([&] { spacing_and_height("Lateral um,Raw"); }).find("does not say its unit"),
            std::string::npos);
}

TEST(StylusCsv, UnevenOrCutShort) {
  const Scratch scratch;
  const auto refusal = [&](const std::string& data) {
    return message_of([&] { read_profile(scratch.write("t.csv", "Scan Data\nLateral um,Raw um\n" + data)); });
  };
  EXPECT_NE(refusal("0,1\n1,2\n2,3\n9,4\n10,5\n").find("is not evenly spaced"), std::string::npos);
  EXPECT_NE(refusal("0,1\n").find("fewer than two samples"), std::string::npos);
  EXPECT_NE(refusal("0,1\n1").find("has no height in line 4"), std::string::npos);
  EXPECT_NE(refusal("2,1\n1,1\n").find("do not increase"), std::string::npos);
  EXPECT_NE(refusal("0,1\nx,1\n").find("has no position in line 4: \"x\""), std::string::npos);
  EXPECT_NE(refusal("0,\n1,\n2,\n").find("holds no height"), std::string::npos);
  const Profile holed = read_profile(scratch.write("t.csv", "Scan Data\nLateral um,Raw um\n0,1\n1,\n2,3\n"));
  EXPECT_EQ(holed.measured(), 2U);
  EXPECT_EQ(holed.measured_heights()[2], 3e-6);
  EXPECT_NE(message_of([&] { read_profile(scratch.write("t.csv", "Scan Data\n\n")); }).find("ends after"),
            std::string::npos);
}

// Samples 1 um apart; stated length 100 um.
std::string trace_of(int samples, const std::string& header) {
  std::string text = header + "\nScan Data\nLateral um,Raw um,\n";
  for (int k = 0; k < samples; ++k) text += std::to_string(k) + ".0,0." + std::to_string(k % 7) + ",,\r\n";
  return text;
}

TEST(StylusCsv, LessThanTheStatedLengthIsRefused) {
  const Scratch scratch;
  const auto answer = [&](int samples, const std::string& header) {
    return message_of([&] { read_profile(scratch.write("t.csv", trace_of(samples, header))); });
  };
  const std::string header = "Length,100.0 um\nResolution,1.000 um/sample";
  EXPECT_EQ(answer(100, header), "no error");
  EXPECT_EQ(answer(99, header), "no error");
  EXPECT_EQ(
      answer(50, header),
      "\"" + scratch.path("t.csv") +
          "\" covers 50 um of the 100 um that its header states; the file is cut short, or the scan was "
          "stopped: then correct `Length` in the file");
  EXPECT_NE(answer(98, header).find("covers 98 um of the 100 um"), std::string::npos);
  EXPECT_NE(answer(60, "Length,0.1 mm").find("covers 60 um of the 100 um"), std::string::npos);
  EXPECT_NE(answer(60, "Length,100 \xB5m").find("covers 60 um of the 100 um"), std::string::npos);
  EXPECT_EQ(answer(50, "Length,unknown"), "no error");
  EXPECT_EQ(answer(50, "Resolution,1.000 um/sample"), "no error");  // no end stated
}

TEST(StylusCsv, MoreThanTheStatedLengthIsAWarning) {
  const Scratch scratch;
  test::Warnings listener;
  EXPECT_EQ(read_profile(scratch.write("t.csv", trace_of(100, "Length,50 um")), {}, listener).size(), 100);
  ASSERT_EQ(listener.all.size(), 1U);
  EXPECT_NE(listener.all[0].find("says it is 50 um long but its samples span 100 um"), std::string::npos);
}

// A truncated 1.258 reads as 1.25.
TEST(StylusCsv, LastLineWithoutEndIsAWarning) {
  const Scratch scratch;
  const std::string whole = testing::bytes_of(sample("trace.csv"));
  const auto warnings = [&](const std::string& bytes) {
    test::Warnings listener;
    read_profile(scratch.write("t.csv", bytes), {}, listener);
    read_surface(scratch.path("t.csv"), {}, listener);
    return listener.all;
  };
  EXPECT_TRUE(warnings(whole).empty());
  const std::size_t last = whole.find_last_not_of("\r\n");
  EXPECT_TRUE(warnings(whole.substr(0, last + 2)).empty());
  for (const std::size_t cut : {last + 1, last, last - 2}) {
    const std::vector<std::string> found = warnings(whole.substr(0, cut));
    ASSERT_EQ(found.size(), 2U) << cut;
    EXPECT_EQ(found[0],
              "\"" + scratch.path("t.csv") +
                  "\": the last line has no line end; if the file was cut short its last height may "
                  "be wrong");
  }
}

TEST(StylusCsv, DamagedBytesGiveErrors) {
  const Scratch scratch;
  int read = 0;
  testing::damage(testing::bytes_of(sample("trace.csv")), 13, 200, [&](const std::string& bytes) {
    ReadProfileOptions options;
    options.fill = HoleFill::interpolate();
    read_profile(scratch.write("damaged.csv", bytes), options);
    ++read;
  });
  EXPECT_GT(read, 0);
}

TEST(StylusCsv, MeasuredFile) {
  if (measured("").empty()) GTEST_SKIP() << "ASPERITY_MEASURED is not set: no measured files here";
  test::Warnings listener;
  const Profile profile = read_profile(measured("dektak-1.csv"), {}, listener);
  EXPECT_TRUE(listener.all.empty());
  EXPECT_NEAR(profile.length(), 1500e-6, 1e-10);  // as stated
  EXPECT_NEAR(profile.spacing(), 0.156e-6, 0.0005e-6);
  EXPECT_NEAR(profile.heights()[0], -0.00933e-6, 1e-18);
  EXPECT_NEAR(profile.heights()[1], -0.00760e-6, 1e-18);
  EXPECT_NEAR(profile.heights().back(), 16.58112e-6, 1e-16);
  EXPECT_EQ(read_surface(measured("dektak-1.csv")).grid().nx, profile.size());
  const Scratch scratch;
  const std::string whole = testing::bytes_of(measured("dektak-1.csv"));
  EXPECT_NE(
      message_of([&] {
        read_profile(scratch.write("half.csv", whole.substr(0, whole.find('\n', whole.size() / 2) + 1)));
      }).find("of the 1.5 mm that its header states"),
      std::string::npos);
}

}  // namespace
}  // namespace asperity::stylus_csv_test

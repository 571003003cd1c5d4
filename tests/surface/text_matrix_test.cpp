// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "engine/core/files/text_table.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"

namespace asperity::text_matrix_test {
namespace {

using testing::measured;
using testing::message_of;
using testing::sample;
using testing::Scratch;

Surface read_text(const std::string& text, const std::string& format = "") {
  const Scratch scratch;
  ReadOptions options;
  options.format = format;
  options.size_x = options.size_y = 1;
  options.unit = 1;
  options.fill = HoleFill::with(-99);
  return read_surface(scratch.write("table.txt", text), options);
}

std::vector<double> heights_of(const Surface& surface) {
  const auto values = surface.heights().values();
  return {values.begin(), values.end()};
}

using Heights = std::vector<double>;

// Without a format, two lines of three numbers may be two points.
TEST(TextMatrix, FirstLineIsRowZero) {
  const Surface surface = read_text("1 2 3\n4 5 6\n", "text");
  EXPECT_EQ(surface.grid().nx, 3);
  EXPECT_EQ(surface.grid().ny, 2);
  EXPECT_EQ(surface.height(2, 0), 3);
  EXPECT_EQ(surface.height(0, 1), 4);
}

TEST(TextMatrix, Separators) {
  const Heights expected{1, -2.5, 3e-3, 4, 5, 6};
  for (const char* text :
       {"1 -2.5 3e-3\n4 5 6\n", "1,-2.5,3e-3\n4,5,6\n", "1, -2.5, 3e-3\n4, 5, 6", "1;-2.5;3e-3\n4;5;6",
        "1\t-2.5\t3e-3\n4\t5\t6", "  1  -2.5\t 3e-003 \n\n 4 5 6 \n\n", "1;-2,5;3e-3\n4;5;6\n",
        "1 -2,5 3e-3\n4 5 6\n", "+1 -2.5 +3E-3\n4. 5.0 6e0\n", "1,-2.5,3e-3,\n4,5,6,\n",
        "1\t-2,5\t0,003\t\n4\t5\t6\t\n", "\"1\",\"-2.5\",\"0.003\"\n4,5,6\n"}) {
    const Surface surface = read_text(text, "text");
    EXPECT_EQ(surface.grid().nx, 3) << text;
    EXPECT_EQ(heights_of(surface), expected) << text;
  }
}

TEST(TextMatrix, LineEndsMarksAndComments) {
  const Heights expected{1, 2, 3, 4};
  for (const char* text : {"1 2\r\n3 4\r\n", "1 2\r\r\n3 4\r\r\n", "1 2\r3 4\r", "1 2\n3 4",
                           "\xEF\xBB\xBF"
                           "1 2\n3 4\n",
                           "# a comment\n1 2 # here too\n% another\n3 4\n"})
    EXPECT_EQ(heights_of(read_text(text)), expected) << text;
}

TEST(TextMatrix, Holes) {
  EXPECT_EQ(heights_of(read_text("1,,3\n-nan,BAD,NaN\n---,null,5\n")),
            (Heights{1, -99, 3, -99, -99, -99, -99, -99, 5}));
  EXPECT_EQ(heights_of(read_text("\t2\n3\t\n")), (Heights{-99, 2, 3, -99}));
}

TEST(TextMatrix, WhatIsNoTable) {
  EXPECT_NE(message_of([] {
              read_text("1 2 3\n4 5\n");
            }).find("has 2 cells in line 2 but 3 in the lines before it"),
            std::string::npos);
  EXPECT_NE(message_of([] { read_text("1 2\n3 four\n"); }).find("has no number in line 2, cell 2: \"four\""),
            std::string::npos);
  EXPECT_NE(message_of([] { read_text("1 2\n3 inf\n"); }).find("has an infinite number in line 2, cell 2"),
            std::string::npos);
  EXPECT_NE(message_of([] { read_text("1 2\n3 1e999\n"); }).find("has a number too large for a double"),
            std::string::npos);
  EXPECT_EQ(read_text("1 2\n3 1e-999\n").height(1, 1), 0);
  EXPECT_NE(message_of([] { read_text("# only words\n"); }).find("holds no table of numbers"),
            std::string::npos);
  EXPECT_NE(message_of([] { read_text(std::string("1\0 2", 4)); }).find("is not text"), std::string::npos);
  EXPECT_NE(message_of([] { read_text("1 2 1e3\n4 5 1,000.5\n"); }).find("has no number in line 2"),
            std::string::npos);
}

TEST(TextMatrix, HeadsOfAGermanGwyddion) {
  const Surface surface = read_surface(SourceFile(
      "map.txt", "# Breite: 12.34 \u00B5m\n# H\u00F6he: 5678.9 nm\n# Value units: um\n1 2\n3 4\n5 6\n"));
  EXPECT_NEAR(surface.grid().size_x, 12.34e-6, 1e-18);
  EXPECT_NEAR(surface.grid().size_y, 5678.9e-9, 1e-18);
}

// With and without a byte order mark.
TEST(TextMatrix, TextInUtf16IsReadAsItsLetters) {
  const std::string text = "# Value units: um\n# Width: 3 \u00B5m\n# Height: 2 \u00B5m\n1\t2\t3\n4\t5\t6\n";
  const Surface wanted = read_surface(SourceFile("map.txt", text));
  for (const bool little : {true, false})
    for (const bool marked : {true, false}) {
      std::string bytes = !marked ? "" : little ? "\xFF\xFE" : "\xFE\xFF";
      for (std::size_t k = 0; k < text.size(); ++k) {
        const bool micro = text[k] == '\xC2';
        const char low = micro ? text[++k] : text[k];
        bytes += little ? std::string({low, '\0'}) : std::string({'\0', low});
      }
      const Surface surface = read_surface(SourceFile("map.txt", bytes));
      EXPECT_EQ(surface.digest(), wanted.digest()) << little << marked;
      EXPECT_EQ(surface.grid().size_x, 3e-6);
    }
  const std::string cut = "\xFF\xFE" + std::string("x\0y\0\n\0", 6);
  EXPECT_NE(message_of([&] { read_surface(SourceFile("map.txt", cut)); }).find("holds no table of numbers"),
            std::string::npos);
}

TEST(TextMatrix, InstrumentHeader) {
  const Surface surface = read_surface(sample("instrument.txt"));
  EXPECT_EQ(surface.grid().nx, 4);
  EXPECT_EQ(surface.grid().ny, 3);
  EXPECT_DOUBLE_EQ(surface.grid().size_x, 1e-6);
  EXPECT_DOUBLE_EQ(surface.grid().size_y, 0.75e-6);
  EXPECT_DOUBLE_EQ(surface.height(3, 2), -20e-8);
}

TEST(TextMatrix, HeadersThatLie) {
  const Scratch scratch;
  const std::string whole = testing::bytes_of(sample("instrument.txt"));
  const std::string taller = scratch.write("taller.txt", "h=4" + whole.substr(3));
  EXPECT_NE(
      message_of([&] { read_surface(taller); }).find("says in its header that it has 4 rows but holds 3"),
      std::string::npos);
  std::string wider = whole;
  wider.replace(wider.find("w=4"), 3, "w=5");
  EXPECT_NE(
      message_of([&] { read_surface(scratch.write("wider.txt", wider)); }).find("5 columns but holds 4"),
      std::string::npos);
  EXPECT_NE(message_of([&] {
              read_surface(scratch.write("pixel.txt", "h=1 w=1\npixel size=-1 m\n1\n"));
            }).find("a header whose `pixel size` is \"-1 m\""),
            std::string::npos);
}

TEST(TextMatrix, CommentHeaderWithUnits) {
  const Scratch scratch;
  const Surface surface = read_surface(scratch.write(
      "export.txt", "# Channel: Height\n# Width: 10 um\n# Height: 5 um\n# Value units: nm\n1 2\n3 4\n"));
  EXPECT_DOUBLE_EQ(surface.grid().size_x, 1e-5);
  EXPECT_DOUBLE_EQ(surface.grid().size_y, 5e-6);
  EXPECT_DOUBLE_EQ(surface.height(1, 0), 4e-9);
}

TEST(TextMatrix, DecimalCommaSample) {
  ReadOptions options;
  options.size_x = options.size_y = 1;
  options.unit = 1;
  options.fill = HoleFill::with(0);
  EXPECT_EQ(heights_of(read_surface(sample("semicolon.csv"), options)), (Heights{1.5, 2.25, -3, 4, 0, 0.65}));
}

TEST(TextMatrix, AKeyThatIsNoTextIsNotRepeated) {
  EXPECT_NE(message_of([] {
              read_text("h=1 w=2\nheight conversion factor (-\xFE\x1B> m)=0\n1 2\n");
            }).find("has a header whose `height conversion factor` is \"0\"; it must be"),
            std::string::npos);
}

// A quadratic search took hours.
TEST(TextMatrix, CarriageReturnsAloneTakeOnePass) {
  const Surface surface = read_text(std::string(std::size_t{4} << 20, '\r') + "1 2\r\r\n3 4\r\n");
  EXPECT_EQ(heights_of(surface), (Heights{1, 2, 3, 4}));
}

TEST(TextMatrix, DamagedBytesGiveErrors) {
  const Scratch scratch;
  for (const char* name : {"instrument.txt", "semicolon.csv"}) {
    int read = 0;
    testing::damage(testing::bytes_of(sample(name)), 7, 200, [&](const std::string& bytes) {
      ReadOptions options;
      options.fill = HoleFill::interpolate();
      options.size_x = options.size_y = options.unit = 1;
      read_surface(scratch.write("damaged.txt", bytes), options);
      ++read;
    });
    EXPECT_GT(read, 0) << name;
  }
}

TEST(TextMatrix, MeasuredFile) {
  if (measured("").empty()) GTEST_SKIP() << "ASPERITY_MEASURED is not set: no measured files here";
  const Surface surface = read_surface(measured("matrix-4.txt"));
  EXPECT_EQ(surface.grid().nx, 75);
  EXPECT_EQ(surface.grid().ny, 305);
  EXPECT_NEAR(surface.grid().size_x, 2.773965e-05, 1e-18);
  EXPECT_NEAR(surface.grid().size_y, 1.1280791e-04, 1e-18);
  EXPECT_NEAR(surface.height_range().min, -2.968808672e-07, 1e-16);
  EXPECT_NEAR(surface.height_range().max, 2.929150022e-07, 1e-16);
  const double average = mean(surface.heights().values());
  double square = 0;
  for (const double h : surface.heights().values()) square += (h - average) * (h - average);
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(surface.grid().nodes())), 1.174589151e-07, 1e-16);
}

}  // namespace
}  // namespace asperity::text_matrix_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/support/warnings.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/little_endian.hpp"

namespace asperity::bcr_test {
namespace {

using testing::Bytes;
using testing::message_of;

const std::string integers =
    "fileformat = bcrstm\nxpixels = 3\nypixels = 2\nxlength = 3000\nylength = 4000\nbit2nm = 0.5\nintelmode "
    "= 1\n";
const std::vector<std::int16_t> six{1, 2, 3, -4, 32767, 6};

template <class T>
std::string example(const std::string& header, const std::vector<T>& heights) {
  return Bytes().field(header, 2048).put_all(heights).bytes();
}
Surface read(const std::string& bytes, HoleFill fill = {}) {
  ReadOptions options;
  options.fill = fill;
  return read_surface(SourceFile("a.bcr", bytes), options);
}
std::string refusal(const std::string& bytes) {
  return message_of([&] { read(bytes); });
}

TEST(Bcr, IntegersAreHeightsOfTheirStep) {
  const Surface s = read(example(integers + "voidpixels = 0\n", six));
  EXPECT_EQ(s.grid(), (Grid{3, 2, 3000 * 1e-9, 4000 * 1e-9}));
  EXPECT_EQ(s.height(0, 0), -4 * (0.5 * 1e-9));
  EXPECT_EQ(s.height(1, 0), 32767 * (0.5 * 1e-9));
  EXPECT_EQ(read(example(integers + "voidpixels = 1\n", six), HoleFill::with(7)).height(1, 0), 7);
  EXPECT_EQ(read(example(integers, six), HoleFill::with(7)).height(1, 0), 7);
}

TEST(Bcr, BigEndianNumbersAreTurned) {
  std::string bytes =
      example("fileformat = bcrstm\nintelmode = 0\n" + integers.substr(20, integers.size() - 34), six);
  for (std::size_t k = 2048; k < bytes.size(); k += 2) std::swap(bytes[k], bytes[k + 1]);
  EXPECT_EQ(read(bytes, HoleFill::with(0)).height(0, 0), -4 * (0.5 * 1e-9));
}

TEST(Bcr, FloatsAreNanometres) {
  const std::string header =
      "fileformat = bcrf\n# a comment\nxpixels = 2\nypixels = 1\nxlength = 2\nxunit = um\nylength = "
      "1000\n";
  const Surface s = read(example<float>(header, {2.5F, 3e38F}), HoleFill::with(0));
  EXPECT_EQ(s.grid(), (Grid{2, 1, 2e-6, 1000 * 1e-9}));
  EXPECT_EQ(s.height(0, 0), 2.5 * 1e-9);
  EXPECT_EQ(s.height(1, 0), 0);
}

// Some programs store the missing-point number in voidpixels and heights in zunit.
TEST(Bcr, FloatsAreInTheirUnitAndVoidpixelsMayBeTheNumber) {
  const std::string header =
      "fileformat = bcrf\nxpixels = 2\nypixels = 1\nxlength = 2\nylength = 1\nzunit = um\nbit2nm = 1\n";
  EXPECT_EQ(read(example<float>(header + "voidpixels = 3.402823E+38\n", {2.5F, 3.402823E+38F})).height(0, 0),
            2.5 * 1e-6);
  EXPECT_EQ(read(example<float>(header + "voidpixels = -9999\n", {2.5F, -9999.0F})).measured(), 1U);
  EXPECT_EQ(read(example<float>(header + "voidpixels = 1\n", {1.0F, 2.0F})).measured(), 2U);
  EXPECT_NE(refusal(example<float>(header + "voidpixels = many\n", {1, 2}))
                .find("no number for `voidpixels` in its header: \"many\""),
            std::string::npos);
  EXPECT_NE(refusal(example<float>("fileformat = bcrf\nxpixels = 2\nypixels = 1\nzunit = V\n", {1, 2}))
                .find("no known unit of length as zunit: \"V\""),
            std::string::npos);
}

TEST(Bcr, AScaleOfIntegersIsPassedOverForFloatsWithAWarning) {
  test::Warnings warnings;
  const std::string header =
      "fileformat = bcrf\nxpixels = 2\nypixels = 1\nxlength = 2\nylength = 1\nbit2nm = 0.5\n";
  const Surface s = read_surface(SourceFile("a.bcr", example<float>(header, {1, 2})), {}, warnings);
  EXPECT_EQ(s.height(1, 0), 2 * 1e-9);
  EXPECT_TRUE(warnings.told("a bit2nm of \"0.5\", which is for integers only"));
}

TEST(Bcr, TheHeaderIsAsLongAsItSays) {
  const std::string header = integers + "headersize = 3000\nvoidpixels = 0\n";
  const std::string longer = Bytes().field(header, 3000).put_all(six).bytes();
  EXPECT_EQ(read(longer).height(0, 0), -4 * (0.5 * 1e-9));
  EXPECT_NE(refusal(example(integers + "headersize = 99999\n", six)).find("has 99999 characters"),
            std::string::npos);
  EXPECT_NE(refusal(example(integers + "headersize = 20\n", six)).find("has 20 characters"),
            std::string::npos);
  EXPECT_EQ(read(example(integers + "headersize = 2048\nvoidpixels = 0\n", six)).height(0, 0),
            -4 * (0.5 * 1e-9));
}

TEST(Bcr, EachFaultIsSaid) {
  EXPECT_EQ(refusal(integers), "\"a.bcr\" is cut short in its header of 2048 bytes");
  EXPECT_EQ(refusal(example(integers, std::vector<std::int16_t>{1})),
            "\"a.bcr\" says in its header that it holds 3 x 2 heights of 2 bytes but has 2 bytes of data; "
            "the file is "
            "cut short or its header is wrong");
  EXPECT_EQ(refusal(example("fileformat = bcrstm\nxpixels = 3\n", six)),
            "\"a.bcr\" has no `ypixels` in its header");
  EXPECT_EQ(refusal(example("fileformat = bcrstm\nxpixels = -3\n", six)),
            "\"a.bcr\" has no count for `xpixels` in its header: \"-3\"");
  EXPECT_EQ(refusal(example(integers + "xunit = V\n", six)),
            "\"a.bcr\" gives no known unit of length as xunit: \"V\"");
  EXPECT_EQ(refusal(example("fileformat = bcrstm_unicode\n", six)),
            "\"a.bcr\" is a BCR file of the kind \"bcrstm_unicode\"; bcrstm and bcrf are read");
  EXPECT_EQ(refusal("nothing"),
            "\"a.bcr\" lacks the mark of the format `bcr`: `fileformat = bcrstm` or bcrf at the start; if it "
            "is another format, name it with `format`");
}

// Found by fuzzing: blanks had been removed before the comparison.
TEST(Bcr, FirstLineHasTheKeyInOnePiece) {
  EXPECT_EQ(refusal(example("fileforma t= bcrstm\nxpixels = 3\nypixels = 2\n", six)),
            "\"a.bcr\" lacks the mark of the format `bcr`: `fileformat = bcrstm` or bcrf at the start; if it "
            "is another format, name it with `format`");
  EXPECT_EQ(read(example("FileFormat=bcrstm\r\n" + integers, six), HoleFill::with(0)).height(0, 1),
            0.5 * 1e-9);
}

TEST(Bcr, DamageIsAnErrorOrAnotherSurface) {
  testing::damage(example(integers, six), 71, 3000,
                  [](const std::string& bytes) { read(bytes, HoleFill::interpolate()); });
}

}  // namespace
}  // namespace asperity::bcr_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/little_endian.hpp"

namespace asperity::sdf_test {
namespace {

using testing::message_of;
using testing::SdfExample;

const std::string text_form =
    "aISO-1.0\r\nManufacID   = maker\r\nCreateDate  = 010120261200\r\nModDate     = 010120261200\r\n"
    "NumPoints   = 3\r\nNumProfiles = 2\r\nXscale      = 1.5e-6\r\nYscale      = 2.0e-6\r\nZscale      = "
    "1e-9\r\n"
    "Zresolution = -1\r\nCompression = 0\r\nDataType    = 7\r\nCheckType   = 0\r\n*\r\n";

Surface read(const std::string& bytes, HoleFill fill = {}) {
  ReadOptions options;
  options.fill = fill;
  return read_surface(SourceFile("a.sdf", bytes), options);
}
std::string refusal(const std::string& bytes) {
  return message_of([&] { read(bytes, HoleFill::with(0)); });
}

TEST(Sdf, TextIsReadWithItsScales) {
  const Surface s = read(text_form + "1 2.5 -3\r\n4\r\n5e1 6\r\n*\r\n<Operator>x</Operator>\r\n*\r\n");
  EXPECT_EQ(s.grid(), (Grid{3, 2, 3 * 1.5e-6, 2 * 2e-6}));
  EXPECT_EQ(s.height(1, 0), 2.5 * 1e-9);
  EXPECT_EQ(s.height(1, 1), 50 * 1e-9);
}

TEST(Sdf, BadPointsAreHoles) {
  const Surface s = read(text_form + "1 BAD 3 4 5 6\n*\n", HoleFill::with(7e-9));
  EXPECT_EQ(s.height(1, 0), 7e-9);
  const Surface holed = read(text_form + "1 BAD 3 4 5 6\n*\n");
  EXPECT_EQ(holed.measured(), 5U);
  EXPECT_TRUE(std::isnan(holed.height(1, 0)));
}

TEST(Sdf, OldTextsAreKnown) {
  std::string old = text_form;
  old.replace(0, 8, "aBCR-1.0");
  EXPECT_EQ(read(old + "1 2 3 4 5 6\n*\n").height(2, 1), 6 * 1e-9);
  const std::string other =
      "aNPL-V1.0\nManuFacID = Softgauges\nNumPoints = 4\nNumProfiles = 1\nXscale = 2.5E-07\nYscale = 0\n"
      "Zscale = 1E-06 ; a comment\n; another\nDataType = 7\n*\n-0.5\n1\n2\n3\n*\n*\n";
  const Profile p = read_profile(SourceFile("a.txt", other));
  EXPECT_EQ(p.size(), 4);
  EXPECT_EQ(p.spacing(), 2.5e-7);
  EXPECT_EQ(p.heights()[0], -0.5 * 1e-6);
}

template <class T>
void expect_type(std::uint8_t type, T missing) {
  SdfExample example;
  example.type = type;
  const Surface s = read(example(std::vector<T>{1, 2, 3, 100, missing, 6}), HoleFill::with(9));
  EXPECT_EQ(s.grid(), (Grid{3, 2, 3e-6, 4e-6}));
  EXPECT_EQ(s.height(0, 1), 100 * 1e-9);
  EXPECT_EQ(s.height(1, 1), 9) << int{type};
}

TEST(Sdf, EveryTypeOfNumberIsRead) {
  expect_type<std::uint16_t>(1, 65535);
  expect_type<std::uint32_t>(2, 4294967295U);
  expect_type<float>(3, std::numeric_limits<float>::quiet_NaN());
  expect_type<std::int16_t>(5, -32768);
  expect_type<std::int32_t>(6, std::numeric_limits<std::int32_t>::min());
  expect_type<double>(7, std::numeric_limits<double>::quiet_NaN());
  SdfExample bytes{.version = "bBCR-1.0"};
  bytes.type = 0;
  EXPECT_EQ(read(bytes(std::vector<std::uint8_t>{0, 255, 3, 4, 5, 6})).height(1, 0), 255 * 1e-9);
  bytes.type = 4;
  EXPECT_EQ(read(bytes(std::vector<std::int8_t>{0, -128, 3, 4, 5, 6})).height(1, 0), -128 * 1e-9);
}

TEST(Sdf, RecognisedByContentWhateverItsName) {
  const std::string bytes = SdfExample()(std::vector<double>{1, 2, 3, 4, 5, 6});
  EXPECT_EQ(read_surface(SourceFile("measured.dat", bytes)).height(0, 0), 1e-9);
}

TEST(Sdf, EachFaultIsSaid) {
  const std::vector<double> six{1, 2, 3, 4, 5, 6};
  EXPECT_EQ(refusal(SdfExample{.points = 4}(six)),
            "\"a.sdf\" says in its header that it holds 4 x 2 heights of 8 bytes but has 48 bytes of data; "
            "the file is "
            "cut short or its header is wrong");
  EXPECT_EQ(refusal(SdfExample{.points = 0}(six)),
            "\"a.sdf\" says in its header that it holds 0 x 2 heights; its header is wrong");
  EXPECT_EQ(refusal(SdfExample{.z_scale = 0}(six)), "\"a.sdf\" gives 0 as its Zscale");
  EXPECT_EQ(refusal(SdfExample{.x_scale = -1}(six)), "\"a.sdf\" gives -1 as the distance of its points");
  EXPECT_EQ(refusal(SdfExample{.compression = 1}(six)),
            "\"a.sdf\" is a compressed SDF file; save it again without compression");
  EXPECT_EQ(refusal(SdfExample{.type = 8}(six)), "\"a.sdf\" has the DataType 8; types 0 to 7 are read");
  EXPECT_EQ(refusal(std::string("bISO-1.0 short")), "\"a.sdf\" is cut short in its header of 81 bytes");
  EXPECT_EQ(refusal("nothing of it"),
            "\"a.sdf\" lacks the mark of the format `sdf`: aISO-1.0, bISO-1.0 or BCR at the start; if it is "
            "another format, name it with `format`");
  EXPECT_EQ(refusal(text_form + "1 2 3 4 5\n"),
            "\"a.sdf\" has 5 of the 6 heights of its header; the file is cut short or its header is wrong");
  EXPECT_EQ(refusal(text_form + "1 2 3 4 5 6 7\n*\n"),
            "\"a.sdf\" has more heights than the 6 of its header; the header is wrong");
  EXPECT_EQ(refusal(text_form + "1 2 x 4 5 6\n*\n"), "\"a.sdf\" has no height in line 15: \"x\"");
  EXPECT_EQ(refusal(text_form.substr(0, 200)),
            "\"a.sdf\" has no line * after its header; the file is cut short");
  EXPECT_EQ(refusal("aISO-1.0\nNumPoints = 3\n*\n"), "\"a.sdf\" has no `numprofiles` in its header");
  EXPECT_EQ(refusal("aISO-1.0\nNumPoints = -3\n*\n"),
            "\"a.sdf\" has no count for `numpoints` in its header: \"-3\"");
  EXPECT_EQ(refusal("aISO-1.0\nNumPoints = 3\nNumProfiles = 2\nXscale = um\n*\n"),
            "\"a.sdf\" has no number for `xscale` in its header: \"um\"");
}

TEST(Sdf, MeasuredFile) {
  const std::string path = testing::measured("sdf-1.sdf");
  if (path.empty()) GTEST_SKIP() << "ASPERITY_MEASURED is not set: no measured files here";
  const Surface s = read_surface(path);
  EXPECT_EQ(s.grid(), (Grid{7, 4, 7e-6, 4e-6}));
  EXPECT_NEAR(mean(s.heights().values()), 0.9835632143e-6, 1e-16);
  EXPECT_EQ(s.height_range().min, 0.94907 * 1e-6);
  EXPECT_EQ(s.height_range().max, 1e-6);
}

TEST(Sdf, DamageIsAnErrorOrAnotherSurface) {
  testing::damage(SdfExample()(std::vector<double>{1, 2, 3, 4, 5, 6}), 21, 4000,
                  [](const std::string& bytes) { read(bytes, HoleFill::interpolate()); });
  testing::damage(text_form + "1 BAD 3 4 5 6\n*\n", 22, 4000,
                  [](const std::string& bytes) { read(bytes, HoleFill::interpolate()); });
}

}  // namespace
}  // namespace asperity::sdf_test

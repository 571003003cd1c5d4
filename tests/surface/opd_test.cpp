// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/little_endian.hpp"

namespace asperity::opd_test {
namespace {

using testing::message_of;
using testing::opd_example;
using testing::opd_map;
using testing::opd_number;
using testing::OpdBlock;

// Order: (0, 0), (0, 1), (1, 0), ...
const OpdBlock floats = opd_map<float>("RAW_DATA", 3, 2, {1, 2, 3, 4, 5, 6});
const OpdBlock wavelength = opd_number("Wavelength", 500), pixel = opd_number("Pixel_size", 0.25F);

Surface read(const std::string& bytes, HoleFill fill = {}, const std::string& channel = {}) {
  ReadOptions options;
  options.fill = fill;
  options.channel = channel;
  return read_surface(SourceFile("a.opd", bytes), options);
}
std::string refusal(const std::vector<OpdBlock>& blocks) {
  return message_of([&] { read(opd_example(blocks)); });
}

TEST(Opd, FloatsAreWavelengthsColumnByColumn) {
  const Surface s =
      read(opd_example({wavelength, floats, {"Title", 5, "abc"}, pixel, opd_number("Aspect", 2)}));
  EXPECT_EQ(s.grid(), (Grid{3, 2, 0.25e-3 * 3, 0.25e-3 * 2 * 2}));
  EXPECT_EQ(s.height(0, 1), 2 * (500 * 1e-9));
  EXPECT_EQ(s.height(2, 0), 5 * (500 * 1e-9));
}

TEST(Opd, IntegersArePartsOfAWavelength) {
  const OpdBlock mult{"Mult", 6, testing::Bytes().put(std::int16_t{1000}).bytes()};
  const OpdBlock map = opd_map<std::int16_t>("RAW DATA", 3, 2, {1, 32767, -32768, -4, 32766, 32765});
  const Surface s = read(opd_example({map, wavelength, pixel, mult}), HoleFill::with(9));
  EXPECT_EQ(s.height(0, 0), 500 * 1e-9 / 1000);
  EXPECT_EQ(s.height(0, 1), 9);
  EXPECT_EQ(s.height(1, 0), 9);
  EXPECT_EQ(s.height(1, 1), -4 * (500 * 1e-9 / 1000));
  EXPECT_EQ(s.height(2, 0), 9);
  EXPECT_EQ(s.height(2, 1), 32765 * (500 * 1e-9 / 1000));
}

TEST(Opd, BadFloatsAreHoles) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const OpdBlock map = opd_map<float>("RAW_DATA", 3, 2, {1e38F, 3e38F, nan, 4, 9e37F, 6});
  const std::string bytes = opd_example({map, wavelength, pixel});
  const Surface s = read(bytes, HoleFill::with(0));
  EXPECT_EQ(s.height(0, 0), 0);
  EXPECT_EQ(s.height(0, 1), 0);
  EXPECT_EQ(s.height(1, 0), 0);
  EXPECT_GT(s.height(2, 0), 1e30);
}

TEST(Opd, ChannelNamesTheMap) {
  const OpdBlock other = opd_map<float>("Image", 1, 1, {7});
  const std::string bytes = opd_example({other, floats, wavelength, pixel});
  EXPECT_EQ(read(bytes).grid().nx, 3);
  EXPECT_EQ(read(bytes, {}, "Image").grid().nx, 1);
  EXPECT_EQ(message_of([&] { read(bytes, {}, "Title"); }),
            "\"a.opd\" holds no map `Title` but `Image` and `RAW_DATA`; name one of them with `channel`");
}

TEST(Opd, WhatTheFileDoesNotSayIsAskedFor) {
  EXPECT_EQ(refusal({floats}),
            "\"a.opd\" does not say its size and unit; give `size` and `unit` in the call: `unit` is the "
            "length of one "
            "number, such as \"um\"");
}

TEST(Opd, EachFaultIsSaid) {
  EXPECT_EQ(refusal({wavelength, pixel}), "\"a.opd\" holds no map");
  EXPECT_EQ(refusal({opd_map<float>("RAW_DATA", 3, 3, {1, 2, 3, 4, 5, 6})}),
            "\"a.opd\" says in its header that it holds 3 x 3 heights of 4 bytes but has 24 bytes of data; "
            "the file is "
            "cut short or its header is wrong");
  EXPECT_EQ(
      refusal({opd_map<double>("RAW_DATA", 1, 1, {1})}),
      "\"a.opd\" holds heights of 8 bytes; integers of 2 bytes and floating-point numbers of 4 are read");
  EXPECT_EQ(refusal({floats, opd_number("Wavelength", 0)}), "\"a.opd\" gives 0 as its Wavelength");
  EXPECT_EQ(refusal({floats, {"Wavelength", 5, "red"}}),
            "\"a.opd\" has a block Wavelength of type 5, which is no number");
  EXPECT_EQ(refusal({floats, {"Wavelength", 7, "re"}}), "\"a.opd\" is cut short in its block Wavelength");
  const std::string whole = opd_example({floats, wavelength, pixel});
  EXPECT_EQ(message_of([&] { read(whole.substr(0, whole.size() - 1)); }),
            "\"a.opd\" has the block \"Pixel_size\" past its end; the file is cut short");
  EXPECT_EQ(message_of([&] { read(whole.substr(0, 40)); }), "\"a.opd\" is cut short in its directory");
  EXPECT_EQ(message_of([&] { read("nothing"); }),
            "\"a.opd\" lacks the mark of the format `opd`: a directory of blocks; if it is another format, "
            "name it with `format`");
}

TEST(Opd, DamageIsAnErrorOrAnotherSurface) {
  testing::damage(opd_example({floats, wavelength, pixel}), 41, 4000,
                  [](const std::string& bytes) { read(bytes, HoleFill::interpolate()); });
}

}  // namespace
}  // namespace asperity::opd_test

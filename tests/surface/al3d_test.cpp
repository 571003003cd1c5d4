// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/optical_files.hpp"

namespace asperity::al3d_test {
namespace {

using testing::Al3dExample;
using testing::message_of;

const std::vector<std::vector<float>> eight{{1e-6F, 2e-6F, 3e-6F, 4e-6F}, {5e-6F, 3e15F, 7e-6F, NAN}};

Surface read(const std::string& bytes, HoleFill fill = {}) {
  ReadOptions options;
  options.fill = fill;
  return read_surface(SourceFile("a", bytes), options);
}
Al3dExample with(const std::string& name, const std::string& value) {
  Al3dExample example;
  for (auto& [tag, text] : example.tags)
    if (tag == name) text = value;
  return example;
}
std::string refusal(const Al3dExample& example) {
  return message_of([&] { read(example(eight)); });
}

TEST(Al3d, HeightsAreMetresLineByLine) {
  const Surface s = read(Al3dExample{}(eight));
  EXPECT_EQ(s.grid(), (Grid{4, 2, 4e-6, 4e-6}));
  EXPECT_EQ(s.height(1, 1), static_cast<double>(2e-6F));
  EXPECT_EQ(s.height(0, 0), static_cast<double>(5e-6F));
  EXPECT_TRUE(std::isnan(s.height(1, 0)));  // rounded in the text
  EXPECT_TRUE(std::isnan(s.height(3, 0)));
  EXPECT_EQ(s.measured(), 6U);
}

TEST(Al3d, AnInvalidNumberThatIsNanLeavesTheOthers) {
  const Surface s = read(with("InvalidPixelValue", "nan")({{1, 2, 3, 4}, {5, NAN, 7, 0}}));
  EXPECT_EQ(s.measured(), 7U);
  EXPECT_EQ(s.height(3, 0), 0);
  EXPECT_EQ(read(with("InvalidPixelValue", "0")({{1, 2, 3, 4}, {5, 6, 7, 0}})).measured(), 7U);
}

TEST(Al3d, LinesOfOddLengthArePadded) {
  Al3dExample three = with("Cols", "3");
  const std::vector<std::vector<float>> six{{1, 2, 3}, {4, 5, 6}};
  three.pad = 4;
  EXPECT_EQ(read(three(six)).height(0, 0), 4);
  three.pad = 0;  // no padding
  EXPECT_EQ(read(three(six)).height(0, 0), 4);
  three.pad = 4;
  three.after = "a picture";
  EXPECT_EQ(read(three(six)).height(2, 0), 6);
}

TEST(Al3d, EachFaultIsSaid) {
  EXPECT_NE(refusal(with("Cols", "5")).find("5 x 2 heights of 4 bytes but has 32 bytes"), std::string::npos);
  EXPECT_EQ(refusal(with("Cols", "4.5")), "\"a\" has no count for `Cols` in its header: \"4.5\"");
  EXPECT_NE(refusal(with("Cols", "99999999999")).find("heights"), std::string::npos);
  EXPECT_EQ(refusal(with("PixelSizeXMeter", "0")), "\"a\" gives 0 m as the distance of its points");
  EXPECT_EQ(refusal(with("PixelSizeYMeter", "wide")),
            "\"a\" has no number for `PixelSizeYMeter` in its header: \"wide\"");
  Al3dExample bare;
  bare.tags = {{"Cols", "4"}, {"Rows", "2"}};
  EXPECT_EQ(refusal(bare), "\"a\" has no `PixelSizeXMeter` in its header");
  bare.tags = {{"Cols", "4"}, {"Rows", "2"}, {"DepthImageOffset", "99999"}};
  EXPECT_NE(refusal(bare).find("has its heights at byte 99999, past its end"), std::string::npos);
  bare.tags[2].second = "0";
  EXPECT_EQ(refusal(bare), "\"a\" holds no heights: its DepthImageOffset is 0");
  EXPECT_EQ(message_of([] { read(Al3dExample{}(eight).substr(0, 100)); }), "\"a\" is cut short in its tags");
}

TEST(Al3d, DamageIsAnErrorOrAnotherSurface) {
  testing::damage(Al3dExample{}(eight), 53, 3000,
                  [](const std::string& bytes) { read(bytes, HoleFill::interpolate()); });
}

}  // namespace
}  // namespace asperity::al3d_test

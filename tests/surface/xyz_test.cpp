// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"

namespace asperity {
namespace {

using testing::measured;
using testing::message_of;
using testing::sample;
using testing::Scratch;

ReadOptions in_micrometres() {
  ReadOptions options;
  options.unit = 1e-6;
  return options;
}

TEST(Xyz, GridInAnyOrder) {
  const Surface surface = read_surface(sample("points.xyz"), in_micrometres());
  EXPECT_EQ(surface.grid().nx, 4);
  EXPECT_EQ(surface.grid().ny, 3);
  EXPECT_DOUBLE_EQ(surface.grid().size_x, 2e-6);
  EXPECT_DOUBLE_EQ(surface.grid().size_y, 0.75e-6);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(surface.height(i, j), (i + 10 * j) * 1e-6);
}

TEST(Xyz, LineOfNamesAndRoundedCoordinates) {
  const Scratch scratch;
  const Surface surface = read_surface(
      scratch.write("named.csv",
                    "x [um],y [um],z [um]\n0,0,1\n0.33,0,2\n0.67,0,3\n0,1,4\n0.33,1,5\n0.67,1,6\n"),
      in_micrometres());
  EXPECT_EQ(surface.grid().nx, 3);
  EXPECT_DOUBLE_EQ(surface.height(2, 1), 6e-6);
}

TEST(Xyz, UnitIsNeededAndCoversAllThree) {
  EXPECT_NE(message_of([] { read_surface(sample("points.xyz")); }).find("does not say its unit"),
            std::string::npos);
}

TEST(Xyz, MissingPointIsAHole) {
  const Scratch scratch;
  std::string text;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i)
      if (i != 3 || j != 2)
        text += std::to_string(i) + " " + std::to_string(j) + " " + std::to_string(i) + "\n";
  const std::string path = scratch.write("hole.dat", text);
  EXPECT_NE(message_of([&] {
              read_surface(path, in_micrometres());
            }).find("1 missing height of 25, the first at node (3, 2)"),
            std::string::npos);
  ReadOptions options = in_micrometres();
  options.fill = HoleFill::interpolate();
  EXPECT_NEAR(read_surface(path, options).height(3, 2), 3e-6, 1e-17);
}

TEST(Xyz, WhatIsNoGrid) {
  const Scratch scratch;
  const auto refusal = [&](const std::string& text) {
    ReadOptions options = in_micrometres();
    options.format = "xyz";
    return message_of([&] { read_surface(scratch.write("no.xyz", text), options); });
  };
  EXPECT_NE(refusal("0 0 1\n1 0 2\n0 1 3\n1 1 4\n1 1 4\n").find("gives the point x = 1, y = 1 twice"),
            std::string::npos);
  EXPECT_NE(refusal("0 0 1\n1 0 2\n3 0 3\n0 1 3\n").find("values of x are not evenly spaced"),
            std::string::npos);
  EXPECT_NE(refusal("0 0\n1 0\n").find("has 2 numbers a line"), std::string::npos);
  EXPECT_NE(refusal("0 0 1\n0 1 2\n").find("only one value of x"), std::string::npos);
  EXPECT_NE(refusal("0 nan 1\n0 1 2\n").find("a point without x or y"), std::string::npos);
  std::string scattered;
  for (int k = 0; k < 300; ++k) scattered += std::to_string(k) + " " + std::to_string(k * 7 % 300) + " 1\n";
  EXPECT_NE(refusal(scattered).find("300 points for 300 x 300 places"), std::string::npos);
}

TEST(Xyz, ThreeColumnsOfHeightsAreAMatrix) {
  const Scratch scratch;
  ReadOptions options = in_micrometres();
  options.size_x = options.size_y = 1e-3;
  const Surface surface =
      read_surface(scratch.write("narrow.txt", "5 1 2\n3 9 4\n8 2 7\n6 4 4\n0 0 1\n"), options);
  EXPECT_EQ(surface.grid().nx, 3);
  EXPECT_EQ(surface.grid().ny, 5);
}

TEST(Xyz, DamagedBytesGiveErrors) {
  const Scratch scratch;
  int read = 0;
  testing::damage(testing::bytes_of(sample("points.xyz")), 3, 200, [&](const std::string& bytes) {
    ReadOptions options = in_micrometres();
    options.fill = HoleFill::interpolate();
    options.format = "xyz";
    read_surface(scratch.write("damaged.xyz", bytes), options);
    ++read;
  });
  EXPECT_GT(read, 0);
}

TEST(Xyz, MeasuredFile) {
  if (measured("").empty()) GTEST_SKIP() << "ASPERITY_MEASURED is not set: no measured files here";
  const Surface surface = read_surface(measured("xyz-1.txt"), in_micrometres());
  EXPECT_EQ(surface.grid().nx, 4);
  EXPECT_EQ(surface.grid().ny, 4);
  EXPECT_DOUBLE_EQ(surface.grid().size_x, 4e-6);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      EXPECT_DOUBLE_EQ(surface.height(i, j), (i == 1 && (j == 1 || j == 2)) ? 2e-6 : 1e-6);
}

}  // namespace
}  // namespace asperity

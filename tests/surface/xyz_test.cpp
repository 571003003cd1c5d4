// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>

#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"

namespace asperity::xyz_test {
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

ReadOptions points_in_micrometres() {
  ReadOptions options = in_micrometres();
  options.unit_xy = 1e-6;
  return options;
}

TEST(Xyz, GridInAnyOrder) {
  const Surface surface = read_surface(sample("points.xyz"), points_in_micrometres());
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

TEST(Xyz, UnitsOfHeightsAndOfPositionsAreNeeded) {
  EXPECT_NE(message_of([] {
              read_surface(sample("points.xyz"));
            }).find("does not say its unit and the unit of its positions"),
            std::string::npos);
  EXPECT_NE(message_of([] {
              read_surface(sample("points.xyz"), in_micrometres());
            }).find("does not say the unit of its positions; give `unit_xy` in the call"),
            std::string::npos);
  ReadOptions options = points_in_micrometres();
  options.unit_xy = 1e-3;
  const Surface wide = read_surface(sample("points.xyz"), options);
  EXPECT_DOUBLE_EQ(wide.grid().size_x, 2e-3);
  EXPECT_DOUBLE_EQ(wide.height(3, 0), 3e-6);
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
              read_surface(path, points_in_micrometres());
            }).find("1 missing height of 25, the first at node (3, 2)"),
            std::string::npos);
  ReadOptions options = points_in_micrometres();
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

TEST(Xyz, ScatteredPointsAreNoMapOfThreeColumns) {
  const Scratch scratch;
  std::string text;
  for (int k = 0; k < 150; ++k)
    text += std::to_string(std::sin(k)) + " " + std::to_string(std::cos(1.7 * k)) + " 0.5\n";
  ReadOptions options = in_micrometres();
  options.size_x = options.size_y = 1e-3;
  const auto answer = [&](const std::string& name) {
    return message_of([&] { read_surface(scratch.write(name, text), options); });
  };
  EXPECT_NE(answer("cloud.xyz").find("is not on a regular grid"), std::string::npos) << answer("cloud.xyz");
  EXPECT_NE(answer("cloud.txt").find("three columns and a hundred lines or more"), std::string::npos);
  options.format = "text";
  EXPECT_EQ(read_surface(scratch.write("map.txt", text), options).grid().nx, 3);
}

// A lattice of nx x ny points whose point k is given copies(k) times.
template <class Copies>
std::string lattice(int nx, int ny, Copies&& copies) {
  std::string text;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      for (int copy = 0; copy < copies(j * nx + i); ++copy)
        text += std::to_string(i) + " " + std::to_string(0.5 * j) + " 0." + std::to_string(i * j % 10) + "\n";
  return text;
}

TEST(Xyz, AlmostALatticeHasToBeNamed) {
  const Scratch scratch;
  const auto answer = [&](const std::string& text, const std::string& format) {
    ReadOptions options = in_micrometres();
    options.size_x = options.size_y = 1e-3;
    options.fill = HoleFill::interpolate();
    options.format = format;
    return message_of([&] { read_surface(scratch.write("points.txt", text), options); });
  };
  const auto ambiguous = [&](const std::string& text) {
    const std::string message = answer(text, "");
    return message.find("almost all points of a") != std::string::npos &&
           message.find("`format` = \"xyz\"") != std::string::npos &&
           message.find("`format` = \"text\"") != std::string::npos;
  };
  const std::string few = lattice(3, 3, [](int k) { return k == 4 ? 0 : 1; });
  EXPECT_TRUE(ambiguous(few)) << answer(few, "");
  const std::string twice = lattice(6, 5, [](int k) { return k == 7 ? 2 : 1; });
  EXPECT_TRUE(ambiguous(twice)) << answer(twice, "");
  const std::string one_less_one_more = lattice(6, 5, [](int k) { return k == 7 ? 2 : k == 9 ? 0 : 1; });
  EXPECT_TRUE(ambiguous(one_less_one_more)) << answer(one_less_one_more, "");
  const std::string all_twice = lattice(6, 5, [](int) { return 2; });
  EXPECT_TRUE(ambiguous(all_twice)) << answer(all_twice, "");
  const std::string column_less = lattice(7, 5, [](int k) { return k % 7 == 3 ? 0 : 1; });
  EXPECT_TRUE(ambiguous(column_less)) << answer(column_less, "");
  for (const std::string& text : {few, twice, one_less_one_more, all_twice, column_less})
    EXPECT_EQ(answer(text, "text"), "no error");
  EXPECT_EQ(answer(few, "xyz"), "no error");
  EXPECT_NE(answer(twice, "xyz").find("gives the point x = 1, y = 0.5 twice"), std::string::npos);
  EXPECT_TRUE(ambiguous("# made by hand\n" + few));
  // What says that it is a matrix is one.
  EXPECT_EQ(answer("# Channel: Height\n# Width: 3 um\n# Height: 8 um\n" + few, ""), "no error");
  EXPECT_EQ(answer("h=8 w=3\npixel size=1e-6\n" + few, ""), "no error");
}

// Heights of an instrument with few steps, drawn independently or along a smooth surface.
TEST(Xyz, MatricesOfFewDistinctHeightsStayMatrices) {
  const Scratch scratch;
  ReadOptions options = in_micrometres();
  options.size_x = options.size_y = 1e-3;
  const Stream stream(9, "matrix");
  for (const int steps : {4, 10, 31}) {
    for (const double load : {0.75, 1.0, 1.5, 1.9}) {
      const int rows = static_cast<int>(load * steps * steps) + 8;
      std::string drawn, smooth;
      for (int j = 0; j < rows; ++j)
        for (int i = 0; i < 3; ++i) {
          const auto key = static_cast<std::uint64_t>(steps * 10000 + j * 3 + i);
          drawn +=
              std::to_string(stream.below(key, static_cast<std::uint64_t>(steps))) + (i < 2 ? " " : "\n");
          smooth += std::to_string(static_cast<int>(steps * (0.5 + 0.49 * std::sin(0.05 * j + 0.3 * i)))) +
                    (i < 2 ? " " : "\n");
        }
      for (const std::string& text : {drawn, smooth}) {
        const std::string path = scratch.write("steps.txt", text);
        EXPECT_EQ(message_of([&] { EXPECT_EQ(read_surface(path, options).grid().ny, rows); }), "no error")
            << steps << ", " << load;
      }
    }
  }
}

TEST(Xyz, DamagedBytesGiveErrors) {
  const Scratch scratch;
  int read = 0;
  testing::damage(testing::bytes_of(sample("points.xyz")), 3, 200, [&](const std::string& bytes) {
    ReadOptions options = points_in_micrometres();
    options.fill = HoleFill::interpolate();
    options.format = "xyz";
    read_surface(scratch.write("damaged.xyz", bytes), options);
    ++read;
  });
  EXPECT_GT(read, 0);
}

TEST(Xyz, MeasuredFile) {
  if (measured("").empty()) GTEST_SKIP() << "ASPERITY_MEASURED is not set: no measured files here";
  const Surface surface = read_surface(measured("xyz-1.txt"), points_in_micrometres());
  EXPECT_EQ(surface.grid().nx, 4);
  EXPECT_EQ(surface.grid().ny, 4);
  EXPECT_DOUBLE_EQ(surface.grid().size_x, 4e-6);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      EXPECT_DOUBLE_EQ(surface.height(i, j), (i == 1 && (j == 1 || j == 2)) ? 2e-6 : 1e-6);
}

}  // namespace
}  // namespace asperity::xyz_test

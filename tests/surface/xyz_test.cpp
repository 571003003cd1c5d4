// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "engine/core/files/source_file.hpp"
#include "engine/core/text.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/support/warnings.hpp"
#include "tests/surface/files.hpp"

namespace asperity::xyz_test {
namespace {

using testing::measured;
using testing::message_of;
using testing::sample;
using testing::Scratch;

ReadOptions in_micrometres() {
  ReadOptions options;
  options.unit = options.unit_xy = 1e-6;
  return options;
}
ReadOptions heights_in_micrometres() {
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
  const Surface surface = read_surface(scratch.write(
      "named.csv", "x [um],y [um],z [um]\n0,0,1\n0.33,0,2\n0.67,0,3\n0,1,4\n0.33,1,5\n0.67,1,6\n"));
  EXPECT_EQ(surface.grid().nx, 3);
  EXPECT_DOUBLE_EQ(surface.height(2, 1), 6e-6);
}

// No unit is guessed: um over mm is common.
TEST(Xyz, UnitsOfHeightsAndOfPositionsAreAskedForApart) {
  const std::string file = "\"" + sample("points.xyz") + "\" does not say ";
  EXPECT_EQ(
      message_of([] { read_surface(sample("points.xyz")); }),
      file +
          "its unit and the unit of its positions; give `unit` and `unit_xy` in the call: `unit` is the "
          "length of one number, such as \"um\", `unit_xy` that of a position, which may be another");
  ReadOptions options;
  options.unit = 1e-6;
  EXPECT_EQ(message_of([&] { read_surface(sample("points.xyz"), options); }),
            file +
                "the unit of its positions; give `unit_xy` in the call: the length of one number of a "
                "position, such as \"mm\"");
  options.unit_xy = 1e-3;
  EXPECT_DOUBLE_EQ(read_surface(sample("points.xyz"), options).grid().size_x, 2e-3);
  EXPECT_DOUBLE_EQ(read_surface(sample("points.xyz"), options).height(3, 2), 23e-6);
}

TEST(Xyz, ASizeOfTheCallIsNoContradiction) {
  test::Warnings warnings;
  ReadOptions options;
  options.unit = 1e-6;
  options.size_x = 4e-4;
  options.size_y = 3e-4;
  EXPECT_EQ(read_surface(sample("points.xyz"), options, warnings).grid().size_x, 4e-4);
  EXPECT_TRUE(warnings.all.empty());
}

TEST(Xyz, MissingPointIsAHole) {
  const Scratch scratch;
  std::string text;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 5; ++i)
      if (i != 3 || j != 2)
        text += std::to_string(i) + " " + std::to_string(j) + " " + std::to_string(i) + "\n";
  const std::string path = scratch.write("hole.dat", text);
  const Surface holed = read_surface(path, in_micrometres());
  EXPECT_EQ(holed.measured(), 24U);
  EXPECT_TRUE(std::isnan(holed.height(3, 2)));
  ReadOptions options = in_micrometres();
  options.fill = HoleFill::interpolate();
  EXPECT_NEAR(read_surface(path, options).height(3, 2), 3e-6, 1e-17);
}

// A truncated file may end within a line.
TEST(Xyz, LinesThatEndTooSoonAreWarnedOf) {
  // 4 x 4 points, lines along x or y, from either end.
  const auto told = [](bool along_x, bool turned, int first_missing, int last_missing) {
    std::string text;
    for (int k = 0; k < 16; ++k) {
      const int fast = turned ? 3 - k % 4 : k % 4, slow = turned ? 3 - k / 4 : k / 4;
      if (k >= first_missing && k <= last_missing) continue;
      text += std::to_string(along_x ? fast : slow) + " " + std::to_string(along_x ? slow : fast) + " 1\n";
    }
    ReadOptions options = in_micrometres();
    options.format = "xyz";
    test::Warnings warnings;
    const Surface found = read_surface(SourceFile("a.xyz", text), options, warnings);
    EXPECT_EQ(found.measured(), static_cast<std::size_t>(16 - (last_missing - first_missing + 1)));
    return warnings.told("ends within a line of points: the last " +
                         std::to_string(last_missing - first_missing + 1) + " are missing");
  };
  for (const bool along_x : {true, false})
    for (const bool turned : {true, false}) {
      EXPECT_TRUE(told(along_x, turned, 13, 15));
      EXPECT_TRUE(told(along_x, turned, 15, 15));
      EXPECT_FALSE(told(along_x, turned, 14, 14));
      EXPECT_FALSE(told(along_x, turned, 5, 6));
    }
}

struct NamedUnit {
  const char* name;
  double metres;
};
constexpr NamedUnit units_of_heads[] = {{"nm", 1e-9}, {"um", 1e-6}, {"mm", 1e-3}, {"m", 1}};

// 3 x 2 points 0.1 apart.
TEST(Xyz, EveryTableOfUnitsIsTheSameSurface) {
  const std::vector<double> x{0, 1e-4, 2e-4}, y{0, 1e-4};
  const std::vector<double> z{1.2e-6, 1.5e-6, 1.1e-6, 0.9e-6, 2.0e-6, 1.7e-6};
  int tables = 0;
  for (const NamedUnit& of_x : units_of_heads)
    for (const NamedUnit& of_z : units_of_heads)
      for (const auto& [open, close] : {std::pair{" [", "]"}, std::pair{" (", ")"}, std::pair{"/", ""}})
        for (const std::string separator : {";", ",", "\t"}) {
          const auto title = [&, o = open, c = close](const char* name, const NamedUnit& unit) {
            return std::string(name) + o + unit.name + c;
          };
          std::string text =
              title("x", of_x) + separator + title("y", of_x) + separator + title("z", of_z) + "\n";
          for (std::size_t k = 0; k < z.size(); ++k) {
            std::string line = format_exact(x[k % 3] / of_x.metres) + separator +
                               format_exact(y[k / 3] / of_x.metres) + separator +
                               format_exact(z[k] / of_z.metres);
            if (separator == ";") std::replace(line.begin(), line.end(), '.', ',');
            text += line + "\n";
          }
          const Surface surface = read_surface(SourceFile("own.csv", text));
          ASSERT_EQ(surface.grid().nx, 3) << text;
          ASSERT_EQ(surface.grid().ny, 2) << text;
          EXPECT_NEAR(surface.grid().size_x, 3e-4, 1e-15) << text;
          EXPECT_NEAR(surface.grid().size_y, 2e-4, 1e-15) << text;
          for (int k = 0; k < 6; ++k)
            EXPECT_NEAR(surface.height(k % 3, k / 3), z[static_cast<std::size_t>(k)], 1e-20) << text;
          ++tables;
        }
  EXPECT_EQ(tables, 4 * 4 * 3 * 3);
}

TEST(Xyz, HeadsOfOtherForms) {
  const std::string points = "0 0 1\n0.1 0 2\n0 0.1 3\n0.1 0.1 4\n";
  for (const char* head :
       {"x [mm] y [mm] z [um]\n", "X (mm) Y (mm) Z (um)\n", "x/mm y/mm z/um\n", "x / mm y / mm z / um\n",
        "# x [mm] y [mm] z [um]\n", "% by hand\n# X [mm], Y [mm], Z [\xC2\xB5m]\n", "x_mm;y_mm;z_um\n",
        "\"x [mm]\";\"y [mm]\";\"z [um]\"\n", "x mm;y mm;z um;\n",
        "\xEF\xBB\xBFx axis [mm],y axis [mm],z [micron]\n"}) {
    const Surface surface = read_surface(SourceFile("own.txt", head + points));
    EXPECT_DOUBLE_EQ(surface.grid().size_x, 2e-4) << head;
    EXPECT_DOUBLE_EQ(surface.height(1, 1), 4e-6) << head;
  }
  const Surface oblong = read_surface(SourceFile("own.txt", "x [mm];y [um];z [nm]\n" + points));
  EXPECT_DOUBLE_EQ(oblong.grid().size_x, 2e-4);
  EXPECT_DOUBLE_EQ(oblong.grid().size_y, 2e-7);
  // Column names resolve the ambiguity.
  EXPECT_EQ(
      read_surface(SourceFile("own.txt", "x [mm] y [mm] z [um]\n0 0 1\n1 0 2\n0 1 3\n1 1 4\n2 0 1\n2 1 2\n"))
          .grid()
          .nx,
      3);
}

TEST(Xyz, HeadAndCallAgreeOrAreRefused) {
  const std::string text = "x [mm];y [mm];z [um]\n0;0;1,2\n0,1;0;1,5\n0;0,1;0,9\n0,1;0,1;2,0\n";
  ReadOptions options;
  options.unit = 1e-6;
  options.unit_xy = 1e-3;
  EXPECT_DOUBLE_EQ(read_surface(SourceFile("own.csv", text), options).height(0, 0), 1.2e-6);
  options.unit = 1e-9;
  EXPECT_EQ(message_of([&] { read_surface(SourceFile("own.csv", text), options); }),
            "\"own.csv\" names its columns with heights in units of 1 um, and "
            "`unit` is 1 nm; leave `unit` out, or correct that line");
  options.unit.reset();
  options.unit_xy = 1e-6;
  EXPECT_NE(message_of([&] {
              read_surface(SourceFile("own.csv", text), options);
            }).find("positions in units of 1 mm, and `unit_xy` is 1 um"),
            std::string::npos);
  const std::string half = "x,y,z [um]\n0,0,1\n1,0,2\n0,1,3\n1,1,4\n";
  EXPECT_NE(message_of([&] {
              read_surface(SourceFile("own.csv", half));
            }).find("does not say the unit of its positions"),
            std::string::npos);
  EXPECT_DOUBLE_EQ(read_surface(SourceFile("own.csv", half), options).grid().size_x, 2e-6);
  EXPECT_NE(message_of([&] {
              read_surface(SourceFile("own.csv", "x [mm],y,z [um]\n0,0,1\n1,0,2\n0,1,3\n1,1,4\n"));
            }).find("gives a unit of x and none of y"),
            std::string::npos);
  test::Warnings warnings;
  options.unit = 1e-6;
  read_surface(SourceFile("own.csv", "x [px],y [px],z [V]\n0,0,1\n1,0,2\n0,1,3\n1,1,4\n"), options, warnings);
  ASSERT_EQ(warnings.all.size(), 3U);
  EXPECT_NE(warnings.all[0].find("gives its \"x\" in \"px\", which is no unit of length"), std::string::npos);
}

TEST(Xyz, UnitOfPositionsIsRefusedWhereThereAreNone) {
  ReadOptions options = in_micrometres();
  options.size_x = options.size_y = 1;
  EXPECT_EQ(message_of([&] { read_surface(SourceFile("m.txt", "1 2 3 4\n5 6 7 8\n"), options); }),
            "`unit_xy` is 1 um, and \"m.txt\" holds no positions, only heights; leave it out: only x y z "
            "points and profiles in two columns have positions");
}

// Never a matrix of the coordinates.
TEST(Xyz, LatticesWithPointsMissingAreNeverMatrices) {
  const Stream stream(11, "lattices");
  std::uint64_t draw = 0;
  int maps = 0, refused = 0, wrong = 0;
  const ReadOptions options = in_micrometres();
  for (int nx = 2; nx <= 20; ++nx)
    for (int ny = 2; ny <= 20; ++ny)
      for (int attempt = 0; attempt < 4; ++attempt) {
        const std::uint64_t left = 1 + stream.below(draw++, static_cast<std::uint64_t>(nx * ny));
        std::vector<int> places(static_cast<std::size_t>(nx * ny));
        std::iota(places.begin(), places.end(), 0);
        for (std::size_t k = 0; k < left; ++k)
          std::swap(places[k], places[k + stream.below(draw++, places.size() - k)]);
        places.resize(left);
        std::sort(places.begin(), places.end());
        const double dx = 0.5 * attempt + 0.25, x0 = 7.5 * attempt;
        std::string text;
        for (const int place : places)
          text += format_exact(x0 + dx * (place % nx)) + "\t" + std::to_string(place / nx) + "\t" +
                  std::to_string(place) + "\n";
        const auto error = testing::error_of([&] {
          const Surface found = read_surface(SourceFile("left.txt", text), options);
          ++maps;
          // Places are relative to the first remaining column and row.
          int first_i = nx, first_j = ny;
          for (const int place : places) {
            first_i = std::min(first_i, place % nx);
            first_j = std::min(first_j, place / nx);
          }
          for (const int place : places) {
            const double i = dx * (place % nx - first_i) * 1e-6 / found.grid().hx(),
                         j = (place / nx - first_j) * 1e-6 / found.grid().hy();
            const int column = static_cast<int>(std::round(i)), row = static_cast<int>(std::round(j));
            const bool there = std::abs(i - column) < 1e-9 && std::abs(j - row) < 1e-9 &&
                               column < found.grid().nx && row < found.grid().ny &&
                               std::abs(found.height(column, row) - place * 1e-6) < 1e-12;
            wrong += there ? 0 : 1;
          }
          wrong += found.grid().nx > nx || found.grid().ny > ny ? 1 : 0;
          wrong += found.measured() != places.size() ? 1 : 0;
        });
        if (error) {
          ++refused;
          EXPECT_EQ(error->code(), ErrorCode::bad_file) << error->what() << "\n" << text;
        }
        const bool size_asked = error && error->sentence().find("does not say its size") != std::string::npos;
        EXPECT_FALSE(size_asked) << text;
      }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(maps, 300);
  EXPECT_GT(refused, 300);
}

TEST(Xyz, ThreePointsOfFourAndUnevenOnesAreAskedAbout) {
  ReadOptions options = in_micrometres();
  options.size_x = options.size_y = 1e-3;
  const std::string three = "0\t0\t1\n1\t0\t2\n0\t1\t3\n";
  for (const std::string& text :
       {three, three + "1.2\t1\t3\n", std::string("0 0 1\n"), std::string("0 0 1\n1 1 4\n")}) {
    const std::string message = message_of([&] { read_surface(SourceFile("hx3.txt", text), options); });
    EXPECT_NE(message.find("`format` = \"text\""), std::string::npos) << text << message;
  }
  options.format = "xyz";
  options.size_x.reset(), options.size_y.reset();
  EXPECT_EQ(read_surface(SourceFile("hx3.txt", three), options).measured(), 3U);
  options.fill = HoleFill::interpolate();
  EXPECT_EQ(read_surface(SourceFile("hx3.txt", three), options).grid(), (Grid{2, 2, 2e-6, 2e-6}));
}

// Repeated, irregular or unordered places form no lattice.
TEST(Xyz, MatricesOfThreeColumnsStayMatrices) {
  ReadOptions options = heights_in_micrometres();
  options.size_x = options.size_y = 1e-3;
  for (const char* text : {"5 1 2\n3 9 4\n8 2 7\n6 4 4\n0 0 1\n", "1 1 2\n1 1 3\n1 2 2\n1 1 1\n",
                           "0.31831 1.5708 3\n-2.7183 1.4142 2\n0.57722 -1.6180 1\n9.8 0.3 4\n"})
    EXPECT_EQ(read_surface(SourceFile("narrow.txt", text), options).grid().nx, 3) << text;
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
  ReadOptions options = heights_in_micrometres();
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
  ReadOptions options = heights_in_micrometres();
  options.size_x = options.size_y = 1e-3;
  const auto answer = [&](const std::string& name) {
    return message_of([&] { read_surface(scratch.write(name, text), options); });
  };
  EXPECT_NE(answer("cloud.xyz").find("is not on a regular grid"), std::string::npos) << answer("cloud.xyz");
  EXPECT_NE(answer("cloud.txt").find("three columns and a hundred lines or more"), std::string::npos);
  options.format = "text";
  EXPECT_EQ(read_surface(scratch.write("map.txt", text), options).grid().nx, 3);
}

// Point k of the nx x ny lattice appears copies(k) times.
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
    ReadOptions options = heights_in_micrometres();
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
  EXPECT_EQ(answer("# Channel: Height\n# Width: 3 um\n# Height: 8 um\n" + few, ""), "no error");
  EXPECT_EQ(answer("h=8 w=3\npixel size=1e-6\n" + few, ""), "no error");
}

// Few height steps, random or smooth.
TEST(Xyz, MatricesOfFewDistinctHeightsStayMatrices) {
  const Scratch scratch;
  ReadOptions options = heights_in_micrometres();
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
}  // namespace asperity::xyz_test

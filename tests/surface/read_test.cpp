// SPDX-License-Identifier: GPL-3.0-or-later
// Format recognition, missing information, holes and bad paths; each format has its own test.
#include "engine/surface/io/read.hpp"
#include "engine/surface/io/format.hpp"

#include <cmath>

#include "engine/core/files/source_file.hpp"
#include "engine/core/memory.hpp"
#include "tests/support/warnings.hpp"
#include "tests/surface/files.hpp"

namespace asperity::read_test {
namespace {

using testing::error_of;
using testing::measured;
using testing::message_of;
using testing::sample;
using testing::Scratch;

ReadOptions square(double size, double unit) {
  ReadOptions options;
  options.size_x = options.size_y = size;
  options.unit = unit;
  return options;
}

TEST(Read, PathsThatHoldNoFile) {
  const Scratch scratch;
  const auto missing = error_of([&] { read_surface(scratch.path("no.x3p")); });
  ASSERT_TRUE(missing);
  EXPECT_EQ(missing->code(), ErrorCode::bad_file);
  EXPECT_EQ(missing->sentence(), "there is no file \"" + scratch.path("no.x3p") + "\"");
  EXPECT_NE(message_of([] { read_surface(""); }).find("there is no file"), std::string::npos);
  EXPECT_NE(message_of([&] { read_surface(scratch.path("")); }).find("is a directory"), std::string::npos);
  EXPECT_NE(message_of([] { read_surface("/dev/null"); }).find("is not a plain file"), std::string::npos);
  scratch.write("empty.txt", "");
  EXPECT_NE(message_of([&] { read_surface(scratch.path("empty.txt")); }).find("is empty"), std::string::npos);
}

TEST(Read, UnknownFormatSaysWhatWasLookedFor) {
  const Scratch scratch;
  scratch.write("map.sensor", "a topography\nof another make\n");
  const auto error = error_of([&] { read_surface(scratch.path("map.sensor")); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::bad_file);
  for (const Format* format : formats())
    EXPECT_NE(error->sentence().find(std::string(format->name) + " (" + std::string(format->marks) + ")"),
              std::string::npos)
        << format->name;
}

TEST(Read, EveryFormatIsDescribed) {
  for (const Format* format : formats())
    for (const std::string_view sentence :
         {format->account.read, format->account.refused, format->account.checked})
      EXPECT_TRUE(sentence.size() > 10 && sentence.size() < 200 && sentence.ends_with('.')) << format->name;
}

TEST(Read, ContentComesBeforeExtension) {
  const Scratch scratch;
  scratch.write("really.txt", testing::bytes_of(sample("ramp.npy")));
  const Surface surface = read_surface(scratch.path("really.txt"), square(1e-3, 1e-6));
  EXPECT_EQ(surface.grid().nx, 3);
  EXPECT_DOUBLE_EQ(surface.height(2, 1), 5e-6);
}

TEST(Read, ForcedFormat) {
  ReadOptions options = square(1e-3, 1e-6);
  options.format = "text";
  const Surface matrix = read_surface(sample("points.xyz"), options);
  EXPECT_EQ(matrix.grid().nx, 3);
  EXPECT_EQ(matrix.grid().ny, 12);
  options.format = "npi";
  const std::string unknown = message_of([&] { read_surface(sample("points.xyz"), options); });
  EXPECT_TRUE(unknown.starts_with(
      "`format` is \"npi\" (did you mean `npy`?); known formats are `npy`, `x3p`, `hdf5`, `gwy`, "))
      << unknown;
  EXPECT_TRUE(unknown.ends_with(", `stylus-csv`, `xyz` and `text`")) << unknown;
  options.format = "npy";
  EXPECT_NE(message_of([&] {
              read_surface(sample("points.xyz"), options);
            }).find("lacks the mark of the format `npy`"),
            std::string::npos);
}

TEST(Read, MissingSizeAndUnitAreNamed) {
  const Scratch scratch;
  const std::string path = scratch.write("bare.txt", "1 2\n3 4\n");
  EXPECT_EQ(message_of([&] { read_surface(path); }),
            "\"" + path +
                "\" does not say its size and unit; give `size` and `unit` in the call: `unit` is the "
                "length of one number, such as \"um\"");
  ReadOptions options;
  options.unit = 1e-6;
  EXPECT_EQ(message_of([&] { read_surface(path, options); }),
            "\"" + path + "\" does not say its size; give `size` in the call");
  options = square(1e-3, 1e-6);
  options.unit.reset();
  const auto error = error_of([&] { read_surface(path, options); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::bad_value);
  EXPECT_NE(error->sentence().find("does not say its unit"), std::string::npos);
  for (const double wrong : {0.0, -1.0, double(INFINITY), double(NAN)}) {
    EXPECT_NE(message_of([&] { read_surface(path, square(wrong, 1)); }).find("`size` is"), std::string::npos);
    EXPECT_NE(message_of([&] { read_surface(path, square(1, wrong)); }).find("`unit` is"), std::string::npos);
  }
}

TEST(Read, CallWinsOverFileAndSaysSo) {
  test::Warnings listener;
  ReadOptions options = square(4e-6, 1e-9);
  const Surface surface = read_surface(sample("instrument.txt"), options, listener);
  EXPECT_EQ(surface.grid().size_x, 4e-6);
  EXPECT_EQ(surface.height(0, 0), -1e-9);
  EXPECT_EQ(listener.all.size(), 3U);
  test::Warnings quiet;
  read_surface(sample("instrument.txt"), {}, quiet);
  EXPECT_TRUE(quiet.all.empty());
}

TEST(Read, MaterialTravelsAndIsChecked) {
  ReadOptions options;
  options.material = named_material("Al-2011");
  EXPECT_EQ(read_surface(sample("instrument.txt"), options).material()->name, "Al-2011");
  options.material->poisson = 2.0;
  EXPECT_TRUE(error_of([&] { read_surface(sample("instrument.txt"), options); }));
}

TEST(Read, HolesStayHolesUnlessFilled) {
  const Scratch scratch;
  const std::string path = scratch.write("holes.txt", "1 2 3\n4 nan 6\n7 8 bad\n");
  ReadOptions options = square(3e-6, 1e-6);
  const Surface holed = read_surface(path, options);
  EXPECT_EQ(holed.measured(), 7U);
  EXPECT_TRUE(std::isnan(holed.height(1, 1)));
  EXPECT_TRUE(std::isnan(holed.height(2, 2)));
  EXPECT_EQ(holed.height(1, 2), 8e-6);
  options.fill = HoleFill::with(0.25);
  EXPECT_EQ(read_surface(path, options).height(1, 1), 0.25);
  options.fill = HoleFill::interpolate();
  const Surface filled = read_surface(path, options);
  EXPECT_NEAR(filled.height(1, 1), 5e-6, 1e-16);  // the mean of 2, 4, 6 and 8
  EXPECT_NEAR(filled.height(2, 2), 7e-6, 1e-16);  // the mean of 6 and 8: zero slope at the rim
  options.fill = HoleFill::with(NAN);
  EXPECT_NE(message_of([&] { read_surface(path, options); }).find("`fill` is nan"), std::string::npos);
}

TEST(Read, InterpolationContinuesPlanesThroughHoles) {
  // A plane is harmonic on cells of any shape; all holes are interior.
  const Scratch scratch;
  std::string text;
  for (int j = 0; j < 30; ++j) {
    for (int i = 0; i < 40; ++i) {
      const bool hole = i > 4 && i < 33 && j > 3 && j < 25 && (i * 7 + j * 3) % 11 != 0;
      text += hole ? "nan " : std::to_string(2 * i - 3 * j) + " ";
    }
    text += "\n";
  }
  const std::string path = scratch.write("plane.txt", text);
  ReadOptions options;
  options.size_x = 40e-6;
  options.size_y = 90e-6;
  options.unit = 1e-9;
  options.fill = HoleFill::interpolate();
  const Surface surface = read_surface(path, options);
  for (int j = 0; j < 30; ++j)
    for (int i = 0; i < 40; ++i)
      ASSERT_NEAR(surface.height(i, j), (2 * i - 3 * j) * 1e-9, 1e-17) << i << " " << j;
  EXPECT_EQ(surface.digest(), read_surface(path, options).digest());
}

TEST(Read, NothingButHoles) {
  const Scratch scratch;
  ReadOptions options = square(1, 1);
  options.fill = HoleFill::interpolate();
  const std::string path = scratch.write("void.txt", "nan nan\nnan nan\n");
  EXPECT_NE(message_of([&] { read_surface(path, options); }).find("holds no height"), std::string::npos);
}

TEST(Read, ProfileFromEveryShape) {
  const Scratch scratch;
  ReadProfileOptions options;
  options.spacing = 2e-6;
  options.unit = 1e-6;
  const std::string row = scratch.write("row.txt", "1 2 3 4\n"),
                    column = scratch.write("column.txt", "1\n2\n3\n4\n");
  EXPECT_EQ(read_profile(row, options).digest(), read_profile(column, options).digest());
  ReadProfileOptions only_unit;
  only_unit.unit = 1e-6;
  EXPECT_NE(message_of([&] {
              read_profile(scratch.write("pairs.csv", "0,1\n2,2\n4,3\n6,4\n"), only_unit);
            }).find("does not say the unit of its positions; give `unit_xy` in the call"),
            std::string::npos);
  ReadProfileOptions both = only_unit;
  both.unit_xy = 1e-6;
  const Profile pairs = read_profile(scratch.write("pairs.csv", "0,1\n2,2\n4,3\n6,4\n"), both);
  EXPECT_NEAR(pairs.spacing(), 2e-6, 1e-21);
  EXPECT_EQ(pairs.heights()[3], 4e-6);
  EXPECT_NE(message_of([&] { read_profile(row, only_unit); }).find("does not say its spacing"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              read_profile(scratch.write("uneven.csv", "0,1\n2,2\n9,3\n"), both);
            }).find("not evenly spaced at sample"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              read_profile(scratch.write("one.csv", "x [um],z [nm]\n0,1\n"), {});
            }).find("and one row; a profile takes two samples or more"),
            std::string::npos);
  EXPECT_NE(
      message_of([&] { read_profile(sample("instrument.txt")); }).find("holds a surface of 4 x 3 heights"),
      std::string::npos);
  const std::string gap = scratch.write("gap.txt", "1 nan nan 4\n");
  const Profile holed = read_profile(gap, options);
  EXPECT_EQ(holed.measured(), 2U);
  EXPECT_TRUE(std::isnan(holed.measured_heights()[2]));
  EXPECT_EQ(holed.measured_heights()[3], 4e-6);
  options.fill = HoleFill::interpolate();
  const Profile filled = read_profile(gap, options);
  EXPECT_NEAR(filled.heights()[1], 2e-6, 1e-17);
  EXPECT_NEAR(filled.heights()[2], 3e-6, 1e-17);
}

TEST(Read, TwoColumnsUnderAHeadAreATrace) {
  for (const char* head : {"x [mm],z [um]\n", "x (mm);z (um)\n", "x/mm\tz/um\n", "# x [mm], z [um]\n",
                           "Position [mm];Height [um]\n"}) {
    const std::string text = std::string(head) + "0 1\n0.1 2\n0.2 4\n";
    const Profile trace = read_profile(SourceFile("trace.csv", text));
    EXPECT_DOUBLE_EQ(trace.spacing(), 1e-4) << head;
    EXPECT_EQ(trace.heights()[2], 4e-6) << head;
    EXPECT_EQ(read_surface(SourceFile("trace.csv", text)).grid(),
              (Grid{3, 1, trace.spacing() * 3, trace.spacing()}))
        << head;
  }
  ReadProfileOptions options;
  options.unit = 1e-3;
  EXPECT_NE(message_of([&] {
              read_profile(SourceFile("trace.csv", "x [mm],z [um]\n0,1\n1,2\n2,4\n"), options);
            }).find("heights in units of 1 um, and `unit` is 1 mm"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              read_profile(SourceFile("trace.csv", "x [mm],z [um]\n0,1,5\n1,2,6\n"));
            }).find("has 3 columns under a head that names two"),
            std::string::npos);
}

// An implausible size reveals a wrong header or unit.
TEST(Read, LengthsOutOfAllProportionAreWarnedOf) {
  const auto warnings = [](const std::string& text, const ReadOptions& options) {
    test::Warnings heard;
    read_surface(SourceFile("map.txt", text), options, heard);
    return heard.all;
  };
  const std::string four = "1 2\n3 4\n";
  EXPECT_TRUE(warnings(four, square(1e-6, 1e-9)).empty());
  EXPECT_TRUE(warnings(four, square(1, 1)).empty());
  const auto said = [&](const std::string& text, const ReadOptions& options, const char* part) {
    const std::vector<std::string> all = warnings(text, options);
    return all.size() == 1 && all[0].find(part) != std::string::npos;
  };
  EXPECT_TRUE(said("h=2 w=2\npixel size=1e-43 m\n" + four, square(2e-43, 1e-60), "points 1e-43 m apart"));
  EXPECT_TRUE(said(four, square(1e4, 1), "is 10 km long"));
  EXPECT_TRUE(said(four, square(1e-6, 1), "heights that span 3 m over 1 um: check its size and its unit"));
  ReadOptions narrow = square(1, 1e-9);
  narrow.size_y = 1e-8;
  EXPECT_TRUE(said(four, narrow, "has points 500 mm apart along x and 5 nm along y"));
}

// A truncated "152" reads as 15.
TEST(Read, ALastLineWithoutEndIsWarnedOf) {
  for (const auto& [text, warned] :
       {std::pair{"1 2\n3 4\n", false}, std::pair{"1 2\n3 4", true}, std::pair{"1 2\r3 4\r", false},
        std::pair{"0 0 1\n1 0 2\n0 1 3\n1 1 4", true}, std::pair{"x [mm],z [um]\n0,1\n1,2\n2,3", true}}) {
    test::Warnings heard;
    ReadOptions options;
    options.size_x = options.size_y = 1;
    if (!std::string_view(text).starts_with("x")) options.unit = 1;
    read_surface(SourceFile("map.txt", text), options, heard);
    EXPECT_EQ(heard.told("the last line has no line end"), warned) << text;
  }
}

// Refused without reading the sparse file.
TEST(Read, AFileThatDoesNotFitIsRefusedByItsSize) {
  const Scratch scratch;
  const std::string path = scratch.write("large.npy", "\x93NUMPY");
  std::filesystem::resize_file(path, std::uintmax_t{10} << 30);
  memory::set_limit(memory::held() + (std::int64_t{1} << 20));
  const auto error = error_of([&] { read_surface(path); });
  memory::set_limit(0);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::out_of_memory);
  EXPECT_EQ(error->sentence(), "\"" + path + "\" has 10 GiB, and the memory limit leaves 1 MiB");
}

TEST(Read, LimitOfCells) {
  const Scratch scratch;
  std::string line;
  for (int i = 0; i < 65537; ++i) line += "0 ";
  const std::string path = scratch.write("wide.txt", line + "\n");
  EXPECT_NE(message_of([&] { read_surface(path, square(1, 1)); }).find("`cells` is 65537"),
            std::string::npos);
  ReadProfileOptions options;
  options.spacing = options.unit = 1;
  EXPECT_EQ(read_profile(path, options).size(), 65537);  // traces may exceed the limit
}

TEST(Read, MeasuredFilesThatAreNotWhatTheyClaim) {
  if (measured("").empty()) GTEST_SKIP() << "ASPERITY_MEASURED is not set: no measured files here";
  EXPECT_NE(message_of([] {
              read_surface(measured("nonsense_txt_file.txt"));
            }).find("holds no table of numbers: line 1 starts with \"This is nonsense."),
            std::string::npos);
  EXPECT_NE(message_of([] {
              read_surface(measured("wrongnpyfile.npy"));
            }).find("lacks the mark of the format `npy`"),
            std::string::npos);
}

}  // namespace
}  // namespace asperity::read_test

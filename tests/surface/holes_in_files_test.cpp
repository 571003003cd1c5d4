// SPDX-License-Identifier: GPL-3.0-or-later
// Missing points in files: equal holes and, in double formats, equal bits; marks of other programs;
// contradictory marks.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/surface/io/archive.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/hdf5_surface.hpp"
#include "engine/surface/io/read.hpp"
#include "engine/surface/io/write.hpp"
#include "engine/surface/slabs/slab_surface.hpp"
#include "tests/support/warnings.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/little_endian.hpp"
#include "tests/surface/optical_files.hpp"

namespace asperity::holes_in_files_test {
namespace {

using testing::bytes_of;
using testing::message_of;
using testing::Scratch;

enum class Holes { corners, row, column, all_but_one, scattered };

bool is_hole(Holes where, int i, int j, int nx, int ny, const Stream& stream) {
  switch (where) {
    case Holes::corners:
      return (i == 0 || i == nx - 1) && (j == 0 || j == ny - 1);
    case Holes::row:
      return j == ny - 1;
    case Holes::column:
      return i == 0;
    case Holes::all_but_one:
      return i != nx / 2 || j != ny / 2;
    case Holes::scattered:
      break;
  }
  return stream.below(static_cast<std::uint64_t>(i + nx * j), 3) == 0;
}

Surface holed(Holes where, int nx = 7, int ny = 5, double unit = 1e-7 / 3) {
  const Stream stream(5, "holes"), heights_of(6, "heights");
  Field heights(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      heights(i, j) = is_hole(where, i, j, nx, ny, stream)
                          ? std::numeric_limits<double>::quiet_NaN()
                          : unit * heights_of.normal(static_cast<std::uint64_t>(i + nx * j));
  return Surface::with_holes(make_grid(nx, ny, 1e-4 / 3, 0.7e-4 / 3), std::move(heights));
}

constexpr Holes every_kind[] = {Holes::corners, Holes::row, Holes::column, Holes::all_but_one,
                                Holes::scattered};

Surface back(const Scratch& scratch, const Surface& surface, const std::string& name) {
  write_surface(surface, scratch.path(name));
  ReadOptions options;
  if (name.ends_with(".npy")) {
    options.size_x = surface.grid().size_x;
    options.size_y = surface.grid().size_y;
    options.unit = 1;
  }
  return read_surface(scratch.path(name), options);
}

TEST(HolesInFiles, SurfacesReadBackBitForBit) {
  const Scratch scratch;
  for (const Holes where : every_kind)
    for (const char* const name : {"a.x3p", "a.h5", "a.npy", "a.gwy", "a.txt", "a.asc", "a.csv"}) {
      const Surface surface = holed(where), found = back(scratch, surface, name);
      EXPECT_EQ(found.grid(), surface.grid()) << name;
      EXPECT_EQ(found.measured(), surface.measured()) << name;
      EXPECT_EQ(found.digest(), surface.digest()) << name << ", holes " << static_cast<int>(where);
    }
}

TEST(HolesInFiles, SameBytesEveryTime) {
  const Scratch scratch;
  const Surface surface = holed(Holes::scattered);
  for (const std::string name : {"s.x3p", "s.h5", "s.npy", "s.gwy", "s.sdf", "s.sur", "s.txt"}) {
    write_surface(surface, scratch.path("1" + name));
    write_surface(surface, scratch.path("2" + name));
    EXPECT_EQ(bytes_of(scratch.path("1" + name)), bytes_of(scratch.path("2" + name))) << name;
  }
}

TEST(HolesInFiles, ProfilesReadBackBitForBit) {
  const Scratch scratch;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Profile& profile :
       {Profile::with_holes(1e-6 / 3, {nan, 1e-7 / 3, nan, nan, -0.0, nan}),
        Profile::with_holes(1e-6, {1e-7, nan, 3e-7}, 2.5e-3), Profile::with_holes(1e-6, {nan, nan, 1e-9})}) {
    for (const char* const name : {"p.csv", "p.txt"}) {
      write_profile(profile, scratch.path(name));
      EXPECT_EQ(read_profile(scratch.path(name)).digest(), profile.digest()) << name;
    }
    write_profile(profile, scratch.path("p.npy"));
    ReadProfileOptions options;
    options.spacing = profile.spacing();
    options.unit = 1;
    const Profile found = read_profile(scratch.path("p.npy"), options);
    EXPECT_EQ(found.measured(), profile.measured());
    for (std::size_t k = 0; k < found.measured_heights().size(); ++k)
      EXPECT_EQ(std::isnan(found.measured_heights()[k]), std::isnan(profile.measured_heights()[k]));
  }
}

TEST(HolesInFiles, FillActsOnWhatWasWritten) {
  const Scratch scratch;
  const Surface surface = holed(Holes::scattered);
  write_surface(surface, scratch.path("a.x3p"));
  ReadOptions options;
  options.fill = HoleFill::with(2e-6);
  const Surface filled = read_surface(scratch.path("a.x3p"), options);
  EXPECT_TRUE(filled.complete());
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(filled.heights().values(), 2e-6)),
            surface.grid().nodes() - surface.measured());
  options.fill = HoleFill::interpolate();
  EXPECT_TRUE(read_surface(scratch.path("a.x3p"), options).complete());
}

TEST(HolesInFiles, CompleteSurfacesAreNotMarked) {
  const Scratch scratch;
  const Surface surface(make_grid(4, 3, 1e-3, 1e-3), Field(4, 3));
  for (const char* const name : {"a.x3p", "a.h5", "a.gwy", "a.txt"}) {
    write_surface(surface, scratch.path(name));
    const std::string bytes = bytes_of(scratch.path(name));
    for (const char* const mark : {"not measured", "not_measured", "Not measured", "mask"})
      EXPECT_EQ(bytes.find(mark), std::string::npos) << name;
  }
}

TEST(HolesInFiles, FilesSayHowManyPointsAreMissing) {
  const Scratch scratch;
  const Surface surface = holed(Holes::row);
  write_surface(surface, scratch.path("a.txt"));
  EXPECT_NE(bytes_of(scratch.path("a.txt")).find("\n# not measured = 7, written as nan\n"),
            std::string::npos);
  write_surface(surface, scratch.path("a.h5"));
  const Hdf5Content content = read_hdf5(scratch.path("a.h5"));
  ASSERT_NE(content.number("not_measured"), nullptr);
  EXPECT_EQ(*content.number("not_measured"), 7);
}

// The second point of the first stored line is missing.
TEST(HolesInFiles, EveryFormatHasItsOwnMark) {
  struct Example {
    std::string name, bytes;
  };
  const auto bcr = [](const std::string& kind, const std::string& rest) {
    return testing::Bytes()
        .field("fileformat = " + kind + "\nxpixels = 3\nypixels = 2\nxlength = 3\nylength = 2\n" + rest, 2048)
        .bytes();
  };
  const auto opd = [](const testing::OpdBlock& map) {
    return testing::opd_example(
        {map, testing::opd_number("Wavelength", 600), testing::opd_number("Pixel_size", 1)});
  };
  testing::Al3dExample al3d;
  al3d.tags.front().second = "3";
  al3d.pad = 4;
  testing::SdfExample words, numbers;
  words.type = 5;
  testing::SurExample sur;
  sur.special = 1;
  sur.least = 3;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Example> examples{
      {"a.sdf", words(std::vector<std::int16_t>{1, -32768, 3, 4, 5, 6})},
      {"b.sdf", numbers(std::vector<double>{1, NAN, 3, 4, 5, 6})},
      {"a.sur", sur(std::vector<std::int16_t>{3, 1, 3, 4, 5, 6})},
      {"a.bcr",
       bcr("bcrstm", "bit2nm = 1\n") + testing::raw(std::vector<std::int16_t>{1, 32767, 3, 4, 5, 6})},
      {"b.bcr", bcr("bcrf", "") + testing::raw(std::vector<float>{1, 3e38F, 3, 4, 5, 6})},
      {"c.bcr", bcr("bcrf", "") + testing::raw(std::vector<float>{1, nan, 3, 4, 5, 6})},
      {"a.dat", testing::MetroProExample{}({1, 2147483647, 3, 4, 5, 6})},
      {"a.plu", testing::PluExample{}({1, 1000001, 3, 4, 5, 6})},
      {"a.al3d", al3d({{1, 3e15F, 3}, {4, 5, 6}})},
      {"b.al3d", al3d({{1, nan, 3}, {4, 5, 6}})},
      {"a.frt",
       testing::frt_example({testing::frt_shape(3, 2, 16), testing::frt_size(3, 2), testing::frt_scale(1),
                             testing::frt_heights<std::uint16_t>({7, 1, 3, 4, 5, 6})})},
      // Column by column.
      {"a.opd", opd(testing::opd_map("RAW_DATA", 3, 2, std::vector<float>{1, 4, 1e38F, 5, 3, 6}))},
      {"b.opd", opd(testing::opd_map("RAW_DATA", 3, 2, std::vector<std::int16_t>{1, 4, 32767, 5, 3, 6}))},
      {"a.txt", "h=2 w=3\npixel size=1e-6\nheight conversion factor=1e-9\n1 nan 3\n4 5 6\n"},
      {"b.txt", "h=2 w=3\npixel size=1e-6\nheight conversion factor=1e-9\n1 BAD 3\n4 5 6\n"},
      {"a.csv", "h=2 w=3\npixel size=1e-6\nheight conversion factor=1e-9\n1;;3\n4;5;6\n"},
      {"a.xyz", "x [um];y [um];z [nm]\n0;0;1\n2;0;3\n0;1;4\n1;1;5\n2;1;6\n"},
      {"b.xyz", "x [um];y [um];z [nm]\n0;0;1\n1;0;\n2;0;3\n0;1;4\n1;1;5\n2;1;6\n"},
  };
  for (const Example& example : examples) {
    const SourceFile file(example.name, example.bytes);
    const Surface found = read_surface(file);
    const int first = choose_format(file, "").lines.first == FirstLine::top ? 1 : 0;
    EXPECT_EQ(found.grid().nx, 3) << example.name;
    EXPECT_EQ(found.measured(), 5U) << example.name;
    EXPECT_TRUE(std::isnan(found.height(1, first))) << example.name;
    EXPECT_FALSE(std::isnan(found.height(0, 1 - first))) << example.name;
    ReadOptions options;
    options.fill = HoleFill::with(1e-9);
    EXPECT_EQ(read_surface(file, options).height(1, first), 1e-9) << example.name;
  }
}

// X3P: NaN without a mask; checksums cover the stored entries.
TEST(HolesInFiles, ChecksumsOfX3pAreRight) {
  const Scratch scratch;
  write_surface(holed(Holes::scattered), scratch.path("a.x3p"));
  const SourceFile file(scratch.path("a.x3p"), Monitor::silent());
  const Archive archive(file);
  const auto entry = [&](const char* name) {
    const Array<char> bytes = archive.contents(archive.find(name), 1 << 20);
    return std::string(bytes.begin(), bytes.end());
  };
  const auto md5 = [](const std::string& bytes) {
    Md5 sum;
    sum.add(bytes);
    return sum.hex();
  };
  const std::string xml = entry("main.xml");
  EXPECT_EQ(entry("md5checksum.hex"), md5(xml) + " *main.xml\n");
  EXPECT_NE(xml.find("<MD5ChecksumPointData>" + md5(entry("bindata/data.bin")) + "</MD5ChecksumPointData>"),
            std::string::npos);
  EXPECT_EQ(xml.find("ValidPoints"), std::string::npos);
}

// GWY: a mask over the mean, explained in the metadata.
TEST(HolesInFiles, MaskOfGwyddionHoldsTheHoles) {
  const Scratch scratch;
  const Surface surface = holed(Holes::corners);
  write_surface(surface, scratch.path("a.gwy"));
  const std::string whole = bytes_of(scratch.path("a.gwy"));
  const auto with = [&](std::string from, const std::string& to) {
    std::string bytes = whole;
    const std::size_t at = bytes.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return bytes.replace(at, from.size(), to);
  };
  // An unexplained mask is ordinary: its points have the mean.
  test::Warnings warnings;
  const Surface taken = read_surface(SourceFile("a.gwy", with("Not measured", "Not Measured")), {}, warnings);
  EXPECT_TRUE(taken.complete());
  double sum = 0;
  for (const double height : surface.measured_heights().values()) sum += std::isnan(height) ? 0 : height;
  EXPECT_NEAR(taken.height(0, 0), sum / static_cast<double>(surface.measured()), 1e-20);
  ASSERT_EQ(warnings.all.size(), 1U);
  EXPECT_NE(warnings.all[0].find("has a mask, which is not applied"), std::string::npos);
  // The changed mask no longer matches the metadata.
  EXPECT_EQ(
      message_of([&] { read_surface(SourceFile("a.gwy", with("4 points", "5 points"))); }),
      "\"a.gwy\" holds the map 0 \"height\" with 4 masked points, and its metadata say \"5 points, those "
      "under th...\"; restore the mask, or delete \"Not measured\" from its metadata to read every point");
  EXPECT_NE(message_of([&] {
              read_surface(SourceFile("a.gwy", with("/0/mask", "/0/mosk")));
            }).find("with 0 masked points"),
            std::string::npos);
  testing::damage(whole, 23, 2000,
                  [](const std::string& bytes) { read_surface(SourceFile("a.gwy", bytes)); });
}

// HDF5: NaN or a fill-value attribute, as in netCDF.
TEST(HolesInFiles, FillValuesOfHdf5AreHoles) {
  ReadOptions options;
  options.size_x = options.size_y = 1e-3;
  const Surface found = read_surface(testing::sample("fill_value.h5"), options);
  EXPECT_EQ(found.measured(), 4U);
  EXPECT_TRUE(std::isnan(found.height(2, 0)) && std::isnan(found.height(1, 1)));
  EXPECT_EQ(found.height(2, 1), 6 * 1e-6);
}

TEST(HolesInFiles, InfiniteHeightsOfHdf5AreRefused) {
  const Scratch scratch;
  const auto file = [&](std::vector<double> heights) {
    Hdf5Content content;
    content.arrays.push_back(owning_array<double>("height", {1, heights.size()},
                                                  Array<double>(heights.begin(), heights.end()), "m"));
    content.arrays.push_back(tile_size(make_grid(static_cast<int>(heights.size()), 1, 1e-3, 1e-3)));
    write_hdf5(scratch.path("a.h5"), content);
    return scratch.path("a.h5");
  };
  EXPECT_EQ(read_surface(file({1, NAN, 3})).measured(), 2U);
  EXPECT_NE(message_of([&] {
              read_surface(file({1, INFINITY, 3}));
            }).find("an infinite height at node (1, 0)"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              read_surface(file({NAN, NAN}));
            }).find("holds no height, only missing points"),
            std::string::npos);
}

// Distributed surfaces need every point; the error names the file.
TEST(HolesInFiles, SurfacesOverRanksRefuseThem) {
  const Scratch scratch;
  write_surface(holed(Holes::column), scratch.path("a.npy"));
  EXPECT_EQ(message_of([&] {
              slab_read(Team::alone(), scratch.path("a.npy"), {.size_x = 1e-3, .size_y = 1e-3, .unit = {}},
                        Monitor::silent());
            }),
            "\"" + scratch.path("a.npy") +
                "\" has no height at node (0, 0), and over ranks every point is needed; fill it with the key "
                "`fill` of lab.surface.read, and write it again");
}

}  // namespace
}  // namespace asperity::holes_in_files_test

// SPDX-License-Identifier: GPL-3.0-or-later
// y points up, whichever line a file stores first; masks follow the heights.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/format.hpp"
#include "engine/surface/io/read.hpp"
#include "engine/surface/io/write.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/optical_files.hpp"
#include "tests/surface/scanning_probe_files.hpp"

namespace asperity::orientation_test {
namespace {

using testing::raw;
using testing::Scratch;

const std::string x3p_axis = "<AxisType>I</AxisType><Increment>1e-6</Increment>";

std::string x3p_example(const std::vector<double>& heights) {
  return testing::zip_of(
      {{"main.xml",
        "<p:ISO5436_2 xmlns:p=\"x\"><Record1><FeatureType>SUR</FeatureType><Axes><CX>" + x3p_axis +
            "</CX><CY>" + x3p_axis +
            "</CY><CZ><AxisType>A</AxisType><DataType>D</DataType></CZ></Axes></Record1><Record3>"
            "<MatrixDimension><SizeX>3</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ></MatrixDimension>"
            "<DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink></Record3></p:ISO5436_2>"},
       {"bindata/data.bin", raw(heights)}});
}

std::string npy_example(const std::vector<double>& heights) {
  std::string head = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }";
  head.resize(117, ' ');
  return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + head + "\n" + raw(heights);
}

// 1 2 3 and 4 5 6 in file order.
std::map<std::string, std::string> maps_of_two_lines() {
  using namespace testing;
  const std::vector<double> six{1, 2, 3, 4, 5, 6};
  const std::vector<float> floats{1, 2, 3, 4, 5, 6};
  const std::vector<std::int16_t> shorts{1, 2, 3, 4, 5, 6};
  NidImageExample nid;
  nid.data = raw(std::vector<std::int32_t>{1, 2, 3, 4, 5, 6});
  NanoscopeImageExample image;
  image.data = raw(shorts);
  ParkExample park;
  park.gain = 2;
  const std::string bcr =
      "fileformat = bcrstm\nxpixels = 3\nypixels = 2\nxlength = 3\nylength = 4\nbit2nm = 1\nintelmode = 1\n";
  return {{"npy", npy_example(six)},
          {"x3p", x3p_example(six)},
          {"gwy", gwy_example(gwy_inner("/0/data", GwyField().object()))},
          {"sur", SurExample()(shorts)},
          {"opd", opd_example({opd_number("Wavelength", 500), opd_number("Pixel_size", 1),
                               opd_map<float>("RAW_DATA", 3, 2, {1, 4, 2, 5, 3, 6})})},
          {"sdf", SdfExample()(six)},
          {"bcr", Bytes().field(bcr, 2048).put_all(shorts).bytes()},
          {"metropro", MetroProExample()({1, 2, 3, 4, 5, 6})},
          {"al3d", Al3dExample()({{1, 2, 3, 0}, {4, 5, 6, 0}})},
          {"frt", frt_example({frt_shape(3, 2, 16), frt_size(3e-6, 4e-6), frt_scale(1e-9),
                               frt_heights<std::uint16_t>({2, 3, 4, 5, 6, 7})})},
          {"nms", NmsExample()({1, 2, 3, 4, 5, 6})},
          {"plu", PluExample()(floats)},
          {"nanoscope", nanoscope({image})},
          {"nid", nid_example({nid})},
          {"ibw", IbwExample()(floats)},
          {"mi", mi_example({MiBufferExample{}}, raw(shorts))},
          {"wsxm", WsxmExample()(raw(std::vector<double>{3, 2, 1, 6, 5, 4}))},
          {"park", park(floats)},
          {"xyz", "0 0 1\n1 0 2\n2 0 3\n0 1 4\n1 1 5\n2 1 6\n"},
          {"text", "1 2 3\n4 5 6\n"}};
}

Surface read_as(const std::string& format, const std::string& bytes) {
  ReadOptions options;
  options.format = format;
  options.size_x = options.size_y = 1e-5;
  options.unit = 1e-9;
  return read_surface(SourceFile("map", bytes), options);
}

TEST(Orientation, EveryFormatPutsItsLowestLineFirst) {
  const std::set<std::string> top_first{"gwy", "sur", "bcr", "metropro", "al3d", "nms", "plu"};
  for (const auto& [name, bytes] : maps_of_two_lines()) {
    const Surface s = read_as(name, bytes);
    ASSERT_GE(s.grid().nx, 3) << name;
    ASSERT_EQ(s.grid().ny, 2) << name;
    EXPECT_EQ(s.height(0, 1) < s.height(0, 0), top_first.contains(name)) << name;
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        EXPECT_LT(s.height(i, j), s.height(i + 1, j)) << name << ", x runs backwards";
  }
}

TEST(Orientation, EveryFormatNamesItsSource) {
  const auto maps = maps_of_two_lines();
  // HDF5 is written below; the others hold profiles only.
  const std::set<std::string> without{"hdf5", "opdx", "stylus-csv"};
  for (const Format* format : formats()) {
    const std::string name(format->name);
    EXPECT_TRUE(format->lines.source.size() > 10 && format->lines.source.ends_with('.')) << name;
    EXPECT_NE(maps.contains(name), without.contains(name)) << name;
  }
}

// Oblong cells, holes that distinguish all corners, maximum on the top line.
Surface marked(int nx, int ny) {
  Field z(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) z(i, j) = 1e-9 * (j * j + 0.5 * i);
  if (nx > 2) z(1, 0) = std::numeric_limits<double>::quiet_NaN();
  if (ny > 3) z(nx - 1, ny - 2) = std::numeric_limits<double>::quiet_NaN();
  return Surface::with_holes(Grid{nx, ny, 1e-6 * nx, 2e-6 * ny}, std::move(z));
}

TEST(Orientation, WhatIsWrittenReadsBackAsItWas) {
  const Scratch scratch;
  for (const auto& [nx, ny] : {std::pair{5, 4}, {3, 8}, {1, 6}, {4, 2}})
    for (const char* ending : {"npy", "x3p", "h5", "gwy", "sdf", "sur", "txt", "csv", "asc"}) {
      const Surface surface = marked(nx, ny);
      const std::string path = scratch.path(std::string("a.") + ending);
      write_surface(surface, path);
      ReadOptions options;
      if (std::string(ending) == "npy") {
        options.size_x = surface.grid().size_x;
        options.size_y = surface.grid().size_y;
        options.unit = 1;
      }
      const Surface back = read_surface(path, options);
      ASSERT_EQ(back.grid().nx, nx) << ending;
      ASSERT_EQ(back.grid().ny, ny) << ending;
      for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
          const double found = back.height(i, j), wanted = surface.height(i, j);
          EXPECT_EQ(std::isnan(found), std::isnan(wanted)) << ending << " " << i << ", " << j;
          EXPECT_TRUE(std::isnan(wanted) || std::abs(found - wanted) < 1e-15)
              << ending << " " << i << ", " << j;
        }
    }
}

// Gwyddion displays the first line at the top.
TEST(Orientation, GwyddionIsGivenTheTopLineFirst) {
  const Scratch scratch;
  Field z(3, 2);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] = static_cast<double>(k + 1);
  write_surface(Surface(Grid{3, 2, 1, 1}, std::move(z)), scratch.path("a.gwy"));
  const std::string bytes = testing::bytes_of(scratch.path("a.gwy"));
  EXPECT_NE(bytes.find(raw(std::vector<double>{4, 5, 6, 1, 2, 3})), std::string::npos);
}

TEST(Orientation, TextUnderGwyddionsHeadBeginsAtTheTop) {
  const Scratch scratch;
  const std::string lines = "9e-6 9e-6 9e-6 9e-6\n0 0 nan 0\n";
  for (const char* head : {"# Channel: Height\n# Width: 3 um\n# Height: 2 um\n# Value units: m\n",
                           "# Kanal: H\n# Breite: 3 um\n# H\u00F6he: 2 um\n# Value units: m\n"}) {
    const Surface s = read_surface(scratch.write("m.txt", head + lines));
    EXPECT_EQ(s.height(0, 0), 0);
    EXPECT_TRUE(std::isnan(s.height(2, 0)));
    EXPECT_EQ(s.height(0, 1), 9e-6);
  }
  EXPECT_EQ(
      read_surface(scratch.write("w.txt", "# Width: 3 um\n# size [m] = 4e-6 2e-6\n# unit [m] = 1\n" + lines))
          .height(0, 0),
      9e-6);
}

TEST(Orientation, TracesKeepTheirOrder) {
  const Scratch scratch;
  const Profile pairs = read_profile(scratch.write("p.txt", "x [um],z [um]\n0,1\n1,2\n2,4\n"));
  EXPECT_EQ(pairs.measured_heights()[0], 1e-6);
  testing::GwyField line;
  line.nx = 6;
  line.ny = 1;
  ReadProfileOptions options;
  const Profile row = read_profile(
      SourceFile("a.gwy", testing::gwy_example(testing::gwy_inner("/0/data", line.object()))), options);
  EXPECT_EQ(row.measured_heights()[0], 1e-9);
  EXPECT_EQ(row.measured_heights()[5], 6e-9);
  const Profile stylus = read_profile(testing::sample("trace.csv"));
  EXPECT_EQ(read_surface(testing::sample("trace.csv")).height(0, 0), stylus.measured_heights()[0]);
}

}  // namespace
}  // namespace asperity::orientation_test

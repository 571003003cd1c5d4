// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/io/foreign_format.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/little_endian.hpp"

namespace asperity::foreign_format_test {
namespace {

using namespace std::string_literals;
using testing::message_of;

std::string refusal(const std::string& name, const std::string& bytes) {
  return message_of([&] { read_surface(SourceFile(name, bytes)); });
}

TEST(ForeignFormat, EachIsNamedByItsContent) {
  const std::string rest = std::string(40, '\0') + "more";
  const std::vector<std::array<std::string, 3>> files{{
      {"scan.di", "?*File list\r\n" + rest, "a Nanoscope file"},
      {"scan.stp", "WSxM file copyright Nanotec Electronica\r\n" + rest, "a WSxM file other than an image"},
      {"map.tmd", "Binary TrueMap Data File v2.0\r\n\0"s + rest, "a TrueMap topography"},
      {"map.vk4", "VK4_" + rest, "a Keyence profilometer file (.vk4)"},
      {"map.vk6", "VK6\0"s + rest, "a Keyence profilometer file (.vk6)"},
      {"map.nc", "CDF\x01\0"s + rest, "a NetCDF file"},
      {"map.mnt", "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1" + rest + "S\0c\0o\0p\0e\0d\0C\0o\0n\0t\0e\0n\0t\0s\0"s,
       "a document of MountainsMap"},
      {"old.xls", "\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1" + rest, "a compound document"},
      {"map.png", "\x89PNG\r\n\x1A\n" + rest, "a PNG picture"},
      {"map.tif", "II*\0"s + rest, "a TIFF picture"},
      {"map.xlsx", testing::zip_of({{"[Content_Types].xml", "<x/>"}, {"xl/workbook.xml", "<x/>"}}),
       "an Excel workbook (.xlsx)"},
      {"map.plux", testing::zip_of({{"index.xml", "<x/>"}, {"LAYER_0.raw", "0000"}}),
       "a Sensofar topography (.plux)"},
      {"map.zip", testing::zip_of({{"map.txt", "1 2"}}), "a zip archive without main.xml"},
      // Without a reliable mark: by extension.
      {"map.mnt", "\x01\x02" + rest, "a document of MountainsMap"},
  }};
  for (const auto& [name, bytes, what] : files) {
    const std::string message = refusal(name, bytes);
    EXPECT_NE(message.find("\"" + name + "\" is " + what), std::string::npos) << name << ": " << message;
    EXPECT_NE(message.find("which is not read; "), std::string::npos) << message;
    if (what.find("Mountains") == std::string::npos && what.find("Igor") == std::string::npos) {
      EXPECT_NE(refusal("other", bytes).find(what), std::string::npos) << name;
    }
  }
}

// Text is read despite another maker's binary extension.
TEST(ForeignFormat, TextsAreLookedAtByTheirContent) {
  ReadOptions options;
  options.size_x = options.size_y = options.unit = 1e-6;
  EXPECT_EQ(read_surface(SourceFile("map.top", "1 2\n3 4\n"), options).height(1, 1), 4e-6);
  EXPECT_FALSE(foreign_format(SourceFile("map.mnt", "words\n")));
}

TEST(ForeignFormat, ATextWithAHeadOfItsOwnIsToldWhereItsNumbersBegin) {
  EXPECT_EQ(
      refusal("trace.prf", "Stylus profiler\nOperator Li\nSpeed 0.5 mm/s\n\n0.0 1.2\n0.1 1.3\n0.2 1.1\n"),
      "\"trace.prf\" has a head in lines 1 (\"Stylus profiler\") to 4 over 2 columns of "
      "numbers: they may be positions and heights, or a matrix of heights; for a trace, write a line such as "
      "\"x [mm],z [um]\" below the head; with `format` = \"text\", `profile.read` takes positions and "
      "heights, `surface.read` a matrix");
  EXPECT_NE(refusal("trace.txt", "Stylus profiler, hall\n1 2\n3 4\n5 6\n").find("has a head in lines 1 "),
            std::string::npos);
  EXPECT_NE(refusal("map.txt", "Zygo ASCII Data File - Format 2\n0 1 2\n1 2 3\n4 5 6\n").find("MetroPro"),
            std::string::npos);
  EXPECT_NE(refusal("words.txt", "Only words,\nand two lines of them\n").find("holds no table of numbers"),
            std::string::npos);
}

std::string alicona(const std::string& folder, const std::vector<double>& heights) {
  const std::string axis = "<AxisType>I</AxisType><Increment>1e-6</Increment>";
  return testing::zip_of(
      {{folder + "main.xml",
        "<X><Record1><Axes><CX>" + axis + "</CX><CY>" + axis +
            "</CY><CZ><AxisType>A</AxisType><DataType>D</DataType></CZ></Axes></Record1><Record3>"
            "<MatrixDimension><SizeX>3</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ></MatrixDimension>"
            "<DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink></Record3></X>"},
       {folder + "bindata/data.bin", testing::raw(heights)}});
}

TEST(ForeignFormat, InfiniteHeightsOfX3pAreMissingPoints) {
  ReadOptions options;
  options.fill = HoleFill::with(7);
  const std::string bytes = alicona("", {1e-6, 2e-6, INFINITY, 4e-6, -INFINITY, 6e-6});
  const Surface surface = read_surface(SourceFile("map.x3p", bytes), options);
  EXPECT_EQ(surface.height(2, 0), 7);
  EXPECT_EQ(surface.height(1, 1), 7);
  EXPECT_EQ(surface.height(2, 1), 6e-6);
  const Surface holed = read_surface(SourceFile("map.x3p", bytes));
  EXPECT_EQ(holed.measured(), 4U);
  EXPECT_TRUE(std::isnan(holed.height(2, 0)) && std::isnan(holed.height(1, 1)));
}

TEST(ForeignFormat, X3pInAFolderIsRead) {
  const std::vector<double> heights{1e-6, 2e-6, 3e-6, 4e-6, 5e-6, 6e-6};
  const std::string plain = read_surface(SourceFile("map.x3p", alicona("", heights))).digest();
  for (const char* folder : {"map/", "My Map\\", "a/b/"})
    EXPECT_EQ(read_surface(SourceFile("map.x3p", alicona(folder, heights))).digest(), plain) << folder;
}

std::string in_utf16(const std::string& text) {
  std::string wide;
  for (const char c : text) wide += std::string{c, '\0'};
  return wide;
}

TEST(ForeignFormat, BcrWithAHeadInUtf16IsRead) {
  const auto head = [](const std::string& kind) {
    const std::string text =
        "fileformat = " + kind +
        "_unicode\nheadersize = 2048\nxpixels = 3\nypixels = 2\nxlength = 3000\nylength = "
        "4000\nbit2nm = 0.5\nintelmode = 1\n";
    return in_utf16(text + std::string(2048 - text.size(), '%'));
  };
  const Surface floats =
      read_surface(SourceFile("a.bcrf", head("bcrf") + testing::raw(std::vector<float>{1, 2, 3, 4, 5, 6})));
  EXPECT_EQ(floats.grid(), (Grid{3, 2, 3000 * 1e-9, 4000 * 1e-9}));
  EXPECT_EQ(floats.height(0, 0), 4 * 1e-9);
  const std::string integers = head("bcrstm") + testing::raw(std::vector<std::int16_t>{1, 2, 3, 4, 5, 6});
  EXPECT_EQ(read_surface(SourceFile("a.dat", integers)).height(2, 0), 6 * (0.5 * 1e-9));
  EXPECT_NE(refusal("a.bcr", integers.substr(0, 4000)).find("is cut short in its header of 4096 bytes"),
            std::string::npos);
  testing::damage(integers, 73, 1000,
                  [](const std::string& bytes) { read_surface(SourceFile("a.bcr", bytes)); });
}

}  // namespace
}  // namespace asperity::foreign_format_test

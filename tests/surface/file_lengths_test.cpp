// SPDX-License-Identifier: GPL-3.0-or-later
// A header that contradicts the length would shear the map unnoticed.
#include <gtest/gtest.h>

#include <functional>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "engine/surface/io/write.hpp"
#include "tests/support/warnings.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/little_endian.hpp"
#include "tests/surface/optical_files.hpp"

namespace asperity::file_lengths_test {
namespace {

using testing::Bytes;
using testing::message_of;

std::string refusal(const std::string& name, const std::string& bytes) {
  return message_of([&] {
    ReadOptions options;
    options.size_x = options.size_y = options.unit = 1e-6;
    options.fill = HoleFill::with(0);
    read_surface(SourceFile(name, bytes), options);
  });
}

// A file of 5 x 4 heights whose header claims nx x ny.
struct BinaryKind {
  std::string name;
  std::function<std::string(int nx, int ny)> file;
};
const std::vector<std::int16_t> twenty{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20};

std::vector<BinaryKind> binary_kinds() {
  return {
      {"a.sur",
       [](int nx, int ny) {
         testing::SurExample example;
         example.nx = nx;
         example.ny = ny;
         return example(twenty);
       }},
      {"a.sdf",
       [](int nx, int ny) {
         testing::SdfExample example;
         example.points = static_cast<std::uint16_t>(nx);
         example.profiles = static_cast<std::uint16_t>(ny);
         example.type = 5;
         return example(twenty);
       }},
      {"a.bcr",
       [](int nx, int ny) {
         return Bytes()
             .field("fileformat = bcrstm\nxpixels = " + std::to_string(nx) +
                        "\nypixels = " + std::to_string(ny) + "\nxlength = 1\nylength = 1\nbit2nm = 1\n",
                    2048)
             .put_all(twenty)
             .bytes();
       }},
      {"a.opd",
       [](int nx, int ny) {
         return testing::opd_example({testing::opd_map("RAW_DATA", static_cast<std::uint16_t>(nx),
                                                       static_cast<std::uint16_t>(ny), twenty),
                                      testing::opd_number("Wavelength", 600)});
       }},
      {"a.gwy",
       [](int nx, int ny) {
         testing::GwyField field;
         field.nx = nx;
         field.ny = ny;
         field.heights.assign(twenty.begin(), twenty.end());
         return testing::gwy_example(testing::gwy_inner("/0/data", field.object()));
       }},
      {"a.dat",
       [](int nx, int ny) {
         return testing::MetroProExample{
             .nx = static_cast<std::uint16_t>(nx),
             .ny = static_cast<std::uint16_t>(ny)}(std::vector<std::int32_t>(20, 5));
       }},
      {"a.nms",
       [](int nx, int ny) {
         return testing::NmsExample{.nx = static_cast<std::uint32_t>(nx),
                                    .ny = static_cast<std::uint32_t>(ny)}(std::vector<std::uint16_t>(20, 5));
       }},
      {"a.frt",
       [](int nx, int ny) {
         return testing::frt_example(
             {testing::frt_shape(static_cast<std::uint32_t>(nx), static_cast<std::uint32_t>(ny), 16),
              testing::frt_size(1, 1), testing::frt_scale(1e-9),
              testing::frt_heights<std::uint16_t>(std::vector<std::uint16_t>(20, 5))});
       }},
      {"a.npy",
       [](int nx, int ny) {
         const std::string head = "{'descr': '<i2', 'fortran_order': False, 'shape': (" + std::to_string(ny) +
                                  ", " + std::to_string(nx) + "), }\n";
         return std::string("\x93NUMPY\x01\0", 8) + testing::little(head.size(), 2) + head +
                testing::raw(twenty);
       }},
      {"a.x3p",
       [](int nx, int ny) {
         const std::string axis = "<AxisType>I</AxisType><Increment>1e-6</Increment>";
         return testing::zip_of(
             {{"main.xml",
               "<X><Record1><Axes><CX>" + axis + "</CX><CY>" + axis +
                   "</CY><CZ><AxisType>A</AxisType><DataType>I</DataType></CZ></Axes></Record1><Record3>"
                   "<MatrixDimension><SizeX>" +
                   std::to_string(nx) + "</SizeX><SizeY>" + std::to_string(ny) +
                   "</SizeY><SizeZ>1</SizeZ></MatrixDimension><DataLink><PointDataLink>p"
                   "</PointDataLink></DataLink></Record3></X>"},
              {"p", testing::raw(twenty)}});
       }},
  };
}

TEST(FileLengths, HeadAndLengthContradictEachOther) {
  for (const BinaryKind& kind : binary_kinds()) {
    EXPECT_EQ(refusal(kind.name, kind.file(5, 4)), "no error") << kind.name;
    for (const auto& [nx, ny] :
         {std::pair{4, 4}, std::pair{6, 4}, std::pair{5, 3}, std::pair{5, 5}, std::pair{1, 1}}) {
      const std::string message = refusal(kind.name, kind.file(nx, ny));
      EXPECT_TRUE(message.find(" bytes of data") != std::string::npos ||
                  message.find("bytes, but holds") != std::string::npos ||
                  message.find(" bytes after its header") != std::string::npos)
          << kind.name << ", " << nx << " x " << ny << ": " << message;
    }
  }
}

TEST(FileLengths, BytesOverAreCounted) {
  EXPECT_EQ(
      refusal("a.sur", testing::SurExample{.nx = 2}(std::vector<std::int16_t>{1, 2, 3, 4, 5, 6})),
      "\"a.sur\" says in its header that it holds 2 x 2 heights of 2 bytes but has 12 bytes of data, 4 too "
      "many; its header is wrong or the file is damaged");
}

TEST(FileLengths, TrailersAndFurtherObjectsAreNoBytesOver) {
  const std::string sdf = testing::SdfExample{.points = 5, .profiles = 4, .type = 5}(twenty);
  EXPECT_EQ(refusal("a.sdf", sdf + "*\r\n<Operator>somebody</Operator>\r\n"), "no error");
  EXPECT_NE(refusal("a.sdf", sdf + std::string("\x01\x02", 2)), "no error");
  const std::string one = testing::SurExample{.nx = 5, .ny = 4}(twenty);
  const std::string two = testing::SurExample{.objects = 2, .nx = 5, .ny = 4}(twenty);
  EXPECT_EQ(refusal("a.sur", two + one), "no error");
  EXPECT_EQ(refusal("a.sur", two), "no error");  // the second is missing
  EXPECT_NE(refusal("a.sur", testing::SurExample{.objects = 2, .nx = 4, .ny = 4}(twenty) + one)
                .find("holds 2 objects, and no second one after the 4 x 4 heights"),
            std::string::npos);
}

// Bytes after a stated end change no height but cause a warning.
TEST(FileLengths, BytesAfterTheEndThatAFileStatesAreWarnedOf) {
  const testing::Scratch scratch;
  write_surface(Surface(Grid{3, 2, 3e-6, 2e-6}, Field(3, 2, 1e-6)), scratch.path("a.h5"));
  const std::string gwy = testing::gwy_example(testing::gwy_inner("/0/data", testing::GwyField().object()));
  for (const auto& [name, whole] :
       {std::pair{std::string("a.gwy"), gwy},
        std::pair{std::string("a.h5"), testing::bytes_of(scratch.path("a.h5"))}}) {
    const auto warnings = [&, &name = name, &whole = whole](const std::string& more) {
      test::Warnings heard;
      const Surface found = read_surface(SourceFile(name, whole + more), {}, heard);
      EXPECT_EQ(found.digest(), read_surface(SourceFile(name, whole)).digest());
      return heard.all;
    };
    EXPECT_TRUE(warnings("").empty()) << name;
    const std::string said = "\"" + name + "\" has ",
                      cause = " after its stated end; they are not read: check whether the file is damaged";
    EXPECT_EQ(warnings("x"), std::vector<std::string>{said + "1 byte" + cause});
    EXPECT_EQ(warnings(whole),
              std::vector<std::string>{said + std::to_string(whole.size()) + " bytes" + cause});
  }
}

// 555 instead of 563 columns would shear the map.
TEST(FileLengths, MeasuredFileOfAnotherWidth) {
  if (testing::measured("").empty()) GTEST_SKIP() << "ASPERITY_MEASURED is not set: no measured files here";
  std::string bytes = testing::bytes_of(testing::measured("sur-2.sur"));
  bytes.replace(108, 4, testing::little(555, 4));
  EXPECT_NE(refusal("sur-2.sur", bytes).find("15488 too many"), std::string::npos);
}

}  // namespace
}  // namespace asperity::file_lengths_test

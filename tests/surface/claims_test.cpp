// SPDX-License-Identifier: GPL-3.0-or-later
// Memory follows the bytes of a file, never its header.
#include "engine/core/files/source_file.hpp"
#include "engine/core/memory.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"

namespace asperity::claims_test {
namespace {

using testing::little;
using testing::zip_of;

std::string npy_of(const std::string& shape) {
  const std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': " + shape + ", }\n";
  return std::string("\x93NUMPY\x01\0", 8) + little(header.size(), 2) + header + std::string(64, '\0');
}

std::string x3p_of(const std::string& cells, const std::string& points,
                   std::optional<std::uint64_t> claimed = {}) {
  const std::string axis = "<AxisType>I</AxisType><Increment>1e-6</Increment>";
  return zip_of(
      {{"main.xml", "<X><Record1><Axes><CX>" + axis + "</CX><CY>" + axis +
                        "</CY><CZ><AxisType>A</AxisType><DataType>D</DataType></CZ></Axes></Record1><Record3>"
                        "<MatrixDimension><SizeX>" +
                        cells + "</SizeX><SizeY>" + cells +
                        "</SizeY><SizeZ>1</SizeZ></MatrixDimension><DataLink><PointDataLink>p</PointDataLink>"
                        "</DataLink></Record3></X>"},
       {"p", points}},
      claimed);
}

// Limit: 128 KiB of counted memory.
std::optional<Error> refusal(const std::string& bytes, const std::string& format = "") {
  const std::int64_t before = memory::held();
  memory::set_limit(before + 131072);
  const std::optional<Error> error = testing::error_of([&] {
    ReadOptions options;
    options.size_x = options.size_y = options.unit = 1;
    options.format = format;
    read_surface(SourceFile("claims", bytes), options);
  });
  memory::set_limit(0);
  EXPECT_EQ(memory::held(), before);
  return error;
}

TEST(Claims, SmallFilesThatClaimMuchAreRefusedWithoutAllocating) {
  const std::string points(48, '\0');
  const std::string two_rows = "1 2\n3 4\n";
  const std::vector<std::pair<std::string, std::string>> files{
      {npy_of("(1000000, 1000000)"), "but has 64 bytes of data"},
      {npy_of("(4294967296, 4294967297)"), "4294967297 x 4294967296 heights"},  // 2^32 past 64 bits
      {npy_of("(2147483647,)"), "but has 64 bytes of data"},
      {"h=1000000 w=1000000\npixel size=1e-6 m\n" + two_rows, "1000000 columns but holds 2"},
      {"# asperity surface\n# cells = 1000000 1000000\n" + two_rows, "1000000 columns but holds 2"},
      {"# asperity profile\n# samples = 1e12\n" + two_rows, "1000000000000 samples but holds 2"},
      {"Length,1e9 m\nScan Data\nLateral um,Raw um\n0,1\n1,2\n", "of the 1e+06 km that its header states"},
      {x3p_of("1000000", points), "has a matrix whose SizeX is \"1000000\""},
      {x3p_of("65536", points), "34359738368 bytes, but holds 48"},
      {x3p_of("16384", points, std::uint64_t{1} << 31), "which is impossible"},
  };
  for (const auto& [bytes, finding] : files) {
    const std::optional<Error> error = refusal(bytes);
    ASSERT_TRUE(error) << finding;
    EXPECT_EQ(error->code(), ErrorCode::bad_file) << error->what();
    EXPECT_NE(error->sentence().find(finding), std::string::npos) << error->what();
  }
}

TEST(Claims, PointsThatSpanALatticeDoNotMakeIt) {
  std::string diagonal;
  for (int k = 0; k < 200; ++k) diagonal += std::to_string(k) + " " + std::to_string(k) + " 1\n";
  const std::optional<Error> error = refusal(diagonal, "xyz");
  ASSERT_TRUE(error);
  EXPECT_NE(error->sentence().find("200 points for 200 x 200 places"), std::string::npos) << error->what();
}

// Empty elements compress well; their tree exceeds the limit.
TEST(Claims, TheTreeOfMainXmlIsCountedAndBounded) {
  std::string xml = "<X>";
  for (int k = 0; k < 40000; ++k) xml += "<a/>";
  const std::string file = zip_of({{"main.xml", xml + "</X>"}});
  const std::int64_t before = memory::held();
  memory::set_limit(before + 1000000);
  const auto error = testing::error_of([&] { read_surface(SourceFile("tree.x3p", file)); });
  memory::set_limit(0);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::out_of_memory) << error->what();
  EXPECT_EQ(memory::held(), before);
  EXPECT_NE(testing::message_of([&] { read_surface(SourceFile("tree.x3p", file)); }).find("without Record1"),
            std::string::npos);
}

}  // namespace
}  // namespace asperity::claims_test

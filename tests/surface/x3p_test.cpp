// SPDX-License-Identifier: GPL-3.0-or-later
#include <bit>
#include <cctype>
#include <cmath>

#include "engine/core/memory.hpp"
#include "engine/surface/io/archive.hpp"
#include "engine/surface/io/read.hpp"
#include "engine/surface/io/write.hpp"
#include "tests/support/warnings.hpp"
#include "tests/surface/files.hpp"

namespace asperity::x3p_test {
namespace {

using test::Warnings;
using testing::measured;
using testing::message_of;
using testing::raw;
using testing::Scratch;
using testing::zip_of;

std::string incremental(const std::string& increment) {
  return "<AxisType>I</AxisType><Increment>" + increment + "</Increment>";
}

struct Recipe {
  std::string x = incremental("2e-6"), y = incremental("5e-7");
  std::string z = "<AxisType>A</AxisType><DataType>D</DataType>";
  std::string columns = "3", rows = "2", layers = "1", feature = "SUR";
  std::string content = "<DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink>";
  std::string prefix;  // of the inner elements, such as "p:"

  std::string xml() const {
    std::string text = "<?xml version=\"1.0\"?><p:ISO5436_2 xmlns:p=\"x\"><@Record1><@FeatureType>" +
                       feature + "</@FeatureType><@Axes><@CX>" + x + "</@CX><@CY>" + y + "</@CY><@CZ>" + z +
                       "</@CZ></@Axes></@Record1><@Record3><@MatrixDimension><@SizeX>" + columns +
                       "</@SizeX><@SizeY>" + rows + "</@SizeY><@SizeZ>" + layers +
                       "</@SizeZ></@MatrixDimension>" + content + "</@Record3></p:ISO5436_2>";
    for (std::size_t at = text.find('@'); at != std::string::npos; at = text.find('@'))
      text.replace(at, 1, prefix);
    return text;
  }
};

const std::string six = raw(std::vector<double>{0, 1, 2, 3, 4, 5});

Surface read_x3p(const std::string& bytes) {
  const Scratch scratch;
  return read_surface(scratch.write("map.x3p", bytes));
}

Surface read_with(const Recipe& recipe, const std::string& data) {
  return read_x3p(zip_of({{"main.xml", recipe.xml()}, {"bindata/data.bin", data}}));
}

void expect_ramp(const Surface& surface, double step = 1) {
  ASSERT_EQ(surface.grid().nx, 3);
  ASSERT_EQ(surface.grid().ny, 2);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i) EXPECT_DOUBLE_EQ(surface.height(i, j), step * (i + 3 * j));
}

TEST(X3p, DoublesXFastest) {
  const Surface surface = read_with({}, six);
  expect_ramp(surface);
  EXPECT_DOUBLE_EQ(surface.grid().size_x, 6e-6);
  EXPECT_DOUBLE_EQ(surface.grid().size_y, 1e-6);
}

TEST(X3p, NamespacedElements) {
  Recipe recipe;
  recipe.prefix = "p:";
  expect_ramp(read_with(recipe, six));
}

TEST(X3p, DataTypesIncrementAndOffset) {
  Recipe recipe;
  recipe.z = "<AxisType>A</AxisType><DataType>F</DataType>";
  expect_ramp(read_with(recipe, raw(std::vector<float>{0, 1, 2, 3, 4, 5})));
  recipe.z = "<AxisType>A</AxisType><DataType>I</DataType><Increment>1e-9</Increment><Offset>2e-9</Offset>";
  expect_ramp(read_with(recipe, raw(std::vector<std::int16_t>{-2, -1, 0, 1, 2, 3})), 1e-9);
  recipe.z = "<AxisType>A</AxisType><DataType>L</DataType><Increment>5e-10</Increment>";
  expect_ramp(read_with(recipe, raw(std::vector<std::int32_t>{0, 2, 4, 6, 8, 10})), 1e-9);
}

TEST(X3p, AbsoluteAxesStandWithEveryPoint) {
  Recipe recipe;
  recipe.x = recipe.y = "<AxisType>A</AxisType><DataType>D</DataType>";
  std::vector<double> points;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i)
      points.insert(points.end(), {1e-3 + i * 1e-6, j * 2e-6, static_cast<double>(i + 3 * j)});
  const Surface surface = read_with(recipe, raw(points));
  expect_ramp(surface);
  EXPECT_NEAR(surface.grid().size_x, 3e-6, 1e-15);
  EXPECT_NEAR(surface.grid().size_y, 4e-6, 1e-15);
  points[3] = 1e-3 + 1.7e-6;
  EXPECT_NE(
      message_of([&] { read_with(recipe, raw(points)); }).find("its x coordinates are not evenly spaced"),
      std::string::npos);
}

TEST(X3p, HeightsInTheXml) {
  Recipe recipe;
  recipe.content =
      "<DataList><Datum>0</Datum><Datum>1</Datum><Datum>2</Datum><Datum>3</Datum><Datum>4</Datum>"
      "<Datum>5</Datum></DataList>";
  expect_ramp(read_x3p(zip_of({{"main.xml", recipe.xml()}})));
  recipe.content =
      "<DataList><Datum>0</Datum><Datum/><Datum>2</Datum><Datum>3</Datum><Datum>4</Datum><Datum>5</Datum>"
      "</DataList>";
  const Surface holed = read_x3p(zip_of({{"main.xml", recipe.xml()}}));
  EXPECT_TRUE(std::isnan(holed.height(1, 0)));
  EXPECT_EQ(holed.measured(), 5U);
  recipe.columns = "4";
  EXPECT_NE(message_of([&] {
              read_x3p(zip_of({{"main.xml", recipe.xml()}}));
            }).find("has a matrix of 4 x 2 points but 6 in its list"),
            std::string::npos);
}

TEST(X3p, HolesByNanAndByMask) {
  const Surface by_nan = read_with({}, raw(std::vector<double>{0, 1, 2, 3, NAN, 5}));
  EXPECT_EQ(by_nan.measured(), 5U);
  EXPECT_TRUE(std::isnan(by_nan.height(1, 1)));
  Recipe recipe;
  recipe.content =
      "<DataLink><PointDataLink>bindata/data.bin</PointDataLink><ValidPointsLink>bindata/valid.bin"
      "</ValidPointsLink></DataLink>";
  const auto with_mask = [&](const std::string& mask) {
    return read_x3p(
        zip_of({{"main.xml", recipe.xml()}, {"bindata/data.bin", six}, {"bindata/valid.bin", mask}}));
  };
  const Surface by_mask = with_mask("\x3B");
  EXPECT_EQ(by_mask.measured(), 5U);
  EXPECT_TRUE(std::isnan(by_mask.height(2, 0)));
  EXPECT_EQ(by_mask.height(1, 1), 4);
  EXPECT_EQ(with_mask("\xFB").digest(), by_mask.digest());
  EXPECT_TRUE(with_mask("\x3F").complete());
}

TEST(X3p, MasksThatCannotBeAreRefused) {
  Recipe recipe;
  recipe.columns = "30";
  recipe.content =
      "<DataLink><PointDataLink>bindata/data.bin</PointDataLink><ValidPointsLink>bindata/valid.bin"
      "</ValidPointsLink></DataLink>";
  const std::string data = raw(std::vector<double>(60, 1e-6));
  const auto answer = [&](const std::vector<std::pair<std::string, std::string>>& mask) {
    std::vector<std::pair<std::string, std::string>> entries{{"main.xml", recipe.xml()},
                                                             {"bindata/data.bin", data}};
    entries.insert(entries.end(), mask.begin(), mask.end());
    return message_of([&] { read_x3p(zip_of(entries)); });
  };
  EXPECT_EQ(answer({{"bindata/valid.bin", std::string(8, '\x55')}}), "no error");
  EXPECT_NE(answer({{"bindata/valid.bin", std::string(7, '\xFF')}})
                .find("has too few bits in its valid-points entry"),
            std::string::npos);
  EXPECT_NE(answer({{"bindata/valid.bin", ""}}).find("has too few bits in its valid-points entry"),
            std::string::npos);
  EXPECT_NE(answer({{"bindata/valid.bin", std::string(1000, '\xFF')}}), "no error");
  EXPECT_NE(answer({}).find("has no entry \"bindata/valid.bin\", which its main.xml names"),
            std::string::npos);
  EXPECT_NE(
      answer({{"bindata/valid.bin", std::string(8, '\0')}}).find("holds no height, only missing points"),
      std::string::npos);
}

// Integers have no NaN.
TEST(X3p, MaskOfIntegersAndNanOfAnyBits) {
  Recipe recipe;
  recipe.z = "<AxisType>A</AxisType><DataType>I</DataType><Increment>1e-9</Increment>";
  recipe.content =
      "<DataLink><PointDataLink>bindata/data.bin</PointDataLink><ValidPointsLink>bindata/valid.bin"
      "</ValidPointsLink></DataLink>";
  const Surface integers =
      read_x3p(zip_of({{"main.xml", recipe.xml()},
                       {"bindata/data.bin", raw(std::vector<std::int16_t>{1, 2, 0, 4, 5, 6})},
                       {"bindata/valid.bin", "\x3B"}}));
  EXPECT_TRUE(std::isnan(integers.height(2, 0)));
  EXPECT_DOUBLE_EQ(integers.height(2, 1), 6e-9);
  std::vector<double> heights{0, 1, 2, 3, NAN, 5};
  const std::string digest = read_with({}, raw(heights)).digest();
  for (const std::uint64_t bits : {0x7FF8000000000001U, 0xFFF8000000000000U, 0x7FF0000000000001U}) {
    heights[4] = std::bit_cast<double>(bits);
    EXPECT_EQ(read_with({}, raw(heights)).digest(), digest) << bits;
  }
  EXPECT_EQ(read_with({}, raw(std::vector<double>{0, 1, 2, 3, -INFINITY, 5})).digest(), digest);
}

TEST(X3p, Md5IsCompared) {
  Md5 md5;
  md5.add(six);
  const std::string right = md5.hex();
  Recipe recipe;
  const std::string link = "<DataLink><PointDataLink>bindata/data.bin</PointDataLink><MD5ChecksumPointData>";
  recipe.content = link + right + "</MD5ChecksumPointData></DataLink>";
  expect_ramp(read_with(recipe, six));
  std::string wrong = right;
  wrong[0] = wrong[0] == '0' ? '1' : '0';
  recipe.content = link + wrong + "</MD5ChecksumPointData></DataLink>";
  EXPECT_NE(message_of([&] {
              read_with(recipe, six);
            }).find("is damaged: the MD5 of its data, the entry \"bindata/data.bin\", is " + right),
            std::string::npos);
}

std::string md5_of(const std::string& bytes) {
  Md5 md5;
  md5.add(bytes);
  return md5.hex();
}

// One flipped bit turns a hole into a height that was never measured.
TEST(X3p, EveryByteOfItsBinaryEntriesCounts) {
  const std::string mask("\x3B", 1);
  Recipe recipe;
  recipe.content =
      "<DataLink><PointDataLink>bindata/data.bin</PointDataLink><MD5ChecksumPointData>" + md5_of(six) +
      "</MD5ChecksumPointData><ValidPointsLink>bindata/valid.bin</ValidPointsLink><MD5ChecksumValidPoints>" +
      md5_of(mask) + "</MD5ChecksumValidPoints></DataLink>";
  const auto message = [&](const std::string& points, const std::string& valid) {
    return message_of([&] {
      ReadOptions options;
      options.fill = HoleFill::with(0);
      const Scratch scratch;
      read_surface(scratch.write("map.x3p", zip_of({{"main.xml", recipe.xml()},
                                                    {"bindata/data.bin", points},
                                                    {"bindata/valid.bin", valid}})),
                   options);
    });
  };
  EXPECT_EQ(message(six, mask), "no error");
  for (std::size_t k = 0; k < six.size(); ++k) {
    std::string damaged = six;
    damaged[k] = static_cast<char>(damaged[k] ^ 0x10);
    EXPECT_NE(
        message(damaged, mask).find("is damaged: the MD5 of its data, the entry \"bindata/data.bin\", is "),
        std::string::npos)
        << k;
  }
  for (const char flip : {'\x01', '\x04', '\xFF'}) {
    const std::string damaged(1, static_cast<char>(mask[0] ^ flip));
    EXPECT_NE(message(six, damaged)
                  .find("is damaged: the MD5 of its valid points, the entry \"bindata/valid.bin\", is " +
                        md5_of(damaged) + ", not " + md5_of(mask)),
              std::string::npos);
  }
}

// A wrong main.xml changes the scale.
TEST(X3p, TheSumOfMainXmlIsCompared) {
  const std::string xml = Recipe{}.xml(), sum = md5_of(xml);
  const auto warnings = [](const std::vector<std::pair<std::string, std::string>>& entries) {
    Warnings heard;
    const Scratch scratch;
    expect_ramp(read_surface(scratch.write("map.x3p", zip_of(entries)), {}, heard));
    // Ignores the warning about proportions.
    std::erase_if(heard.all, [](const std::string& text) { return text.find("MD5") == std::string::npos; });
    return heard.all;
  };
  const auto with = [&](const std::string& main, const std::string& hex) {
    return warnings({{"main.xml", main}, {"bindata/data.bin", six}, {"md5checksum.hex", hex}});
  };
  for (const std::string& right : {sum + " *main.xml\n", sum + "  main.xml", sum, " " + sum + "\r\n"})
    EXPECT_TRUE(with(xml, right).empty()) << right;
  std::string upper = sum;
  for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  EXPECT_TRUE(with(xml, upper + " *main.xml\n").empty());
  const std::string altered = xml + " ";
  const std::vector<std::string> told = with(altered, sum + " *main.xml\n");
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("map.x3p\": the MD5 of its main.xml is " + md5_of(altered) +
                         ", and the entry \"md5checksum.hex\" says " + sum + "; main.xml may "),
            std::string::npos)
      << told[0];
  for (const std::string& none : {std::string(), std::string("main.xml"), sum.substr(1), sum + "0"})
    EXPECT_TRUE(with(altered, none).empty()) << none;
  EXPECT_TRUE(warnings({{"main.xml", altered}, {"bindata/data.bin", six}}).empty());
  // main.xml may name the checksum file.
  Recipe named;
  named.content += "</@Record3><@Record4><@ChecksumFile>sum.hex</@ChecksumFile></@Record4><@Record3>";
  EXPECT_EQ(warnings({{"a/main.xml", named.xml()}, {"a/bindata/data.bin", six}, {"a/sum.hex", sum}}).size(),
            1U);
  EXPECT_TRUE(warnings({{"a/main.xml", named.xml()},
                        {"a/bindata/data.bin", six},
                        {"a/sum.hex", md5_of(named.xml())},
                        {"a/md5checksum.hex", sum}})
                  .empty());
}

TEST(X3p, DamageIsToldWithTheEntryThatHasIt) {
  const std::vector<std::pair<std::string, std::string>> entries{{"main.xml", Recipe{}.xml()},
                                                                 {"bindata/data.bin", six}};
  for (const auto& [name, bytes] : entries) {
    std::string damaged = zip_of(entries);
    damaged[damaged.find(bytes) + bytes.size() / 2] ^= 0x04;
    const std::string message = message_of([&] { read_x3p(damaged); });
    EXPECT_NE(message.find("is damaged: the entry \"" + name + "\" cannot be unpacked"), std::string::npos)
        << message;
  }
}

TEST(X3p, AChecksumThatIsNoneIsShownAsPlainText) {
  Recipe recipe;
  recipe.content =
      "<DataLink><PointDataLink>bindata/data.bin</PointDataLink><MD5ChecksumPointData>\xC3\xA9 a\xA0\x1B"
      "</MD5ChecksumPointData></DataLink>";
  EXPECT_NE(message_of([&] { read_with(recipe, six); }).find(", not \"\xC3\xA9 a??\"; "), std::string::npos);
}

TEST(X3p, MatrixAndDataDisagree) {
  for (const char* columns : {"4", "2", "60000"}) {
    Recipe recipe;
    recipe.columns = columns;
    EXPECT_NE(message_of([&] { read_with(recipe, six); }).find("bytes, but holds 48"), std::string::npos)
        << columns;
  }
  for (const char* columns : {"0", "-3", "65537", "3.5", "99999999999999999999999", "", "three"}) {
    Recipe recipe;
    recipe.columns = columns;
    EXPECT_NE(message_of([&] { read_with(recipe, six); }).find("has a matrix whose SizeX is"),
              std::string::npos)
        << columns;
  }
}

TEST(X3p, SizesThatAreLiesAreRefusedBeforeAllocating) {
  Recipe recipe;
  recipe.columns = recipe.rows = "16384";
  const std::uint64_t claimed = std::uint64_t{16384} * 16384 * 8;
  memory::set_limit(memory::held() + 1000000);
  const std::string message = message_of([&] {
    read_x3p(zip_of({{"main.xml", recipe.xml()}, {"bindata/data.bin", six}}, claimed, 8));
  });
  memory::set_limit(0);
  EXPECT_NE(message.find("which is impossible"), std::string::npos) << message;
}

TEST(X3p, WhatIsNotRead) {
  const auto refusal = [](void (*change)(Recipe&)) {
    Recipe recipe;
    change(recipe);
    return message_of([&] { read_with(recipe, six); });
  };
  EXPECT_NE(refusal([](Recipe& r) { r.feature = "PCL"; }).find("holds a point cloud"), std::string::npos);
  EXPECT_NE(refusal([](Recipe& r) { r.layers = "2"; }).find("holds 2 layers"), std::string::npos);
  EXPECT_NE(refusal([](Recipe& r) { r.x = "<AxisType>Q</AxisType>"; }).find("has an axis CX of type \"Q\""),
            std::string::npos);
  EXPECT_NE(refusal([](Recipe& r) {
              r.x = "<AxisType>I</AxisType>";
            }).find("no Increment above zero on its axis CX"),
            std::string::npos);
  EXPECT_NE(
      refusal([](Recipe& r) { r.y = incremental("-1e-6"); }).find("no Increment above zero on its axis CY"),
      std::string::npos);
  EXPECT_NE(refusal([](Recipe& r) {
              r.z = "<AxisType>A</AxisType><DataType>X</DataType>";
            }).find("has data of type \"X\" on axis CZ"),
            std::string::npos);
  EXPECT_NE(refusal([](Recipe& r) { r.content = ""; }).find("neither a DataLink nor a DataList"),
            std::string::npos);
  EXPECT_NE(refusal([](Recipe& r) {
              r.content = "<DataLink><PointDataLink>gone</PointDataLink></DataLink>";
            }).find("has no entry \"gone\""),
            std::string::npos);
  EXPECT_NE(message_of([] {
              read_x3p(zip_of({{"other.txt", "1"}}));
            }).find("a zip archive without main.xml"),
            std::string::npos);
  EXPECT_NE(message_of([] {
              read_x3p(zip_of({{"main.xml", "<a><b></a>"}}));
            }).find("has a damaged main.xml"),
            std::string::npos);
}

TEST(X3p, CutShortSaysSo) {
  const std::string whole = zip_of({{"main.xml", Recipe{}.xml()}, {"bindata/data.bin", six}});
  EXPECT_NE(
      message_of([&] { read_x3p(whole.substr(0, whole.size() / 2)); }).find("is not a whole zip archive"),
      std::string::npos);
}

TEST(X3p, DamagedBytesGiveErrors) {
  const Scratch scratch;
  Field heights(40, 30);
  for (std::size_t k = 0; k < heights.size(); ++k) heights[k] = 1e-9 * static_cast<double>(k % 97);
  write_surface(Surface(make_grid(40, 30, 1e-5, 1e-5), heights), scratch.path("whole.x3p"));
  const std::string packed = testing::bytes_of(scratch.path("whole.x3p"));
  const std::string stored = zip_of({{"main.xml", Recipe{}.xml()}, {"bindata/data.bin", six}});
  for (const std::string& whole : {packed, stored}) {
    int read = 0;
    testing::damage(whole, 11, 200, [&](const std::string& bytes) {
      ReadOptions options;
      options.fill = HoleFill::interpolate();
      read_surface(scratch.write("damaged.x3p", bytes), options);
      ++read;
    });
    EXPECT_GT(read, 0);
  }
}

TEST(X3p, MeasuredFile) {
  if (measured("").empty()) GTEST_SKIP() << "ASPERITY_MEASURED is not set: no measured files here";
  const Surface surface = read_surface(measured("x3p-2.x3p"));
  const Grid& grid = surface.grid();
  EXPECT_EQ(grid.nx, 650);
  EXPECT_EQ(grid.ny, 650);
  EXPECT_DOUBLE_EQ(grid.size_x, 8.29767313942749e-05);
  EXPECT_DOUBLE_EQ(grid.size_y, 2.044783737930349e-04);
  EXPECT_DOUBLE_EQ(surface.height(0, 0), 6.579781341223288e-08);
  EXPECT_DOUBLE_EQ(surface.height(1, 0), 7.419121341223288e-08);
  const auto values = surface.heights().values();
  const double average = mean(values);
  EXPECT_NEAR(average, -2.491824169e-09, 1e-18);
  EXPECT_NEAR(surface.height_range().min, -3.144206866e-07, 1e-16);
  EXPECT_NEAR(surface.height_range().max, 2.399155134e-07, 1e-16);
  double square = 0, slopes = 0;
  for (const double h : values) square += (h - average) * (h - average);
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(values.size())), 7.728033274e-08, 1e-16);
  for (int j = 0; j + 1 < grid.ny; ++j)
    for (int i = 0; i + 1 < grid.nx; ++i) {
      const double h = surface.height(i, j);
      slopes += std::pow((surface.height(i + 1, j) - h) / grid.hx(), 2) +
                std::pow((surface.height(i, j + 1) - h) / grid.hy(), 2);
    }
  EXPECT_NEAR(std::sqrt(slopes / (649.0 * 649.0)), 0.062070074, 1e-9);
}

TEST(X3p, MeasuredFileCutShort) {
  if (measured("").empty()) GTEST_SKIP() << "ASPERITY_MEASURED is not set: no measured files here";
  const std::string whole = testing::bytes_of(measured("x3p-2.x3p"));
  for (const std::size_t length : {std::size_t{10}, whole.size() / 2, whole.size() - 1}) {
    const Scratch scratch;
    const auto error =
        testing::error_of([&] { read_surface(scratch.write("cut.x3p", whole.substr(0, length))); });
    ASSERT_TRUE(error) << length;
    EXPECT_EQ(error->code(), ErrorCode::bad_file);
  }
}

}  // namespace
}  // namespace asperity::x3p_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/optical_files.hpp"

namespace asperity::sur_test {
namespace {

using testing::message_of;
using testing::SurExample;

const std::vector<std::int16_t> six{1, 2, 3, -4, 5, 6};

Surface read(const std::string& bytes, HoleFill fill = {}) {
  ReadOptions options;
  options.fill = fill;
  return read_surface(SourceFile("a.sur", bytes), options);
}
std::string refusal(const std::string& bytes) {
  return message_of([&] { read(bytes); });
}

TEST(Sur, IntegersOf16And32BitsAreRead) {
  const Surface s = read(SurExample()(six));
  EXPECT_EQ(s.grid(), (Grid{3, 2, 3e-6, 4e-6}));
  EXPECT_EQ(s.height(0, 0), -4 * 0.5 * 1e-9);
  SurExample wide{.bits = 32};
  EXPECT_EQ(read(wide(std::vector<std::int32_t>{1, 2, 3, 4, 2000000000, 6})).height(1, 0), 2e9 * 0.5 * 1e-9);
}

TEST(Sur, CommentAndPrivateZoneArePassedOver) {
  SurExample example;
  example.comment = std::string(300, 'c');
  example.own = std::string(41, 'p');
  EXPECT_EQ(read(example(six)).height(2, 0), 6 * 0.5 * 1e-9);
}

TEST(Sur, OffsetAndUnitsCount) {
  SurExample example;
  example.offset = 10;
  example.unit_z = "\xB5m";
  example.unit_xy = "mm";
  const Surface s = read(example(six));
  EXPECT_EQ(s.height(0, 1), 10.5 * 1e-6);
  EXPECT_EQ(s.grid().size_x, 3e-3);
}

TEST(Sur, UnmeasuredPointsAreHolesWhereTheHeaderSaysSo) {
  SurExample example;
  example.special = 1;
  example.least = -2;
  EXPECT_EQ(read(example(six), HoleFill::with(7)).height(0, 0), 7);
  EXPECT_EQ(read(example(six)).measured(), 5U);
  EXPECT_TRUE(std::isnan(read(example(six)).height(0, 0)));
  example.special = 0;
  EXPECT_EQ(read(example(six)).height(0, 0), -2e-9);
}

TEST(Sur, OneLineIsAProfile) {
  SurExample example;
  example.type = 1;
  example.nx = 6;
  example.ny = 1;
  const Profile p = read_profile(SourceFile("a.pro", example(six)));
  EXPECT_EQ(p.spacing(), 1e-6);
  EXPECT_EQ(p.heights()[3], -2e-9);
}

TEST(Sur, UnknownUnitsAreAskedFor) {
  SurExample example;
  example.unit_z = "V";
  EXPECT_EQ(refusal(example(six)),
            "\"a.sur\" does not say its unit; give `unit` in the call: `unit` is the length of "
            "one number, such as \"um\"");
}

std::string compressed(const SurExample& header, const std::vector<std::string>& pieces) {
  return header(std::vector<std::int16_t>{}) + testing::sur_pieces(pieces);
}

TEST(Sur, CompressedHeightsAreThoseOfThePlainFile) {
  SurExample header{.special = 1, .least = -4};
  const std::vector<std::int16_t> holed{1, -6, 3, -4, 5, 6};
  const Surface plain = read(header(holed), HoleFill{});
  header.mark = "DSCOMPRESSED";
  const std::string raw = testing::raw(holed);
  for (const std::vector<std::string>& pieces :
       {std::vector{raw}, std::vector{raw.substr(0, 5), raw.substr(5)}, std::vector{raw, std::string()}}) {
    const Surface unpacked = read(compressed(header, pieces), HoleFill{});
    EXPECT_EQ(unpacked.grid(), plain.grid());
    EXPECT_EQ(unpacked.measured(), 5U);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 2; ++j)
        if (i != 1 || j != 1) {
          EXPECT_EQ(unpacked.height(i, j), plain.height(i, j));
        }
  }
  header.objects = 2;
  const std::string two = compressed(header, {raw}) + compressed(header, {raw});
  EXPECT_EQ(read(two, HoleFill{}).measured(), 5U);
}

TEST(Sur, CompressedPiecesThatLieAreRefused) {
  const SurExample header{.mark = "DSCOMPRESSED"};
  const std::string raw = testing::raw(six), whole = compressed(header, {raw});
  const auto found = [&](const std::string& bytes, const std::string& part) {
    const std::string message = refusal(bytes);
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  found(compressed(header, {raw.substr(2)}), "3 x 2 heights of 2 bytes but has 10 bytes");
  found(compressed(header, {raw + "ab"}), "more compressed heights than its header says");
  found(compressed(header, {raw, raw}), "more compressed heights than its header says");
  found(whole + "behind", "has 6 bytes after its compressed heights");
  found(whole.substr(0, whole.size() - 1), "cut short in its compressed heights");
  found(whole.substr(0, 514), "cut short in the lengths of its compressed pieces");
  std::string changed = whole;
  changed[512] = 0;
  found(changed, "compressed in 0 pieces");
  changed[515] = 127;
  found(changed, "compressed in 2130706432 pieces");
  changed = whole;
  changed[516] = 11;  // in the first piece
  found(changed, "its heights should be 11 bytes out of");
  changed = whole;
  changed.back() = static_cast<char>(changed.back() + 1);  // its checksum
  found(changed, "does not unpack");
  found(compressed(SurExample{.mark = "DSCOMPRESSED", .nx = 2000000000, .ny = 2000000000}, {raw}),
        "2000000000 x 2000000000 heights, more than");
}

TEST(Sur, DamagedCompressionIsAnErrorOrAnotherSurface) {
  testing::damage(compressed(SurExample{.mark = "DSCOMPRESSED"}, {testing::raw(six)}), 67, 2000,
                  [](const std::string& bytes) { read(bytes, HoleFill::interpolate()); });
}

TEST(Sur, EachFaultIsSaid) {
  EXPECT_EQ(refusal(std::string("DIGITAL SURF\0\0 and no more", 27)),
            "\"a.sur\" is cut short in its header of 512 bytes");
  EXPECT_EQ(refusal("other"),
            "\"a.sur\" lacks the mark of the format `sur`: DIGITAL SURF at the start; if it is another "
            "format, name it with `format`");
  EXPECT_EQ(refusal(SurExample{.order = 257}(six)),
            "\"a.sur\" is a SUR file of an Apple computer (format 257); save it again on another computer");
  EXPECT_EQ(refusal(SurExample{.type = 3}(six)),
            "\"a.sur\" holds an object of type 3, which is no surface; surfaces and profiles are read: types "
            "1, 2, 4 "
            "and 5");
  EXPECT_EQ(refusal(SurExample{.bits = 8}(six)),
            "\"a.sur\" holds points of 8 bits; points of 16 and 32 bits are read");
  EXPECT_EQ(refusal(SurExample{.bits = 32}(six)),
            "\"a.sur\" says in its header that it holds 3 x 2 heights of 4 bytes but has 12 bytes of data; "
            "the file is "
            "cut short or its header is wrong");
  EXPECT_EQ(refusal(SurExample{.nx = -3}(six)),
            "\"a.sur\" says in its header that it holds 0 x 2 heights; its header is wrong");
  EXPECT_EQ(refusal(SurExample{.dz = 0}(six)), "\"a.sur\" gives 0 as the height of one step");
}

// Missing: 2 steps below the least height, 89120 steps of 0.1 nm.
TEST(Sur, MeasuredFile) {
  const std::string path = testing::measured("sur-2.sur");
  if (path.empty()) GTEST_SKIP() << "ASPERITY_MEASURED is not set: no measured files here";
  EXPECT_EQ(read_surface(path).measured(), 272492U - 117U);
  ReadOptions options;
  options.fill = HoleFill::with(10e-6);
  const Surface s = read_surface(path, options);
  EXPECT_EQ(s.grid().nx, 563);
  EXPECT_EQ(s.grid().ny, 484);
  EXPECT_NEAR(s.grid().hx(), 3.484e-6, 1e-12);
  const double step = static_cast<double>(1e-7F) * 1e-3;
  EXPECT_NEAR(s.height(0, 483), 101477 * step, 1e-18);  // first stored line: top
  EXPECT_NEAR(s.height_range().min, 89120 * step, 1e-18);
  EXPECT_NEAR(s.height_range().max, 103880 * step, 1e-18);
}

TEST(Sur, DamageIsAnErrorOrAnotherSurface) {
  testing::damage(SurExample{.special = 1}(six), 31, 4000,
                  [](const std::string& bytes) { read(bytes, HoleFill::interpolate()); });
}

}  // namespace
}  // namespace asperity::sur_test

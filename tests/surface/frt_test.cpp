// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/optical_files.hpp"

namespace asperity::frt_test {
namespace {

using testing::Bytes;
using testing::frt_example;
using testing::frt_heights;
using testing::frt_scale;
using testing::frt_shape;
using testing::frt_size;
using testing::FrtBlock;
using testing::message_of;

const FrtBlock six = frt_heights<std::uint16_t>({10, 20, 30, 40, 1, 60});
const FrtBlock shape = frt_shape(3, 2, 16), size = frt_size(3e-3, 4e-3), scale = frt_scale(1e-9);
const FrtBlock other{0x65, "somebody"};

Surface read(const std::string& bytes, HoleFill fill = {}) {
  ReadOptions options;
  options.fill = fill;
  return read_surface(SourceFile("a", bytes), options);
}
std::string refusal(const std::vector<FrtBlock>& blocks) {
  return message_of([&] { read(frt_example(blocks)); });
}

TEST(Frt, HeightsAreStepsLineByLine) {
  for (const char* version : {"1.00", "1.01"}) {
    const Surface s = read(frt_example({other, shape, size, scale, six, other}, version));
    EXPECT_EQ(s.grid(), (Grid{3, 2, 3e-3, 4e-3}));
    EXPECT_EQ(s.height(1, 0), 20 * 1e-9);
    EXPECT_EQ(s.height(0, 1), 40 * 1e-9);
    EXPECT_TRUE(std::isnan(s.height(1, 1)));
    EXPECT_EQ(s.measured(), 5U);
  }
  const Surface wide = read(
      frt_example({frt_shape(3, 2, 32), size, scale, frt_heights<std::int32_t>({-10, 70000, 1, 4, 5, 6})}));
  EXPECT_EQ(wide.height(1, 0), 70000 * 1e-9);
  EXPECT_EQ(wide.height(0, 0), -10 * 1e-9);
  EXPECT_EQ(wide.measured(), 5U);
}

TEST(Frt, WhatIsOutsideTheValidRangeIsMissing) {
  const FrtBlock valid{0x70, Bytes().put(std::uint32_t{20}).put(std::uint32_t{40}).bytes()};
  EXPECT_EQ(read(frt_example({shape, size, scale, valid, six})).measured(), 3U);
}

TEST(Frt, WhatTheFileDoesNotSayIsAskedFor) {
  EXPECT_NE(refusal({shape, six}).find("does not say its size and unit"), std::string::npos);
}

TEST(Frt, EachFaultIsSaid) {
  EXPECT_EQ(refusal({shape}), "\"a\" holds no map of heights; the block 0x0B, topography, is read");
  EXPECT_EQ(refusal({six}), "\"a\" does not say how many points it has");
  EXPECT_EQ(refusal({frt_shape(3, 2, 8), six}),
            "\"a\" holds heights of 8 bits; heights of 16 and 32 bits are read");
  EXPECT_NE(refusal({frt_shape(2, 2, 16), six}).find("12 bytes of data, 4 too many"), std::string::npos);
  EXPECT_NE(refusal({frt_shape(4000000000, 4000000000, 16), six}).find("4000000000 x 4000000000"),
            std::string::npos);
  EXPECT_EQ(refusal({shape, size, frt_scale(0), six}), "\"a\" gives 0 m as the height of one step");
  EXPECT_EQ(refusal({shape, frt_size(1, -1), scale, six}), "\"a\" gives -1 m as its size");
  EXPECT_EQ(refusal({shape, {0x67, "short"}, six}), "\"a\" is cut short in its size");
  EXPECT_EQ(refusal({shape, {0x70, std::string(8, '\0')}, six}),
            "\"a\" says that valid heights run from 0 to 0");
  EXPECT_EQ(message_of([] {
              read(frt_example({shape, six}, "2.00"));
            }),
            "\"a\" is of version \"2.00\"; versions 1.00 and 1.01 are read");
  const std::string whole = frt_example({shape, six});
  EXPECT_NE(message_of([&] {
              read(whole.substr(0, whole.size() - 1));
            }).find("has a block of 12 bytes where 11 are left"),
            std::string::npos);
}

TEST(Frt, DamageIsAnErrorOrAnotherSurface) {
  testing::damage(frt_example({other, shape, size, scale, six}), 61, 3000,
                  [](const std::string& bytes) { read(bytes, HoleFill::interpolate()); });
}

}  // namespace
}  // namespace asperity::frt_test

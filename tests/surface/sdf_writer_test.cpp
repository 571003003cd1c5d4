// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/core/arithmetic/random.hpp"
#include "engine/surface/io/read.hpp"
#include "engine/surface/io/write.hpp"
#include "tests/surface/files.hpp"

namespace asperity::sdf_writer_test {
namespace {

using testing::bytes_of;
using testing::message_of;
using testing::Scratch;

Surface rough(int nx, int ny, bool holes) {
  const Stream stream(7, "sdf");
  Field heights(nx, ny);
  for (std::size_t k = 0; k < heights.size(); ++k)
    heights[k] = holes && k % 5 == 2 ? std::numeric_limits<double>::quiet_NaN() : 1e-6 * stream.normal(k);
  return Surface::with_holes(make_grid(nx, ny, 3.1e-4, 1.7e-4), std::move(heights));
}

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

TEST(SdfWriter, HeightsAndHolesReadBackBitForBit) {
  const Scratch scratch;
  for (const bool holes : {false, true})
    for (const int ny : {1, 6}) {
      const Surface surface = rough(9, ny, holes);
      write_surface(surface, scratch.path("a.sdf"));
      const Surface found = read_surface(scratch.path("a.sdf"));
      ASSERT_EQ(found.measured_heights().size(), surface.measured_heights().size());
      EXPECT_EQ(found.measured(), surface.measured());
      EXPECT_NEAR(found.grid().size_x / surface.grid().size_x, 1, 1e-15);
      if (ny > 1) {
        EXPECT_NEAR(found.grid().size_y / surface.grid().size_y, 1, 1e-15);
      }
      for (std::size_t k = 0; k < surface.measured_heights().size(); ++k) {
        const double was = surface.measured_heights()[k], is = found.measured_heights()[k];
        ASSERT_EQ(std::isnan(is), std::isnan(was)) << k;
        if (std::isnan(was)) continue;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(is), std::bit_cast<std::uint64_t>(was)) << k;
      }
    }
}

TEST(SdfWriter, HeaderSaysWhatItHolds) {
  const Scratch scratch;
  const Surface surface = rough(9, 6, true);
  write_surface(surface, scratch.path("a.sdf"));
  const std::string bytes = bytes_of(scratch.path("a.sdf"));
  ASSERT_EQ(bytes.size(), 81 + 8 * 54U);
  EXPECT_TRUE(bytes.starts_with("bISO-1.0"));
  EXPECT_EQ(number_at<std::uint16_t>(bytes, 42), 9);
  EXPECT_EQ(number_at<std::uint16_t>(bytes, 44), 6);
  EXPECT_EQ(number_at<double>(bytes, 46), surface.grid().hx());
  EXPECT_EQ(number_at<double>(bytes, 54), surface.grid().hy());
  EXPECT_EQ(number_at<double>(bytes, 62), 1);
  EXPECT_LT(number_at<double>(bytes, 70), 0);
  EXPECT_EQ(bytes[78], 0);
  EXPECT_EQ(bytes[79], 7);
  EXPECT_EQ(bytes[80], 0);
  EXPECT_EQ(number_at<double>(bytes, 81 + 8 * 10), surface.measured_heights()(1, 1));
  EXPECT_TRUE(std::isnan(number_at<double>(bytes, 81 + 8 * 2)));
  write_surface(surface, scratch.path("b.sdf"));
  EXPECT_EQ(bytes_of(scratch.path("b.sdf")), bytes);
}

TEST(SdfWriter, MoreThan65535PointsASideAreRefused) {
  const Scratch scratch;
  const std::string path = scratch.path("a.sdf");
  EXPECT_EQ(message_of([&] {
              write_surface(Surface(Grid{65536, 1, 1, 1}, Field(65536, 1)), path);
            }),
            "\"" + path +
                "\" cannot be written: SDF counts 65535 points a side, and the surface has 65536 x 1; write "
                ".x3p, .h5 or .npy");
  EXPECT_EQ(scratch.entries(), 0U);
}

}  // namespace
}  // namespace asperity::sdf_writer_test

// SPDX-License-Identifier: GPL-3.0-or-later

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/surface/io/hdf5_reader/binary_cursor.hpp"
#include "engine/surface/io/read.hpp"
#include "engine/surface/io/write.hpp"
#include "tests/support/warnings.hpp"
#include "tests/surface/files.hpp"

namespace asperity::sur_writer_test {
namespace {

using testing::bytes_of;
using testing::message_of;
using testing::Scratch;

Surface rough(double unit, double offset, bool holes, int nx = 9, int ny = 6) {
  const Stream stream(17, "heights");
  Field heights(nx, ny);
  for (std::size_t k = 0; k < heights.size(); ++k)
    heights[k] = holes && stream.below(1000 + k, 4) == 0 ? std::numeric_limits<double>::quiet_NaN()
                                                         : offset + unit * stream.normal(k);
  return Surface::with_holes(make_grid(nx, ny, 3.1e-4, 1.7e-4), std::move(heights));
}

Surface back(const Scratch& scratch, const Surface& surface) {
  write_surface(surface, scratch.path("a.sur"));
  return read_surface(scratch.path("a.sur"));
}

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
  return little_endian<T>(bytes.data() + at);
}

// m; stated in mm.
double step_of(const std::string& bytes) { return static_cast<double>(number_at<float>(bytes, 128)) * 1e-3; }

TEST(SurWriter, HeightsReadBackWithinHalfAStepAndHolesExactly) {
  const Scratch scratch;
  for (const double unit : {1e-10, 1e-6, 1e-3, 2.0})
    for (const double share : {0.0, 3.0, -500.0, 1e6})
      for (const bool holes : {false, true}) {
        const Surface surface = rough(unit, share * unit, holes), found = back(scratch, surface);
        const double step = step_of(bytes_of(scratch.path("a.sur")));
        // The step is fine at any offset.
        EXPECT_LT(step, unit * 1e-6) << unit << ", " << share;
        EXPECT_EQ(found.measured(), surface.measured());
        EXPECT_EQ(found.grid().nx, surface.grid().nx);
        EXPECT_NEAR(found.grid().size_x / surface.grid().size_x, 1, 1e-7);
        EXPECT_NEAR(found.grid().size_y / surface.grid().size_y, 1, 1e-7);
        const double rounding = 8 * std::numeric_limits<double>::epsilon() * (std::abs(share) + 8) * unit;
        for (std::size_t k = 0; k < found.measured_heights().size(); ++k) {
          const double was = surface.measured_heights()[k], is = found.measured_heights()[k];
          ASSERT_EQ(std::isnan(is), std::isnan(was)) << k;
          if (std::isnan(is)) continue;
          ASSERT_LE(std::abs(is - was), 0.5 * step + rounding) << k << ", " << unit;
        }
      }
}

// The spacing is stored in single precision: its rounding is no contradiction.
TEST(SurWriter, TheSizeThatWasWrittenIsNotWarnedOf) {
  const Scratch scratch;
  const Surface surface = rough(1e-6, 0, false);
  write_surface(surface, scratch.path("a.sur"));
  for (const double factor : {1.0, 1.001}) {
    ReadOptions options;
    options.size_x = factor * surface.grid().size_x;
    options.size_y = surface.grid().size_y;
    test::Warnings warnings;
    EXPECT_EQ(read_surface(scratch.path("a.sur"), options, warnings).grid().size_x, *options.size_x);
    EXPECT_EQ(warnings.told("of the call is used"), factor != 1) << factor;
  }
}

TEST(SurWriter, FirstLineComesFirst) {
  const Scratch scratch;
  Field heights(3, 2);
  for (std::size_t k = 0; k < 6; ++k) heights[k] = 1e-6 * static_cast<double>(k);
  const Surface found = back(scratch, Surface(make_grid(3, 2, 3e-6, 4e-6), std::move(heights)));
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found.height(i, j), 1e-6 * (i + 3 * j), 1e-14) << i << ", " << j;
}

// Offsets from the format's description.
TEST(SurWriter, HeaderSaysWhatItHolds) {
  const Scratch scratch;
  const Surface holed = rough(1e-6, 0, true), whole = rough(1e-6, 0, false);
  for (const Surface& surface : {holed, whole}) {
    write_surface(surface, scratch.path("a.sur"));
    const std::string bytes = bytes_of(scratch.path("a.sur"));
    EXPECT_TRUE(bytes.starts_with("DIGITAL SURF"));
    EXPECT_EQ(number_at<std::int16_t>(bytes, 12), 0);
    EXPECT_EQ(number_at<std::int16_t>(bytes, 18), 2);
    EXPECT_EQ(number_at<std::int16_t>(bytes, 86), surface.complete() ? 0 : 1);
    EXPECT_EQ(number_at<std::int16_t>(bytes, 98), 32);
    EXPECT_EQ(number_at<std::int32_t>(bytes, 108), 9);
    EXPECT_EQ(number_at<std::int32_t>(bytes, 112), 6);
    EXPECT_EQ(number_at<std::int32_t>(bytes, 116), 54);
    const auto comment = static_cast<std::size_t>(number_at<std::uint16_t>(bytes, 334));
    EXPECT_EQ(bytes.size(), 512 + comment + 4 * 54);
    EXPECT_TRUE(bytes.substr(512, comment).starts_with("Heights are rounded to steps of "));
    EXPECT_EQ(bytes.substr(512, comment).find("points were not measured") != std::string::npos,
              !surface.complete());
    // Missing points: two below the least number.
    std::int32_t least = std::numeric_limits<std::int32_t>::max(), most = -least;
    std::size_t missing = 0;
    for (std::size_t k = 0; k < 54; ++k) {
      const auto value = number_at<std::int32_t>(bytes, 512 + comment + 4 * k);
      if (std::isnan(surface.measured_heights()[9 * (5 - k / 9) + k % 9])) {  // the top line first
        EXPECT_EQ(value, number_at<std::int32_t>(bytes, 100) - 2);
        ++missing;
      } else {
        least = std::min(least, value);
        most = std::max(most, value);
      }
    }
    EXPECT_EQ(missing, 54 - surface.measured());
    EXPECT_EQ(number_at<std::int32_t>(bytes, 100), least);
    EXPECT_EQ(number_at<std::int32_t>(bytes, 104), most);
  }
}

TEST(SurWriter, FlatsAndSinglePoints) {
  const Scratch scratch;
  for (const double height : {0.0, 1e-6, -2.5e-3, 1e-300}) {
    Field heights(4, 3, height);
    const Surface found = back(scratch, Surface(make_grid(4, 3, 1e-3, 1e-3), heights));
    EXPECT_NEAR(found.height(0, 0), height, 1e-7 * std::abs(height) * 1e-7 + 1e-40);
    EXPECT_EQ(found.peak_to_valley(), 0);
    for (std::size_t k = 1; k < heights.size(); ++k) heights[k] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(back(scratch, Surface::with_holes(make_grid(4, 3, 1e-3, 1e-3), heights)).measured(), 1U);
  }
}

TEST(SurWriter, WhatSinglePrecisionDoesNotHoldIsRefused) {
  const Scratch scratch;
  EXPECT_EQ(
      message_of([&] {
        write_surface(Surface(make_grid(2, 1, 1e-3, 1e-3), Field(2, 1, 1e300)), scratch.path("a.sur"));
      }),
      "\"" + scratch.path("a.sur") +
          "\" cannot be written: its height of 1e+303 mm is more than a SUR file holds; write .x3p, .h5 "
          "or .npy");
  EXPECT_NE(message_of([&] {
              write_surface(Surface(make_grid(2, 2, 1e100, 1e-3), Field(2, 2)), scratch.path("a.sur"));
            }).find("its spacing of 5e+102 mm is more than a SUR file holds"),
            std::string::npos);
  EXPECT_EQ(scratch.entries(), 0U);
}

}  // namespace
}  // namespace asperity::sur_writer_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/optical_files.hpp"

namespace asperity::metropro_test {
namespace {

using testing::message_of;
using testing::MetroProExample;

const std::vector<std::int32_t> six{4096, -8192, 3, 4, 2147483640, 6};

Surface read(const std::string& bytes, HoleFill fill = {}) {
  ReadOptions options;
  options.fill = fill;
  return read_surface(SourceFile("a.dat", bytes), options);
}
std::string refusal(const MetroProExample& example) {
  return message_of([&] { read(example(six)); });
}

TEST(MetroPro, PhasesAreHalfWavelengths) {
  const Surface s = read(MetroProExample{}(six));
  const double wavelength = static_cast<double>(512e-9F), spacing = static_cast<double>(1e-6F);
  EXPECT_EQ(s.grid(), (Grid{3, 2, spacing * 3, spacing * 2}));
  EXPECT_EQ(s.height(0, 1), wavelength / 2);
  EXPECT_EQ(s.height(1, 1), -wavelength);
  EXPECT_EQ(s.height(0, 0), 4 * (0.5 * wavelength / 4096));
  EXPECT_TRUE(std::isnan(s.height(1, 0)));
  EXPECT_EQ(s.measured(), 5U);
}

TEST(MetroPro, ResolutionInversionAndTheLongHeader) {
  const double wavelength = static_cast<double>(512e-9F);
  EXPECT_EQ(read(MetroProExample{.resolution = 1}(six)).height(0, 1), wavelength / 16);
  EXPECT_EQ(read(MetroProExample{.resolution = 2}(six)).height(0, 1), wavelength / 64);
  EXPECT_EQ(read(MetroProExample{.inverted = 1}(six)).height(0, 1), -wavelength / 2);
  EXPECT_TRUE(std::isnan(read(MetroProExample{.inverted = 1}(six)).height(1, 0)));
  EXPECT_EQ(read(MetroProExample{.scale = -0.5F}(six)).height(0, 1), -wavelength / 2);
  EXPECT_EQ(read(MetroProExample{.mark = "\x88\x1B\x03\x71", .version = 3, .header = 4096}(six)).height(0, 1),
            wavelength / 2);
}

TEST(MetroPro, WithoutLateralResolutionTheSizeIsAskedFor) {
  EXPECT_EQ(refusal({.spacing = 0}), "\"a.dat\" does not say its size; give `size` in the call");
}

TEST(MetroPro, EachFaultIsSaid) {
  EXPECT_EQ(refusal({.header = 900}),
            "\"a.dat\" says that its header has 900 bytes; headers of 834 and 4096 bytes are read");
  EXPECT_EQ(refusal({.picture_nx = 3}),
            "\"a.dat\" says that its intensities have 4 bytes, and 1 of 3 x 1 take 6");
  EXPECT_EQ(refusal({.nx = 0}),
            "\"a.dat\" holds no phases, so it has no heights; save the measurement with its phase data");
  EXPECT_NE(refusal({.nx = 2}).find("24 bytes of data, 8 too many"), std::string::npos);
  EXPECT_NE(refusal({.nx = 4}).find("4 x 2 heights of 4 bytes but has 24 bytes"), std::string::npos);
  EXPECT_EQ(refusal({.resolution = 3}),
            "\"a.dat\" gives 3 as the resolution of its phases; 0, 1 and 2 are known");
  EXPECT_NE(refusal({.wavelength = 0}).find("wavelength 0 m"), std::string::npos);
  EXPECT_NE(refusal({.wavelength = INFINITY}).find("wavelength inf m"), std::string::npos);
  EXPECT_EQ(refusal({.spacing = -1}), "\"a.dat\" gives -1 m as the distance of its points");
  EXPECT_EQ(message_of([] { read("\x88\x1B\x03\x6F"); }),
            "\"a.dat\" is cut short in its header of 834 bytes");
  ReadOptions options;
  options.format = "metropro";
  EXPECT_NE(message_of([&] {
              read_surface(SourceFile("a.txt", "1 2"), options);
            }).find("lacks the mark of the format `metropro`"),
            std::string::npos);
}

TEST(MetroPro, DamageIsAnErrorOrAnotherSurface) {
  testing::damage(MetroProExample{}(six), 43, 3000,
                  [](const std::string& bytes) { read(bytes, HoleFill::interpolate()); });
}

}  // namespace
}  // namespace asperity::metropro_test

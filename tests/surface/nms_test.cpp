// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/optical_files.hpp"

namespace asperity::nms_test {
namespace {

using testing::message_of;
using testing::NmsExample;

const std::vector<std::uint16_t> six{0, 65535, 3, 4, 5, 6};

Surface read(const std::string& bytes, HoleFill fill = {}) {
  ReadOptions options;
  options.fill = fill;
  return read_surface(SourceFile("a", bytes), options);
}
std::string refusal(const NmsExample& example) {
  return message_of([&] { read(example(six)); });
}

TEST(Nms, IntegersRunFromTheLeastHeightToTheGreatest) {
  const Surface s = read(NmsExample{}(six));
  EXPECT_EQ(s.grid(), (Grid{3, 2, 100 * 1e-9 * 3, 200 * 1e-9 * 2}));
  EXPECT_EQ(s.height(0, 1), -1e-6);
  EXPECT_EQ(s.height(1, 1), 1e-6);
  EXPECT_EQ(s.height(0, 0), (-1 + 4 * (2.0 / 65535)) * 1e-6);
  EXPECT_EQ(s.measured(), 6U);
  const Surface other = read(NmsExample{.first = 1, .last = 5, .picture = false}(six));
  EXPECT_EQ(other.height(1, 0), 1e-6);
}

TEST(Nms, EachFaultIsSaid) {
  EXPECT_NE(refusal({.header = 5}).find("its header has 5 bytes"), std::string::npos);
  EXPECT_NE(refusal({.header = 4000000000}).find("its header has 4000000000 bytes"), std::string::npos);
  EXPECT_EQ(refusal({.width = 4}), "\"a\" holds heights of 4 bytes; integers of 2 bytes are read");
  EXPECT_EQ(refusal({.first = 9, .last = 9}), "\"a\" says that its integers run from 9 to 9");
  EXPECT_EQ(refusal({.low = 2}), "\"a\" says that its heights run from 2 um to 1 um");
  EXPECT_EQ(refusal({.high = NAN}), "\"a\" says that its heights run from -1 um to nan um");
  EXPECT_EQ(refusal({.dx = -1}), "\"a\" gives -1 nm as the distance of its points");
  EXPECT_NE(refusal({.nx = 2}).find("has 18 bytes after its header, where 2 x 2 heights take 8"),
            std::string::npos);
  EXPECT_NE(refusal({.nx = 400}).find("400 x 2 heights of 2 bytes but has 18 bytes"), std::string::npos);
  EXPECT_NE(refusal({.nx = 0}).find("0 x 2 heights"), std::string::npos);
}

TEST(Nms, DamageIsAnErrorOrAnotherSurface) {
  testing::damage(NmsExample{}(six), 59, 3000,
                  [](const std::string& bytes) { read(bytes, HoleFill::interpolate()); });
}

}  // namespace
}  // namespace asperity::nms_test

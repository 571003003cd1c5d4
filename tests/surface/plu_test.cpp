// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "engine/core/files/source_file.hpp"
#include "engine/surface/io/read.hpp"
#include "tests/support/warnings.hpp"
#include "tests/surface/files.hpp"
#include "tests/surface/optical_files.hpp"

namespace asperity::plu_test {
namespace {

using testing::message_of;
using testing::PluExample;

const std::vector<float> six{1, -2, 3, 4, 1000001, 6};

Surface read(const std::string& bytes, HoleFill fill = {}) {
  ReadOptions options;
  options.fill = fill;
  return read_surface(SourceFile("a", bytes), options);
}
std::string refusal(const PluExample& example) {
  return message_of([&] { read(example(six)); });
}

TEST(Plu, HeightsAreMicrometresLineByLine) {
  const Surface s = read(PluExample{}(six));
  EXPECT_EQ(s.grid(), (Grid{3, 2, 2 * 1e-6 * 3, 4 * 1e-6 * 2}));
  EXPECT_EQ(s.height(1, 1), -2e-6);
  EXPECT_EQ(s.height(0, 0), 4 * 1e-6);
  EXPECT_TRUE(std::isnan(s.height(1, 0)));
  EXPECT_EQ(s.measured(), 5U);
}

TEST(Plu, OfSeveralLayersTheFirstIsRead) {
  test::Warnings warnings;
  EXPECT_EQ(read_surface(SourceFile("a.plu", PluExample{.layers = 2}(six)), {}, warnings).height(2, 0), 6e-6);
  ASSERT_EQ(warnings.all.size(), 1U);
  EXPECT_EQ(warnings.all[0], "\"a.plu\" holds 2 layers; the first is read");
}

TEST(Plu, EachFaultIsSaid) {
  EXPECT_EQ(refusal({.type = 1}),
            "\"a\" holds a measurement of type 1, which is no topography; topographies are read: type 3");
  EXPECT_EQ(refusal({.layer_nx = 2}),
            "\"a\" holds 3 x 2 points by its header and by its first layer 2 x 2; its header is "
            "wrong or the file is damaged");
  EXPECT_NE(refusal({.nx = 70000, .layer_nx = 70000}).find("70000 x 2 heights of 4 bytes but has 32 bytes"),
            std::string::npos);
  EXPECT_NE(refusal({.nx = 0, .layer_nx = 0}).find("0 x 2 heights"), std::string::npos);
  EXPECT_EQ(refusal({.dx = 0}), "\"a\" gives 0 um as the distance of its points");
  EXPECT_EQ(refusal({.dy = NAN}), "\"a\" gives nan um as the distance of its points");
  EXPECT_NE(refusal({.date = "Fri Mar 10 16:35:59 23"}).find("is of no known format"), std::string::npos);
  EXPECT_NE(message_of([] { read(PluExample{}(six).substr(0, 506)); }).find("cut short in its header"),
            std::string::npos);
}

TEST(Plu, DamageIsAnErrorOrAnotherSurface) {
  testing::damage(PluExample{}(six), 47, 3000,
                  [](const std::string& bytes) { read(bytes, HoleFill::interpolate()); });
}

}  // namespace
}  // namespace asperity::plu_test

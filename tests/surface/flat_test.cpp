// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/surface/generators/sphere.hpp"

#include <gtest/gtest.h>

#include "engine/core/error.hpp"

namespace asperity::flat_test {
namespace {

TEST(Flat, IsZeroEverywhereAndPeriodic) {
  for (const Grid& grid : {Grid{1, 1, 1, 1}, Grid{1, 7, 1e-6, 2e-6}, Grid{13, 5, 1e-3, 1e-3}}) {
    const Surface surface = flat_surface({grid});
    EXPECT_EQ(surface.grid(), grid);
    for (const double z : surface.heights().values()) EXPECT_EQ(z, 0.0);
    EXPECT_TRUE(surface.traits().periodic);
  }
}

TEST(Flat, RefusesWhatIsNoGrid) {
  EXPECT_THROW(flat_surface({Grid{0, 4, 1, 1}}), Error);
  EXPECT_THROW(flat_surface({Grid{4, 4, 0, 1}}), Error);
}

}  // namespace
}  // namespace asperity::flat_test

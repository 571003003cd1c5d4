// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/slabs/team.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "engine/core/monitor.hpp"
#include "engine/core/slabs/row_exchange.hpp"

namespace asperity::team_test {
namespace {

TEST(Slab, DealsOutEveryRowOnce) {
  for (const int ny : {1, 2, 7, 10, 64})
    for (const int ranks : {1, 2, 3, 5, 12}) {
      int next = 0;
      for (int r = 0; r < ranks; ++r) {
        const Slab slab{4, ny, r, ranks};
        EXPECT_EQ(slab.first(), next);
        for (int j = 0; j < slab.rows(); ++j) EXPECT_EQ(slab.owner(slab.first() + j), r);
        next += slab.rows();
      }
      EXPECT_EQ(next, ny);
    }
}

TEST(Team, OfOneAddsNothing) {
  const auto total = Team::alone().reduce<1, 2>({1.5, -2, std::numeric_limits<double>::infinity()});
  EXPECT_EQ(total, (std::array<double, 3>{1.5, -2, std::numeric_limits<double>::infinity()}));
  EXPECT_EQ(Team::alone().text_of_first("a path"), "a path");
}

TEST(Team, KeepsAFailureUntilAllAgree) {
  Team& team = Team::alone();
  bool after = false;
  team.work([] { throw Error(ErrorCode::bad_file, "this is wrong", "that is right"); });
  team.work([&] { after = true; });
  EXPECT_FALSE(after);
  try {
    team.agree();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_file);
    EXPECT_EQ(error.sentence(), "this is wrong");
    EXPECT_EQ(error.hint(), "that is right");
  }
  team.work([&] { after = true; });
  team.agree();
  EXPECT_TRUE(after);
}

TEST(Team, StopsAtTheNextSum) {
  stop_flag().raise(StopReason::interrupt);
  EXPECT_THROW(Team::alone().agree(), Error);
  stop_flag().clear();
  EXPECT_NO_THROW(Team::alone().agree());
}

TEST(RowExchange, HandsRowsOverInTheOrderOfTheNeed) {
  Team& team = Team::alone();
  const Slab slab = team.slab(2, 3);
  const double field[] = {0, 1, 10, 11, 20, 21};
  std::vector<double> found;
  RowExchange rows(team, slab, [](int) { return std::vector<int>{2, 0, 2}; });
  rows.run([&](int j, double* to) { std::copy_n(field + 2 * j, 2, to); },
           [&](std::size_t, const double* row) { found.insert(found.end(), row, row + 2); });
  EXPECT_EQ(found, (std::vector<double>{20, 21, 0, 1, 20, 21}));
  EXPECT_EQ(rim_rows(team, slab, 4).needed(), 8u);
}

TEST(SlabFourier, AloneGoesThereAndBack) {
  for (const auto& [nx, ny] : {std::pair(6, 4), std::pair(5, 3), std::pair(1, 7)}) {
    const auto fourier = Team::alone().fourier(nx, ny);
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) fourier->row(j)[i] = i == 1 % nx && j == 0 ? 1 : 0;
    fourier->forward();
    EXPECT_EQ(fourier->waves(), nx / 2 + 1);
    for (int a = 0; a < fourier->waves(); ++a)
      for (int b = 0; b < ny; ++b) EXPECT_NEAR(std::abs(fourier->bin(a, b)), 1, 1e-15);
    fourier->inverse();
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        EXPECT_NEAR(fourier->row(j)[i], i == 1 % nx && j == 0 ? nx * ny : 0, 1e-13);
  }
}

}  // namespace
}  // namespace asperity::team_test

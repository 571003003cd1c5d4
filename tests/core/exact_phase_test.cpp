// SPDX-License-Identifier: GPL-3.0-or-later
// Increments of geometric plane waves against a 420-bit reference and exact identities.
#include "engine/core/exact_phase.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "engine/core/error.hpp"
#include "tests/support/refusal.hpp"

namespace asperity::exact_phase_test {
namespace {

constexpr std::uint64_t half_turn = std::uint64_t{1} << 63;

std::string refusal(double gamma, double span, int cells, int directions, int n_max) {
  return test::refusal([&] { phase_increments(gamma, span, cells, directions, n_max); });
}

TEST(PhaseIncrements, AreThoseOfTheReferenceTable) {
  std::ifstream file(ASPERITY_TEST_DATA "/wm_increments.csv");
  ASSERT_TRUE(file);
  const PhaseIncrements one = phase_increments(1.5, 1, 150, 10, 100);
  const PhaseIncrements three = phase_increments(1.5, 3, 150, 10, 100);
  std::string line;
  int rows = 0;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#' || line[0] == 's') continue;
    std::istringstream in(line);
    std::string span, m, n, x, y;
    std::getline(in, span, ',');
    std::getline(in, m, ',');
    std::getline(in, n, ',');
    std::getline(in, x, ',');
    std::getline(in, y, ',');
    const PhaseIncrements& table = span == "1" ? one : three;
    const std::size_t k = table.index(std::stoi(m), std::stoi(n));
    EXPECT_EQ(table.x[k], std::stoull(x, nullptr, 16)) << line;
    EXPECT_EQ(table.y[k], std::stoull(y, nullptr, 16)) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 12);
}

// 1.5ⁿ/2ᵏ is rational: integers give one axis modulo 1.
TEST(PhaseIncrements, FollowPowersOfThreeHalvesInWholeNumbers) {
  constexpr int n_max = 100;
  const PhaseIncrements table = phase_increments(1.5, 1, 1, 1, n_max);
  // frac(3ⁿ/2ⁿ)·2⁶⁴ = (3ⁿ mod 2ⁿ)·2^(64−n): exact up to n = 64.
  __extension__ using Wide = unsigned __int128;
  Wide power = 1;
  for (int n = 0; n <= 64; ++n) {
    const Wide fraction = n == 0 ? 0 : power % (Wide{1} << n);
    const auto turns = static_cast<std::uint64_t>(fraction << (64 - n));
    EXPECT_EQ(table.x[table.index(1, n)], 0 - turns) << n;  // direction π: the negative x axis
    EXPECT_EQ(table.y[table.index(1, n)], 0u) << n;
    power *= 3;
  }
}

TEST(PhaseIncrements, RoundHalvesUpwards) {
  // γ = 3/2, n = 65: 3⁶⁵/2⁶⁵ turns is an odd multiple of 2⁻⁶⁵; direction π/3 halves 3⁶⁴/2⁶⁴ alike.
  const PhaseIncrements table = phase_increments(1.5, 1, 1, 3, 64);
  __extension__ using Wide = unsigned __int128;
  Wide power = 1;
  for (int n = 0; n < 64; ++n) power *= 3;
  const auto odd = static_cast<std::uint64_t>(power);  // 3⁶⁴ modulo 2⁶⁴; u·2⁶⁴ = 3⁶⁴/2 ends in ½
  const auto floor_of_half = static_cast<std::uint64_t>(power >> 1);
  ASSERT_EQ(odd % 2, 1u);
  EXPECT_EQ(table.x[table.index(1, 64)], floor_of_half + 1);  // +u rounds up
  EXPECT_EQ(table.x[table.index(2, 64)], 0 - floor_of_half);  // −u rounds up too
}

TEST(PhaseIncrements, OfMirroredDirectionsAreOpposite) {
  for (const int directions : {2, 7, 10, 12}) {
    const PhaseIncrements table = phase_increments(1.37, 0.37, 97, directions, 200);
    for (int n = 0; n <= table.n_max; ++n) {
      for (int m = 1; m < directions; ++m) {
        EXPECT_EQ(table.x[table.index(m, n)], 0 - table.x[table.index(directions - m, n)]);
        EXPECT_EQ(table.y[table.index(m, n)], table.y[table.index(directions - m, n)]);
      }
      EXPECT_EQ(table.y[table.index(directions, n)], 0u);
      if (directions % 2 == 0) {
        EXPECT_EQ(table.x[table.index(directions / 2, n)], 0u);
      }
    }
  }
}

TEST(PhaseIncrements, AgreeWithDoublesWhereThoseSuffice) {
  const PhaseIncrements table = phase_increments(1.5, 3, 150, 10, 20);
  for (int n = 0; n <= 20; ++n) {
    for (int m = 1; m <= 10; ++m) {
      const double step = std::pow(1.5, n) * 3 / 150;
      for (const bool along_x : {true, false}) {
        const double angle = std::numbers::pi * m / 10;
        const double turns = step * (along_x ? std::cos(angle) : std::sin(angle));
        const std::uint64_t found = (along_x ? table.x : table.y)[table.index(m, n)];
        const double difference = static_cast<double>(found) * 0x1p-64 - turns;
        EXPECT_NEAR(difference, std::round(difference), 1e-12) << m << " " << n;
      }
    }
  }
}

TEST(PhaseIncrements, GrowBeyondAnyDouble) {
  const PhaseIncrements table = phase_increments(2, 1, 1000, 10, 2048);
  // 2ⁿ/1000 = 2^(n−3)/125, and 2¹⁰⁰ ≡ 1 modulo 125: period of 100 orders.
  for (int n = 103; n <= 2048; ++n)
    EXPECT_EQ(table.x[table.index(10, n)], table.x[table.index(10, n - 100)]) << n;
  EXPECT_NE(table.x[table.index(10, 2048)], 0u);
}

TEST(PhaseIncrements, KnowTheLastOrderWithinNyquist) {
  EXPECT_EQ(phase_increments(1.5, 1, 150, 10, 100).last_resolved, 10);
  EXPECT_EQ(phase_increments(1.5, 3, 150, 10, 100).last_resolved, 7);
  EXPECT_EQ(phase_increments(1.5, 1, 150, 10, 4).last_resolved, 4);
  EXPECT_EQ(phase_increments(1.5, 1, 1, 10, 100).last_resolved, -1);
  // 2⁵/64 is exactly half a turn, the limit of a grid.
  EXPECT_EQ(phase_increments(2, 1, 64, 1, 20).last_resolved, 5);
  EXPECT_EQ(phase_increments(2, std::nextafter(1.0, 2.0), 64, 1, 20).last_resolved, 4);
}

TEST(PhaseIncrements, TakeRatiosNextToOne) {
  const double gamma = std::nextafter(1.0, 2.0);
  const PhaseIncrements table = phase_increments(gamma, 1, 3, 2, 4096);
  // (1 + 2⁻⁵²)ⁿ/3 turns along −x: n·2⁻⁵²/3 above a third, in 2⁻⁶⁴.
  const std::uint64_t third = 6148914691236517205ULL;  // floor(2⁶⁴/3), rounded from .33
  EXPECT_EQ(table.x[table.index(2, 0)], 0 - third);
  EXPECT_EQ(table.x[table.index(2, 3)], 0 - (third + 4096));
  EXPECT_EQ(table.x[table.index(2, 3000)], 0 - (third + 4096 * 1000));
}

TEST(PhaseIncrements, AcceptTheLimitAndRefuseOneMore) {
  EXPECT_EQ(greatest_wave_order(2), 2048);
  EXPECT_EQ(greatest_wave_order(1.5), 3501);
  EXPECT_EQ(greatest_wave_order(std::nextafter(2.0, 3.0)), 2047);
  EXPECT_EQ(greatest_wave_order(1.01), 4096);
  EXPECT_EQ(refusal(2, 1, 10, 1, 2048), "accepted");
  EXPECT_EQ(refusal(1.01, 1, 10, 1, 4096), "accepted");
  EXPECT_EQ(
      refusal(2, 1, 10, 1, 2049),
      "`n_max` is 2049; with gamma = 2 give a whole number from 0 to 2048: n_max*log2(gamma) may not exceed "
      "2048, nor n_max 4096");
  EXPECT_EQ(
      refusal(1.01, 1, 10, 1, 4097),
      "`n_max` is 4097; with gamma = 1.01 give a whole number from 0 to 4096: n_max*log2(gamma) may not "
      "exceed 2048, nor n_max 4096");
  EXPECT_NE(refusal(1e300, 1, 10, 1, 100).find("from 0 to 2:"), std::string::npos);
  EXPECT_NE(refusal(1.5, 1, 10, 1, -1).find("`n_max` is -1;"), std::string::npos);
}

TEST(PhaseIncrements, RefuseWhatHasNoMeaning) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal(1, 1, 10, 1, 1), "`gamma` is 1; give a finite number above 1");
  EXPECT_EQ(refusal(nan, 1, 10, 1, 1), "`gamma` is nan; give a finite number above 1");
  EXPECT_EQ(refusal(inf, 1, 10, 1, 1), "`gamma` is inf; give a finite number above 1");
  EXPECT_EQ(refusal(1.5, 0, 10, 1, 1), "`span` is 0; give a finite number above 0");
  EXPECT_EQ(refusal(1.5, inf, 10, 1, 1), "`span` is inf; give a finite number above 0");
  EXPECT_EQ(
      refusal(1.5, 1e-25, 10, 1, 1),
      "`span` is 1e-25: even the shortest wave turns less than 2^-32 times a cell; give a longer span or a "
      "larger n_max");
  EXPECT_EQ(refusal(1.5, 1, 0, 1, 1), "`cells` is 0 a side; give a whole number from 1 to 65536");
  EXPECT_EQ(refusal(1.5, 1, 65537, 1, 1), "`cells` is 65537 a side; give a whole number from 1 to 65536");
  EXPECT_EQ(refusal(1.5, 1, 10, 0, 1), "`M` is 0; give a whole number from 1 to 65536");
  EXPECT_EQ(refusal(1.5, 1, 10, 65536, 100),
            "`M` of 65536 and `n_max` of 100 make 6619136 waves; M*(n_max + 1) may be 4194304 at most");
}

TEST(PhaseIncrements, TakeHugeSpansExactly) {
  // 2²⁰⁰/3 and 2²⁰²/3 turns differ by the integer 2²⁰⁰.
  const PhaseIncrements a = phase_increments(1.5, 0x1p200, 3, 1, 0);
  const PhaseIncrements b = phase_increments(1.5, 0x1p202, 3, 1, 0);
  EXPECT_EQ(a.x[0], b.x[0]);
  EXPECT_EQ(a.x[0], 0 - 6148914691236517205ULL);
}

TEST(UnitPhase, IsExactAtQuarterTurns) {
  EXPECT_EQ(unit_phase(0).cosine, 1);
  EXPECT_EQ(unit_phase(0).sine, 0);
  EXPECT_EQ(unit_phase(half_turn / 2).cosine, 0);
  EXPECT_EQ(unit_phase(half_turn / 2).sine, 1);
  EXPECT_EQ(unit_phase(half_turn).cosine, -1);
  EXPECT_EQ(unit_phase(half_turn).sine, 0);
  EXPECT_EQ(unit_phase(half_turn + half_turn / 2).cosine, 0);
  EXPECT_EQ(unit_phase(half_turn + half_turn / 2).sine, -1);
}

TEST(UnitPhase, MatchesLongDoublesAllRoundTheCircle) {
  for (int k = 0; k < 4000; ++k) {
    const std::uint64_t turns = 0x9E3779B97F4A7C15ULL * static_cast<std::uint64_t>(k) + (k % 2 ? 0 : ~0ULL);
    const long double angle = static_cast<long double>(static_cast<std::int64_t>(turns)) * 0x1p-63L *
                              std::numbers::pi_v<long double>;
    EXPECT_NEAR(unit_phase(turns).cosine, static_cast<double>(std::cos(angle)), 2.3e-16);
    EXPECT_NEAR(unit_phase(turns).sine, static_cast<double>(std::sin(angle)), 2.3e-16);
  }
}

}  // namespace
}  // namespace asperity::exact_phase_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/metrology/stylus.hpp"

#include <cmath>
#include <set>
#include <string>

#include "engine/core/parallel.hpp"
#include "engine/metrology/roughness.hpp"
#include "engine/surface/generators/self_affine.hpp"
#include "tests/metrology/test_fields.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/self_affine.hpp"

namespace asperity::stylus_test {
namespace {

using testing::make_surface;
using testing::periodic;

Surface specimen(int cells = 128) {
  SelfAffineOptions o = test::self_affine(Grid{cells, cells, 100e-6, 100e-6}, 0.8, 5e-6);
  o.ra = 0.5e-6;
  o.roll_off = 25e-6;
  return self_affine_surface(o);
}

StylusOptions short_traces(double length = 80e-6, double tip = 2e-6) {
  StylusOptions o;
  o.length = length;
  o.tip = tip;
  return o;
}

using test::refusal;
std::string refusal(const StylusOptions& options) {
  return refusal([&] { Stylus{options}; });
}

TEST(Stylus, DefaultsAreThoseOfTheInstrument) {
  const Stylus s{StylusOptions{}};
  EXPECT_EQ(s.tip(), 2e-6);
  EXPECT_EQ(s.spacing(), 0.25e-6);
  EXPECT_EQ(s.length(), 2e-3);
  EXPECT_EQ(s.samples(), 8000);
  EXPECT_FALSE(s.speed());
  EXPECT_FALSE(s.rate());
}

TEST(Stylus, SpacingIsSpeedOverRate) {
  StylusOptions o;
  o.speed = 50e-6;
  o.rate = 100;
  EXPECT_EQ(Stylus(o).spacing(), 0.5e-6);
  o.spacing = 0.5e-6;  // consistent
  EXPECT_EQ(Stylus(o).spacing(), 0.5e-6);
  o.rate.reset();
  EXPECT_DOUBLE_EQ(*Stylus(o).rate(), 100);
  o.rate = 100;
  o.speed.reset();
  EXPECT_DOUBLE_EQ(*Stylus(o).speed(), 50e-6);
  o.spacing.reset();  // a rate alone: the usual spacing
  EXPECT_EQ(Stylus(o).spacing(), 0.25e-6);
  EXPECT_DOUBLE_EQ(*Stylus(o).speed(), 25e-6);
  o.speed = 50e-6;
  o.spacing = 0.25e-6;
  EXPECT_EQ(refusal(o),
            "`spacing` is 250 nm, and `speed`/`rate` is 500 nm; give two of the three, or three that agree");
}

TEST(Stylus, SamplesAreTheWholeSpacingsOfTheLength) {
  StylusOptions o;
  o.length = 1e-3;
  o.spacing = 0.3e-6;
  EXPECT_EQ(Stylus(o).samples(), 3333);
  o.spacing = 0.1e-6;  // 9999.999… by division
  EXPECT_EQ(Stylus(o).samples(), 10000);
  o.spacing = 0.5e-3;
  EXPECT_EQ(Stylus(o).samples(), 2);
}

TEST(Stylus, ANeedleOnAPeriodicSurfaceGivesItsSections) {
  const Surface s = specimen();
  const StylusScan scan = Stylus(short_traces(350e-6, 0)).scan(s, 6, 3);
  ASSERT_EQ(scan.traces.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    const Profile& trace = scan.traces[k];
    ASSERT_EQ(trace.size(), 1400);
    EXPECT_EQ(trace.spacing(), 0.25e-6);
    EXPECT_FALSE(trace.closed());
    const Traverse& line = scan.lines[k];
    for (int i = 0; i < trace.size(); i += 7) {
      const double way = i * 0.25e-6;
      ASSERT_EQ(trace.heights()[static_cast<std::size_t>(i)],
                height_between(s, {line.start.x + way * std::cos(line.angle),
                                   line.start.y + way * std::sin(line.angle)}));
    }
  }
  EXPECT_EQ(scan.effect.ra_ratio, 1);
  EXPECT_EQ(scan.effect.rms_slope_ratio, 1);
  EXPECT_EQ(scan.effect.amplitude_ratio, 1);
  EXPECT_EQ(scan.effect.mean_lift, 0);
  EXPECT_EQ(scan.effect.greatest_lift, 0);
}

TEST(Stylus, TracesHoldWhatTheTipFeels) {
  const Surface s = specimen();
  const StylusScan felt = Stylus(short_traces()).scan(s, 3, 5);
  const StylusScan needle = Stylus(short_traces(80e-6, 0)).scan(s, 3, 5);
  const SphericalTip tip(s, 2e-6);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(felt.lines[k].start.x, needle.lines[k].start.x);
    EXPECT_EQ(felt.lines[k].angle, needle.lines[k].angle);
    const auto t = felt.traces[k].heights(), z = needle.traces[k].heights();
    for (std::size_t i = 0; i < t.size(); ++i) ASSERT_GE(t[i], z[i]);
    EXPECT_EQ(t[0], tip.height(felt.lines[k].start));
  }
}

TEST(Stylus, TheEffectOfTheTipIsThatOfTheTraces) {
  const Surface s = specimen();
  const StylusScan felt = Stylus(short_traces(80e-6, 20e-6)).scan(s, 4, 5);
  const StylusScan needle = Stylus(short_traces(80e-6, 0)).scan(s, 4, 5);
  double ra[2] = {}, slope[2] = {}, amplitude[2] = {}, lift = 0, most = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    for (const int with : {0, 1}) {
      const Roughness r = roughness((with != 0 ? felt : needle).traces[k]);
      ra[with] += r.Ra;
      slope[with] += r.rms_slope;
      amplitude[with] += r.amplitude;
    }
    const auto t = felt.traces[k].heights(), z = needle.traces[k].heights();
    for (std::size_t i = 0; i < t.size(); ++i) {
      lift += (t[i] - z[i]) / static_cast<double>(4 * t.size());
      most = std::max(most, t[i] - z[i]);
    }
  }
  EXPECT_DOUBLE_EQ(felt.effect.ra_ratio, ra[1] / ra[0]);
  EXPECT_DOUBLE_EQ(felt.effect.rms_slope_ratio, slope[1] / slope[0]);
  EXPECT_DOUBLE_EQ(felt.effect.amplitude_ratio, amplitude[1] / amplitude[0]);
  EXPECT_NEAR(felt.effect.mean_lift, lift, 1e-12 * lift);
  EXPECT_EQ(felt.effect.greatest_lift, most);
  EXPECT_LT(felt.effect.rms_slope_ratio, 0.95);  // steep valleys are out of reach
  EXPECT_GT(lift, 0);
}

TEST(Stylus, AFlatStaysFlatAndItsRatiosOne) {
  const Surface flat = make_surface(
      8, 8, 100e-6, 100e-6, [](int, int) { return 1e-6; }, periodic());
  const StylusScan scan = Stylus(short_traces()).scan(flat, 2, 1);
  for (const double h : scan.traces[1].heights()) EXPECT_EQ(h, 1e-6);
  EXPECT_EQ(scan.effect.ra_ratio, 1);
  EXPECT_EQ(scan.effect.rms_slope_ratio, 1);
  EXPECT_EQ(scan.effect.mean_lift, 0);
}

TEST(Stylus, LinesAreKeyedBySeedAndNumber) {
  const Surface s = specimen(64);
  const Stylus stylus(short_traces());
  const auto five = stylus.lines(s, 5, 1), nine = stylus.lines(s, 9, 1), other = stylus.lines(s, 5, 2);
  const auto finer = stylus.lines(specimen(128), 5, 1);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(five[k].start.x, nine[k].start.x);
    EXPECT_EQ(five[k].angle, nine[k].angle);
    EXPECT_EQ(five[k].start.y, finer[k].start.y);
    EXPECT_NE(five[k].angle, other[k].angle);
  }
}

TEST(Stylus, PlacesAndAnglesAreUniformOnAPeriodicSurface) {
  const auto lines = Stylus(short_traces()).lines(specimen(64), 20000, 4);
  double x = 0, y = 0, cosine = 0, sine = 0;
  for (const Traverse& line : lines) {
    EXPECT_TRUE(line.start.x >= 0 && line.start.x < 100e-6 && line.start.y >= 0 && line.start.y < 100e-6);
    x += line.start.x / 100e-6 / 20000;
    y += line.start.y / 100e-6 / 20000;
    cosine += std::cos(2 * line.angle) / 20000;
    sine += std::sin(line.angle) / 20000;
  }
  // Five standard deviations of the means.
  EXPECT_NEAR(x, 0.5, 5 * 0.289 / std::sqrt(20000.0));
  EXPECT_NEAR(y, 0.5, 5 * 0.289 / std::sqrt(20000.0));
  EXPECT_NEAR(cosine, 0, 5 * 0.707 / std::sqrt(20000.0));
  EXPECT_NEAR(sine, 0, 5 * 0.707 / std::sqrt(20000.0));
}

TEST(Stylus, LinesStayInsideASurfaceWithARim) {
  // Nodes over 96 x 45 µm: 100 µm fits only near the diagonal, 30 µm at any angle.
  const Surface s = make_surface(33, 16, 99e-6, 48e-6, [](int i, int j) { return 1e-9 * i * j; });
  for (const double length : {30e-6, 60e-6, 100e-6, 106e-6}) {
    const Stylus stylus(short_traces(length));
    const double travel = (stylus.samples() - 1) * 0.25e-6;
    std::set<int> quarters;
    for (const Traverse& line : stylus.lines(s, 400, 2)) {
      const double ex = line.start.x + travel * std::cos(line.angle);
      const double ey = line.start.y + travel * std::sin(line.angle);
      for (const double x : {line.start.x, ex}) EXPECT_TRUE(x >= -1e-18 && x <= 96e-6 + 1e-18) << x;
      for (const double y : {line.start.y, ey}) EXPECT_TRUE(y >= -1e-18 && y <= 45e-6 + 1e-18) << y;
      quarters.insert((std::cos(line.angle) > 0 ? 1 : 0) + (std::sin(line.angle) > 0 ? 2 : 0));
    }
    EXPECT_EQ(quarters.size(), 4u);
  }
  EXPECT_EQ(refusal([&] { Stylus(short_traces(110e-6)).scan(s, 1, 1); }),
            "a trace of `length` 110 um does not fit on a surface that is not periodic, with nodes over 96 "
            "um x 45 um"
            "; give a `length` of at most 106 um, its diagonal");
  const Surface node = make_surface(1, 1, 1e-3, 1e-3, [](int, int) { return 0.0; });
  EXPECT_EQ(
      refusal([&] { Stylus(short_traces()).scan(node, 1, 1); }),
      "a trace of `length` 80 um does not fit on a surface that is not periodic, with nodes over 0 m x 0 m; "
      "give a larger surface");
}

TEST(Stylus, ALineMayBeTheDiagonalOrASingleRow) {
  StylusOptions o = short_traces(5.25e-6);
  const Surface square = make_surface(4, 5, 4e-6, 5e-6, [](int, int) { return 0.0; });  // nodes 3 x 4 µm
  for (const Traverse& line : Stylus(o).lines(square, 20, 1))
    EXPECT_NEAR(std::abs(std::tan(line.angle)), 4.0 / 3, 1e-6);
  const Surface row = make_surface(11, 1, 11e-6, 1e-6, [](int i, int) { return 1e-7 * i; });
  for (const Profile& trace : Stylus(o).scan(row, 4, 1).traces)
    EXPECT_NEAR(std::abs(trace.heights()[4] - trace.heights()[3]), 0.25e-7, 1e-17);
}

TEST(Stylus, SameBitsForAnyNumberOfThreads) {
  const Surface s = specimen();
  const Stylus stylus(short_traces(600e-6));
  set_thread_count(1);
  const StylusScan one = stylus.scan(s, 2, 1);
  set_thread_count(3);
  const StylusScan three = stylus.scan(s, 2, 1);
  set_thread_count(2);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(one.traces[k].digest(), three.traces[k].digest());
  EXPECT_EQ(one.effect.ra_ratio, three.effect.ra_ratio);
  EXPECT_EQ(one.effect.mean_lift, three.effect.mean_lift);
}

TEST(Stylus, EqualDigestsForEqualInstruments) {
  EXPECT_EQ(Stylus(short_traces()).digest(), Stylus(short_traces()).digest());
  EXPECT_NE(Stylus(short_traces()).digest(), Stylus(short_traces(80e-6, 2.0000001e-6)).digest());
}

TEST(Stylus, RefusesWhatIsNoInstrument) {
  EXPECT_EQ(refusal(short_traces(80e-6, -1e-6)), "`tip` is -1e-06 m; give a finite radius of 0 or more");
  EXPECT_EQ(refusal(short_traces(0)), "`length` is 0; give a finite value above zero");
  EXPECT_EQ(refusal(short_traces(0.49e-6)),
            "`length` is 490 nm and `spacing` 250 nm; give a length of at least two spacings, 500 nm");
  EXPECT_EQ(refusal(short_traces(0.5e-6)), "accepted");
  EXPECT_EQ(
      refusal(short_traces(10)),
      "a trace of 10 m with a sample every 250 nm has 4e+07 samples; give a shorter `length` or a wider "
      "`spacing`: at most 16777216 samples");
  StylusOptions o;
  o.speed = 0;
  EXPECT_EQ(refusal(o), "`speed` is 0; give a finite value above zero");
  o.speed = 1e-300;
  o.rate = 1e300;
  EXPECT_EQ(refusal(o), "`speed`/`rate` is 0 m; give a speed and a rate that make a spacing");
  const Stylus stylus(short_traces());
  EXPECT_EQ(refusal([&] { stylus.lines(specimen(64), 0, 1); }),
            "`count` is 0; give a whole number from 1 to 100000");
  EXPECT_EQ(refusal([&] { stylus.lines(specimen(64), 100001, 1); }),
            "`count` is 100001; give a whole number from 1 to 100000");
}

}  // namespace
}  // namespace asperity::stylus_test

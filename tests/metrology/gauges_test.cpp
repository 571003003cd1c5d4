// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of kind `cells` of tests/reference/metrology_gauges.csv, on which two independent programs agree,
// within 1e-9. Unknown parameters fail.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "engine/core/error.hpp"
#include "engine/metrology/parameters/areal_parameters.hpp"
#include "engine/metrology/parameters/profile_parameters.hpp"

namespace asperity::gauges_test {
namespace {

using std::numbers::pi;

template <class Height>
Surface map_of(int nx, int ny, double dx, double dy, const Height& height) {
  Field z(nx, ny);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) z(i, j) = height(i, j);
  return Surface::with_holes(Grid{nx, ny, nx * dx, ny * dy}, std::move(z));
}

Surface plane(bool hole) {
  return map_of(101, 81, .5, .8, [=](int i, int j) {
    const bool missing = hole && (i - 40) * (i - 40) + (j - 30) * (j - 30) <= 200;
    return missing ? std::numeric_limits<double>::quiet_NaN() : .3 * .5 * i - .2 * .8 * j;
  });
}

Surface ridges(int n, double period, double degrees) {
  const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  return map_of(n, n, 1, 1, [=](int i, int j) {
    const double u = (i * c + j * s) / period;
    return 3 * (1 - std::abs(2 * (u - std::floor(u)) - 1));
  });
}

// One period of angles, so that equal heights have equal bits.
double wave(int i, int period) { return std::sin(2 * pi * (i % period) / period); }

Surface gauge(const std::string& name) {
  if (name == "plane") return plane(false);
  if (name == "sine") return map_of(256, 256, 1, 1, [](int i, int) { return wave(i, 16); });
  if (name == "sine2d")
    return map_of(256, 256, .5, .5, [](int i, int j) { return 2 * wave(i, 32) * wave(j, 32); });
  if (name == "step") return map_of(200, 50, .5, .5, [](int i, int) { return i >= 140 ? 1.5 : 0.0; });
  if (name == "ridge0") return ridges(240, 24, 0);
  if (name == "cheq")
    return map_of(240, 240, 1, 1, [](int i, int j) { return (i / 12 + j / 12) % 2 == 0 ? 1.0 : 0.0; });
  ADD_FAILURE() << "no formula of the gauge " << name << " stands here";
  return plane(false);
}

Profile trace(double wiggle) {
  Array<double> z(5000);
  for (std::size_t k = 0; k < z.size(); ++k) {
    const auto i = static_cast<double>(k);
    z[k] = std::sin(2 * pi * i / 100 + .3) + wiggle * std::sin(14 * pi * i / 100 + .3);
  }
  return Profile(.1, std::move(z));
}

using P = ArealParameters;
const std::map<std::string, std::function<double(const P&)>> areal{
    {"Sa", [](const P& p) { return p.heights().Ra; }},
    {"Sq", [](const P& p) { return p.heights().Rq; }},
    {"Ssk", [](const P& p) { return p.heights().skewness; }},
    {"Sku", [](const P& p) { return p.heights().kurtosis; }},
    {"Sp", [](const P& p) { return p.heights().peak - p.heights().mean; }},
    {"Sz", [](const P& p) { return p.heights().amplitude; }},
    {"Sdq_edge", [](const P& p) { return p.slopes().Sdq.value(); }},
    {"Sdq_7", [](const P& p) { return p.slopes().Sdq_seven.value(); }},
    {"Sdr", [](const P& p) { return p.slopes().Sdr.value(); }},
    {"Spc", [](const P& p) { return p.hills().Spc.value(); }},
    {"S10z", [](const P& p) { return p.hills().S10z.value(); }},
    {"Sk", [](const P& p) { return p.core().Sk; }},
    {"Std_wave", [](const P& p) { return p.direction().value().wave; }},
    {"ACF_axis_quarter", [](const P& p) { return Autocorrelation(p.prepared())(3, 0); }},
};
using R = ProfileParameters;
const std::map<std::string, std::function<double(const R&)>> of_profile{
    {"Ra", [](const R& r) { return r.Ra.value; }},       {"Rq", [](const R& r) { return r.Rq.value; }},
    {"Rz", [](const R& r) { return r.Rz.value; }},       {"Rt", [](const R& r) { return r.Rt; }},
    {"Rzx", [](const R& r) { return r.Rzx; }},           {"Rc", [](const R& r) { return r.Rc.value(); }},
    {"Rdq_7", [](const R& r) { return r.Rdq.value(); }}, {"Rdr", [](const R& r) { return r.Rdr.value(); }},
    {"Rsk", [](const R& r) { return r.Rsk; }},           {"Rku", [](const R& r) { return r.Rku; }},
    {"Rk", [](const R& r) { return r.core.Sk; }},
};

TEST(Gauges, EveryRowOfCellsToTheNinthDigit) {
  std::ifstream file(ASPERITY_TEST_DATA "/metrology_gauges.csv");
  std::map<std::string, ArealParameters> maps;
  const std::map<std::string, ProfileParameters> traces{{"psine", profile_parameters(trace(0))},
                                                        {"pwiggle", profile_parameters(trace(.05))}};
  int rows = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::vector<std::string> row(5);
    for (std::string& cell : row) std::getline(cells, cell, ',');
    const std::string &name = row[0], &parameter = row[1], &exact = row[2].empty() ? row[4] : row[2];
    if (row[3] != "cells" || name.starts_with('#')) continue;
    // Periodic slopes: areal_parameters_test.cpp. No program uses the overestimating rule.
    if (name == "fractalP1" || parameter == "Sdr_edgeproduct_WRONG") continue;
    double found = std::numeric_limits<double>::quiet_NaN();
    if (const auto t = traces.find(name); t != traces.end()) {
      ASSERT_TRUE(of_profile.contains(parameter)) << line;
      found = of_profile.at(parameter)(t->second);
    } else if (parameter == "Sq_after_plane_removal_with_hole") {
      found = ArealParameters(plane(true), {.F = 1, .S = {}, .L = {}}).heights().Rq;
    } else if (parameter.ends_with("_with_hole")) {
      found = areal.at(parameter.substr(0, parameter.size() - 10))(ArealParameters(plane(true)));
    } else {
      ASSERT_TRUE(areal.contains(parameter)) << line;
      found = areal.at(parameter)(maps.try_emplace(name, gauge(name)).first->second);
    }
    const double wanted = std::stod(exact);
    EXPECT_NEAR(found, wanted, 1e-9 * std::abs(wanted) + 1e-12) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 67);
}

// Rounding noise of 1e-15 has a meaningless skewness.
TEST(ArealParameters, OfAPlaneLessItsPlaneAreNotDefined) {
  const ArealParameters p(plane(true), {.F = 1, .S = {}, .L = {}});
  EXPECT_GT(p.prepared().peak_to_valley(), 0);
  EXPECT_TRUE(p.flat());
  EXPECT_FALSE(p.texture());
  EXPECT_FALSE(p.direction());
  for (const char* name : {"Ssk", "Sku", "Sal", "Str", "Std", "Smr1", "Spd", "S10z"})
    EXPECT_EQ(p.why_not(name), "all heights are equal but for rounding of the map that was prepared") << name;
  EXPECT_EQ(p.why_not("Sq"), "");
  // A hundred-millionth of the tilt is a texture.
  const ArealParameters fine(
      map_of(64, 64, 1, 1, [](int i, int j) { return i + 1e-8 * ((i * 7 + j * 3) % 5); }),
      {.F = 1, .S = {}, .L = {}});
  EXPECT_FALSE(fine.flat());
  EXPECT_EQ(fine.why_not("Ssk"), "");
}

TEST(ArealParameters, OfNarrowMapsHaveNoDirectionAndNoHills) {
  const ArealParameters row(map_of(64, 1, 1, 1, [](int i, int) { return wave(i, 16); }));
  EXPECT_EQ(row.why_not("Spd"), "the map is under three nodes wide, and all of them are at its rim");
  for (const int ny : {1, 2, 5}) {
    const ArealParameters narrow(map_of(64, ny, 1, 1, [](int i, int j) { return wave(i + 3 * j, 16); }));
    EXPECT_FALSE(narrow.direction()) << ny;
    EXPECT_EQ(
        narrow.why_not("Std"),
        "the map is under six cells wide, or no wave is between two cells and two thirds of the map long");
  }
  EXPECT_TRUE(
      ArealParameters(map_of(64, 6, 1, 1, [](int i, int j) { return wave(i + 3 * j, 16); })).direction());
}

TEST(ProfileParameters, OfALineLessItsLineAreRefused) {
  Array<double> z(2000);
  for (std::size_t k = 0; k < z.size(); ++k) z[k] = 3 + .25 * static_cast<double>(k) / 7;
  try {
    prepared_profile(Profile(1, std::move(z)), {.F = 1, .S = {}, .section = 100});
    FAIL() << "rounding was taken for roughness";
  } catch (const Error& error) {
    EXPECT_STREQ(
        error.what(),
        "nothing but rounding is left of the trace once form and waves longer than 100 m are taken away; its "
        "parameters need heights that differ");
  }
}

}  // namespace
}  // namespace asperity::gauges_test
